// netmesh/cgal.hpp against CGAL: what fill() writes is what CGAL would have made, or another Delaunay
// triangulation of the same points.
//
//   cgal_adapter 2|3
//   cgal_adapter 2|3 time <points>
#include <netmesh/cgal.hpp>

#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Triangulation_cell_base_with_info_3.h>
#include <CGAL/Triangulation_face_base_with_info_2.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>
#include <CGAL/Triangulation_vertex_base_with_info_3.h>

#include <array>
#include <chrono>
#include <cstdio>
#include <list>
#include <map>
#include <random>
#include <string>
#include <vector>

#include "check.hpp"
#include "expect_error.hpp"
#include "point_sets.hpp"

namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Exact = CGAL::Exact_predicates_exact_constructions_kernel;

// One interface to both dimensions, with the ids in info().
struct Plane {
    static constexpr unsigned dim = 2;
    using Structure = CGAL::Triangulation_data_structure_2<
        CGAL::Triangulation_vertex_base_with_info_2<std::uint32_t, Kernel>,
        CGAL::Triangulation_face_base_with_info_2<std::uint32_t, Kernel>>;
    using Delaunay = CGAL::Delaunay_triangulation_2<Kernel, Structure>;
    using Plain = CGAL::Delaunay_triangulation_2<Kernel>;
    using OverExact = CGAL::Delaunay_triangulation_2<Exact>;
    using Point = Kernel::Point_2;
    using ExactPoint = Exact::Point_2;
    using Cell = Delaunay::Face_handle;
    using Vertex = Delaunay::Vertex_handle;

    static Point point(const double* x) { return Point(x[0], x[1]); }
    static auto cells(const Delaunay& d) { return d.finite_face_handles(); }
    static auto all_cells(const Delaunay& d) { return d.all_face_handles(); }
    static std::size_t count(const Delaunay& d) { return d.number_of_faces(); }
    static bool positive(Cell c) {
        return CGAL::orientation(c->vertex(0)->point(), c->vertex(1)->point(), c->vertex(2)->point()) > 0;
    }
    static bool has(const Delaunay& d, const std::array<Vertex, 4>& v) { return d.is_face(v[0], v[1], v[2]); }
    static std::size_t infinite_degree(const Delaunay& d) { return d.tds().degree(d.infinite_vertex()); }
    static bool is_outside(const Delaunay& d, const Point& p) {
        Delaunay::Locate_type where;
        int i;
        d.locate(p, where, i);
        return where == Delaunay::OUTSIDE_CONVEX_HULL;
    }
    static double distance(const Point& a, const Point& b) { return CGAL::squared_distance(a, b); }
};

struct Space {
    static constexpr unsigned dim = 3;
    using Structure = CGAL::Triangulation_data_structure_3<
        CGAL::Triangulation_vertex_base_with_info_3<std::uint32_t, Kernel>,
        CGAL::Triangulation_cell_base_with_info_3<std::uint32_t, Kernel,
                                                  CGAL::Delaunay_triangulation_cell_base_3<Kernel>>>;
    using Delaunay = CGAL::Delaunay_triangulation_3<Kernel, Structure>;
    using Plain = CGAL::Delaunay_triangulation_3<Kernel>;
    using OverExact = CGAL::Delaunay_triangulation_3<Exact>;
    using Point = Kernel::Point_3;
    using ExactPoint = Exact::Point_3;
    using Cell = Delaunay::Cell_handle;
    using Vertex = Delaunay::Vertex_handle;

    static Point point(const double* x) { return Point(x[0], x[1], x[2]); }
    static auto cells(const Delaunay& d) { return d.finite_cell_handles(); }
    static auto all_cells(const Delaunay& d) { return d.all_cell_handles(); }
    static std::size_t count(const Delaunay& d) { return d.number_of_finite_cells(); }
    static bool positive(Cell c) {
        return CGAL::orientation(c->vertex(0)->point(), c->vertex(1)->point(), c->vertex(2)->point(),
                                 c->vertex(3)->point()) > 0;
    }
    static bool has(const Delaunay& d, const std::array<Vertex, 4>& v) {
        return d.tds().is_cell(v[0], v[1], v[2], v[3]);
    }
    static std::size_t infinite_degree(const Delaunay& d) {
        std::vector<Cell> cells;
        d.incident_cells(d.infinite_vertex(), std::back_inserter(cells));
        return cells.size();
    }
    static bool is_outside(const Delaunay& d, const Point& p) {
        Delaunay::Locate_type where;
        int i, j;
        d.locate(p, where, i, j);
        return where == Delaunay::OUTSIDE_CONVEX_HULL;
    }
    static double distance(const Point& a, const Point& b) { return CGAL::squared_distance(a, b); }
};

template <class World>
std::vector<typename World::Point> cgal_points(const PointSet& set) {
    std::vector<typename World::Point> points;
    for (std::size_t i = 0; i < set.size(); ++i) points.push_back(World::point(set.point(i)));
    return points;
}

// CGAL's own verdict; its assertions are compiled in, and throw.
template <class Triangulation>
void check_valid(const Triangulation& triangulation, int line) {
    try {
        check::that(triangulation.is_valid(true), __FILE__, line, "is_valid(true)");
    } catch (const std::exception& error) {
        check::that(false, __FILE__, line, "is_valid(true)", error.what());
    }
}

// Every vertex, cell and neighbour is the mesh's; what is infinite is the hull.
template <class World>
void check_is_the_mesh(const typename World::Delaunay& triangulation, const netmesh::mesh& mesh,
                       const std::vector<typename World::Vertex>& vertices) {
    const auto points = mesh.points();
    const auto simplices = mesh.simplices(), neighbors = mesh.neighbors();
    CHECK_EQUAL(triangulation.dimension(), static_cast<int>(World::dim));
    CHECK_EQUAL(triangulation.number_of_vertices(), points.size());
    CHECK_EQUAL(World::count(triangulation), simplices.size());
    REQUIRE(vertices.size() == points.size());
    for (std::size_t v = 0; v < points.size(); ++v) {
        CHECK_EQUAL(vertices[v]->info(), v);
        CHECK(vertices[v]->point() == World::point(points[v].data()));
    }
    std::size_t infinite = 0;
    for (const auto cell : World::all_cells(triangulation)) {
        const std::uint32_t id = cell->info();
        CHECK_EQUAL(triangulation.is_infinite(cell), id == NM_NONE);
        if (id == NM_NONE) {
            ++infinite;
            continue;
        }
        CHECK(World::positive(cell));
        for (int i = 0; i <= static_cast<int>(World::dim); ++i) {
            const auto place = static_cast<std::size_t>(i);
            CHECK_EQUAL(cell->vertex(i)->info(), simplices[id][place]);
            CHECK_EQUAL(cell->neighbor(i)->info(), neighbors[id][place]);
        }
    }
    const auto& flat = neighbors.flat();
    CHECK_EQUAL(infinite, static_cast<std::size_t>(std::count(flat.begin(), flat.end(), NM_NONE)));
    CHECK_EQUAL(World::infinite_degree(triangulation), infinite);
}

// CGAL's insertion of the mesh's vertices, with the ids in info().
template <class World>
typename World::Delaunay inserted(const netmesh::mesh& mesh) {
    const auto points = mesh.points();
    std::vector<std::pair<typename World::Point, std::uint32_t>> with_ids;
    for (std::size_t v = 0; v < points.size(); ++v) {
        with_ids.emplace_back(World::point(points[v].data()), static_cast<std::uint32_t>(v));
    }
    return typename World::Delaunay(with_ids.begin(), with_ids.end());
}

// Compares cells where there is only one triangulation, and answers to queries in any case.
template <class World>
void check_against_insertion(const typename World::Delaunay& filled, const netmesh::mesh& mesh, bool generic) {
    const auto reference = inserted<World>(mesh);
    CHECK_EQUAL(reference.number_of_vertices(), filled.number_of_vertices());
    const bool unique = netmesh::cgal::is_unique(filled);
    CHECK_EQUAL(netmesh::cgal::is_unique(reference), unique);
    if (generic) CHECK(unique);
    if (unique) {
        CHECK_EQUAL(World::count(reference), World::count(filled));
        std::vector<typename World::Vertex> by_id(reference.number_of_vertices());
        for (const auto vertex : reference.finite_vertex_handles()) by_id[vertex->info()] = vertex;
        for (const auto cell : World::cells(filled)) {
            std::array<typename World::Vertex, 4> vertices;
            for (unsigned i = 0; i <= World::dim; ++i) {
                vertices[i] = by_id[cell->vertex(static_cast<int>(i))->info()];
            }
            CHECK(World::has(reference, vertices));
        }
    }
    const auto points = mesh.points();
    std::mt19937 random(7);
    for (int i = 0; i < 50; ++i) {
        // Between three vertices, or as near as doubles are.
        double x[3] = {0, 0, 0};
        for (int j = 0; j < 3; ++j) {
            const auto corner = points[random() % points.size()];
            for (unsigned k = 0; k < World::dim; ++k) x[k] += corner[k] / 3;
        }
        const auto query = World::point(x);
        CHECK_EQUAL(World::is_outside(filled, query), World::is_outside(reference, query));
        const auto nearest = filled.nearest_vertex(query)->point();
        CHECK_EQUAL(World::distance(query, nearest), World::distance(query, reference.nearest_vertex(query)->point()));
    }
}

template <class World>
void every_input() {
    for (const NamedPoints& input : adapter_inputs(World::dim)) {
        netmesh::mesh mesh = netmesh::cgal::make_mesh(cgal_points<World>(input.points));
        CHECK_EQUAL(mesh.counts().inputs, input.points.size());
        typename World::Delaunay triangulation;
        typename World::Plain without_info;
        for (const int output : {0, 1, 2}) {
            check::context = input.name + ", output " + std::to_string(output);
            netmesh::options options;
            if (output == 1) options.output = NM_OUTPUT_WELL_SPACED;
            if (output == 2) options.algorithm = NM_ALGORITHM_DELAUNAY;
            if (output == 2 && !input.full_rank) continue;
            mesh.run(options);
            const auto vertices = netmesh::cgal::fill(mesh, triangulation);
            check_valid(triangulation, __LINE__);
            check_is_the_mesh<World>(triangulation, mesh, vertices);
            check_against_insertion<World>(triangulation, mesh, input.name == "uniform" && output == 2);
            const auto inputs = mesh.input_vertices();
            for (std::size_t i = 0; i < inputs.size(); ++i) {
                CHECK(vertices[inputs[i]]->point() == World::point(input.points.point(i)));
            }
            if (input.name == "grid") {
                CHECK(!netmesh::cgal::is_unique(triangulation));
                netmesh::cgal::fill(mesh, without_info);
                check_valid(without_info, __LINE__);
                CHECK_EQUAL(without_info.number_of_vertices(), triangulation.number_of_vertices());
            }
        }
    }
    check::context.clear();
}

// CGAL goes on from what was filled, if is_unique() says so.
template <class World>
void insertion_and_removal() {
    netmesh::mesh mesh = netmesh::cgal::make_mesh(cgal_points<World>(generate("uniform", World::dim, 300)));
    netmesh::options options;
    options.algorithm = NM_ALGORITHM_DELAUNAY;
    mesh.run(options);
    typename World::Delaunay triangulation;
    const auto vertices = netmesh::cgal::fill(mesh, triangulation);
    REQUIRE(netmesh::cgal::is_unique(triangulation));
    for (std::size_t i = 0; i < 150; ++i) triangulation.remove(vertices[2 * i]);
    check_valid(triangulation, __LINE__);
    const auto more = cgal_points<World>(generate("gaussian", World::dim, 300));
    triangulation.insert(more.begin(), more.end());
    check_valid(triangulation, __LINE__);
    CHECK_EQUAL(triangulation.number_of_vertices(), 450u);
}

// In the plane CGAL goes on from any Delaunay triangulation: a chequerboard, its other squares put in,
// half of all taken out.
void cocircular_points_in_the_plane() {
    std::vector<Plane::Point> black, white;
    for (int i = 0; i < 12; ++i) {
        for (int j = 0; j < 12; ++j) ((i + j) % 2 == 0 ? black : white).emplace_back(i, j);
    }
    netmesh::mesh mesh = netmesh::cgal::make_mesh(black);
    netmesh::options options;
    options.algorithm = NM_ALGORITHM_DELAUNAY;
    mesh.run(options);
    Plane::Delaunay triangulation;
    const auto vertices = netmesh::cgal::fill(mesh, triangulation);
    CHECK(!netmesh::cgal::is_unique(triangulation));
    triangulation.insert(white.begin(), white.end());
    check_valid(triangulation, __LINE__);
    for (const auto vertex : vertices) triangulation.remove(vertex);
    check_valid(triangulation, __LINE__);
    CHECK_EQUAL(triangulation.number_of_vertices(), white.size());
}

// A whole kernel of exact numbers, and ranges that are no vectors.
template <class World>
void exact_numbers() {
    const PointSet set = generate("uniform", World::dim, 100);
    std::list<typename World::ExactPoint> points;
    for (std::size_t i = 0; i < set.size(); ++i) {
        if constexpr (World::dim == 2) {
            points.emplace_back(set.point(i)[0], set.point(i)[1]);
        } else {
            points.emplace_back(set.point(i)[0], set.point(i)[1], set.point(i)[2]);
        }
    }
    netmesh::mesh mesh = netmesh::cgal::make_mesh(points);
    CHECK(std::equal(set.coordinates.begin(), set.coordinates.end(), mesh.points().data()));
    mesh.run();
    typename World::OverExact triangulation;
    netmesh::cgal::fill(mesh, triangulation);
    check_valid(triangulation, __LINE__);
    const Exact::FT third = Exact::FT(1) / 3;
    if constexpr (World::dim == 2) {
        points.emplace_back(0, third);
    } else {
        points.emplace_back(0, third, 0);
    }
    expect_error(__LINE__, NM_INVALID_ARGUMENT, "points[100] coordinate 1", [&] { netmesh::cgal::make_mesh(points); });
}

template <class World>
void errors() {
    auto points = cgal_points<World>(generate("uniform", World::dim, 50));
    typename World::Delaunay triangulation(points.begin(), points.end());
    netmesh::mesh mesh = netmesh::cgal::make_mesh(points);
    expect_error(__LINE__, NM_STATE, "run", [&] { netmesh::cgal::fill(mesh, triangulation); });
    const unsigned other = 5 - World::dim;
    netmesh::mesh odd(other, generate("uniform", other, 50).coordinates);
    odd.run();
    expect_error(__LINE__, NM_DIMENSION, "dim = " + std::to_string(other),
                 [&] { netmesh::cgal::fill(odd, triangulation); });
    CHECK_EQUAL(triangulation.number_of_vertices(), 50u);
    check_valid(triangulation, __LINE__);
    points.clear();
    expect_error(__LINE__, NM_DEGENERATE_INPUT, "two", [&] { netmesh::cgal::make_mesh(points); });
    CHECK(netmesh::cgal::is_unique(typename World::Delaunay()));
}

double seconds_since(std::chrono::steady_clock::time_point start) {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

// One line: what fill() takes beside CGAL's insertion of the same vertices. No bound is asserted.
template <class World>
void time(std::size_t n) {
    netmesh::mesh mesh = netmesh::cgal::make_mesh(cgal_points<World>(generate("uniform", World::dim, n)));
    mesh.run();
    const auto flat = mesh.points();
    std::vector<typename World::Point> vertices;
    for (const auto x : flat) vertices.push_back(World::point(x.data()));
    typename World::Plain filled;
    auto start = std::chrono::steady_clock::now();
    netmesh::cgal::fill(mesh, filled);
    const double fill = seconds_since(start);
    start = std::chrono::steady_clock::now();
    const typename World::Plain other(vertices.begin(), vertices.end());
    const double insert = seconds_since(start);
    CHECK_EQUAL(filled.number_of_vertices(), other.number_of_vertices());
    std::printf("%uD, %zu vertices: fill %.0f ms (%.2f us each), CGAL's insertion %.0f ms, %.1f times as long\n",
                World::dim, vertices.size(), 1e3 * fill, 1e6 * fill / static_cast<double>(vertices.size()),
                1e3 * insert, insert / fill);
}

template <class World>
int all(int count, char** arguments) {
    if (count == 4) {
        time<World>(std::stoul(arguments[3]));
    } else {
        every_input<World>();
        insertion_and_removal<World>();
        if (World::dim == 2) cocircular_points_in_the_plane();
        exact_numbers<World>();
        errors<World>();
        time<World>(4000);
        time<World>(16000);
    }
    return check::result("cgal_adapter");
}

}  // namespace

int main(int count, char** arguments) {
    const std::string dim = count > 1 ? arguments[1] : "";
    if (dim == "2") return all<Plane>(count, arguments);
    if (dim == "3") return all<Space>(count, arguments);
    std::fputs("usage: cgal_adapter 2|3 [time <points>]\n", stderr);
    return 2;
}
