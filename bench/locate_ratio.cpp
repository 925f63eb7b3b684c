// Time to locate a point. nm_mesh_locate and CGAL's locate() answer the same random questions
// in the same Delaunay triangulation, in turns, on one thread. CGAL walks from where its own users
// begin: from the cell of the point before (which helps only questions that are sorted), and by its
// location structure (Triangulation_hierarchy_2, Fast_location), which has no equal in 4D.
//
//   cmake --build <build> --target locate_ratio, then <build>/bench/
//   locate_ratio [<n> <questions> <turns>]      100,000, 1,000,000, 3; a tenth of it in 4D
#include <CGAL/Delaunay_triangulation.h>
#include <CGAL/Delaunay_triangulation_2.h>
#include <CGAL/Delaunay_triangulation_3.h>
#include <CGAL/Epick_d.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Triangulation_hierarchy_2.h>

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <vector>

#include "inputs.hpp"
#include "netmesh.h"
#include "ratio.hpp"

namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;

double seconds_since(std::chrono::steady_clock::time_point start) {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

// Seconds of nm_mesh_locate, and how many questions are inside.
struct Answer {
    double seconds = 0.0;
    std::size_t inside = 0;
};

Answer netmesh_locates(const nm_mesh* mesh, unsigned dim, const std::vector<double>& questions) {
    std::vector<std::uint32_t> found(questions.size() / dim);
    const auto start = std::chrono::steady_clock::now();
    require(nm_mesh_locate(mesh, found.size(), questions.data(), 1, found.data()), "nm_mesh_locate");
    Answer answer{seconds_since(start), 0};
    for (std::uint32_t simplex : found) {
        answer.inside += simplex != NM_NONE;
    }
    return answer;
}

template <typename Point>
std::vector<Point> points_of(const std::vector<double>& coordinates, unsigned dim) {
    std::vector<Point> points;
    points.reserve(coordinates.size() / dim);
    for (std::size_t at = 0; at < coordinates.size(); at += dim) {
        if constexpr (std::is_same_v<Point, Kernel::Point_2>) {
            points.emplace_back(coordinates[at], coordinates[at + 1]);
        } else if constexpr (std::is_same_v<Point, Kernel::Point_3>) {
            points.emplace_back(coordinates[at], coordinates[at + 1], coordinates[at + 2]);
        } else {
            points.emplace_back(coordinates.begin() + static_cast<std::ptrdiff_t>(at),
                                coordinates.begin() + static_cast<std::ptrdiff_t>(at + dim));
        }
    }
    return points;
}

// Asks with whatever `locate` does with a point and the last answer.
template <typename Triangulation, typename Point, typename Handle, typename Locate>
Answer cgal_locates(const Triangulation& triangulation, const std::vector<Point>& questions, Handle last,
                    Locate locate) {
    Answer answer;
    const auto start = std::chrono::steady_clock::now();
    for (const Point& question : questions) {
        last = locate(triangulation, question, last);
        answer.inside += !triangulation.is_infinite(last);
    }
    answer.seconds = seconds_since(start);
    return answer;
}

struct Row {
    const char* name;
    std::vector<double> seconds;
};

// Each asks `turns` times, in turns.
template <typename Ours, typename Walk, typename Structure>
void compare(unsigned dim, std::size_t n, std::size_t questions, int turns, Ours ours, Walk walk,
             Structure structure, bool has_structure) {
    Row rows[3] = {{"netmesh", {}}, {"CGAL, from the last answer", {}}, {"CGAL, its structure", {}}};
    for (int turn = 0; turn < turns; ++turn) {
        const Answer answers[3] = {ours(), walk(), has_structure ? structure() : Answer{}};
        for (int i = 0; i < (has_structure ? 3 : 2); ++i) {
            rows[i].seconds.push_back(answers[i].seconds);
            if (answers[i].inside != answers[0].inside) {
                std::fprintf(stderr, "%s has %zu inside, netmesh %zu\n", rows[i].name, answers[i].inside,
                             answers[0].inside);
                std::exit(1);
            }
        }
    }
    const double own = median(rows[0].seconds);
    for (const Row& row : rows) {
        if (!row.seconds.empty()) {
            const double time = median(row.seconds);
            std::printf("%uD %7zu points, %8zu questions  %-28s %7.3f s %8.3f M/s %7.2f times netmesh's\n", dim,
                        n, questions, row.name, time, static_cast<double>(questions) / time / 1e6, time / own);
        }
    }
    std::fflush(stdout);
}

template <typename Plain, typename Fast, typename Point>
void compare_with(unsigned dim, std::size_t n, std::size_t count, int turns) {
    const std::vector<double> points = generate("uniform", dim, n).coordinates;
    // Other points of the same cube.
    const std::vector<double> all = generate("uniform", dim, n + count).coordinates;
    const std::vector<double> questions(all.begin() + static_cast<std::ptrdiff_t>(n * dim), all.end());
    nm_mesh* mesh = nullptr;
    nm_options options;
    require(nm_options_init(&options, sizeof options), "nm_options_init");
    options.algorithm = NM_ALGORITHM_DELAUNAY;
    require(nm_mesh_create(dim, n, points.data(), 0, &mesh), "nm_mesh_create");
    require(nm_run(mesh, &options), "nm_run");
    require(nm_mesh_index(mesh, nullptr), "nm_mesh_index");
    const std::vector<Point> inputs = points_of<Point>(points, dim), asked = points_of<Point>(questions, dim);
    const auto ours = [&] { return netmesh_locates(mesh, dim, questions); };
    if constexpr (std::is_same_v<Plain, Fast>) {
        Plain plain(static_cast<int>(dim));
        plain.insert(inputs.begin(), inputs.end());
        const auto begin = plain.infinite_full_cell();
        const auto walk = [&] {
            return cgal_locates(plain, asked, begin, [](const Plain& triangulation, const Point& x, auto last) {
                return triangulation.locate(x, last);
            });
        };
        compare(dim, n, count, turns, ours, walk, walk, false);
    } else {
        const Plain plain(inputs.begin(), inputs.end());
        const Fast fast(inputs.begin(), inputs.end());
        const auto begin = [](const auto& triangulation) {
            return triangulation.locate(triangulation.finite_vertices_begin()->point());
        };
        const auto walk = [&] {
            return cgal_locates(plain, asked, begin(plain), [](const Plain& triangulation, const Point& x, auto last) {
                return triangulation.locate(x, last);
            });
        };
        const auto structure = [&] {
            return cgal_locates(fast, asked, begin(fast), [](const Fast& triangulation, const Point& x, auto) {
                return triangulation.locate(x);
            });
        };
        compare(dim, n, count, turns, ours, walk, structure, true);
    }
    nm_mesh_free(mesh);
}

}  // namespace

int main(int count, char** arguments) {
    const long n = count > 1 ? std::atol(arguments[1]) : 100000;
    const long questions = count > 2 ? std::atol(arguments[2]) : 1000000;
    const int turns = count > 3 ? std::atoi(arguments[3]) : 3;
    if (count > 4 || n < 100 || questions < 10 || turns < 1) {
        std::fprintf(stderr, "usage: locate_ratio [<n> <questions> <turns>]\n");
        return 2;
    }
    const auto points = static_cast<std::size_t>(n), asked = static_cast<std::size_t>(questions);
    using Plain2 = CGAL::Delaunay_triangulation_2<Kernel>;
    using Base2 = CGAL::Delaunay_triangulation_2<
        Kernel, CGAL::Triangulation_data_structure_2<
                    CGAL::Triangulation_hierarchy_vertex_base_2<CGAL::Triangulation_vertex_base_2<Kernel>>,
                    CGAL::Triangulation_face_base_2<Kernel>>>;
    compare_with<Plain2, CGAL::Triangulation_hierarchy_2<Base2>, Kernel::Point_2>(2, points, asked, turns);
    using Plain3 = CGAL::Delaunay_triangulation_3<Kernel>;
    using Fast3 = CGAL::Delaunay_triangulation_3<Kernel, CGAL::Fast_location>;
    compare_with<Plain3, Fast3, Kernel::Point_3>(3, points, asked, turns);
    using Kernel4 = CGAL::Epick_d<CGAL::Dimension_tag<4>>;
    using Plain4 = CGAL::Delaunay_triangulation<Kernel4>;
    compare_with<Plain4, Plain4, Kernel4::Point_d>(4, points / 10, asked / 10, turns);
    return 0;
}
