// Seconds from points to a mesh within one bound, against the number of points: netmesh beside TetGen
// (3D), CGAL's Mesh_2 (2D) and, as what any of them costs at least, CGAL's plain Delaunay triangulation
// of netmesh's vertices. One thread each. Prints rows for bench/plots/draw.py.
//
//   cmake --build <build> --target mesh_times, then
//   <build>/bench/mesh_times [<most points> [<turns>]]     (1,000,000 and 3)
//
// Radius-edge ratios of at most 2 in 3D and sqrt 2 in 2D (20.7 degrees); uniform points and points on
// a sphere. TetGen gets a box three times the size of the points', Mesh_2 their bounding box, netmesh
// nothing. A turn has a child of its own, as in tetgen_ratio; medians of all turns.
#include <chrono>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <string>
#include <vector>

#include "cgal_insert.hpp"
#include "cgal_mesh_2.hpp"
#include "clusters.hpp"
#include "in_child.hpp"
#include "netmesh.h"
#include "ratio.hpp"
#include "tetgen_box.hpp"

namespace {

constexpr unsigned most_seconds = 600;  // of one turn
constexpr std::size_t most_coordinates = std::size_t{1} << 25;

// Result that a child leaves behind. The points are netmesh's vertices.
struct Turn {
    double seconds;
    std::size_t vertices;
    double points[most_coordinates];
};

double bound(unsigned dim) { return dim == 2 ? std::sqrt(2.0) : 2.0; }

int run_netmesh(const PointSet& input, unsigned dim, Turn& turn) {
    const auto start = std::chrono::steady_clock::now();
    nm_mesh* mesh = nullptr;
    require(nm_mesh_create(dim, input.size(), input.coordinates.data(), 0, &mesh), "nm_mesh_create");
    nm_options options;
    require(nm_options_init(&options, sizeof options), "nm_options_init");
    options.output = NM_OUTPUT_WELL_SPACED;
    options.criterion = NM_CRITERION_RADIUS_EDGE;
    options.quality_bound = bound(dim);
    options.threads = 1;
    require(nm_run(mesh, &options), "nm_run");
    const auto simplices = get<std::uint32_t>(mesh, nm_mesh_get_simplices, "nm_mesh_get_simplices");
    std::uint64_t needed = 0;
    require(nm_mesh_get_points(mesh, turn.points, most_coordinates, &needed), "nm_mesh_get_points");
    nm_mesh_free(mesh);
    turn.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    turn.vertices = needed / dim;
    return simplices.empty() ? 1 : 0;
}

int run_tetgen(const PointSet& input, Turn& turn) {
    // The switches are those of tetgen_ratio.cpp.
    const TetgenResult result = tetgen_in_box(input, "pq" + std::to_string(bound(3)) + "/0O0/0Q");
    turn.seconds = result.seconds;
    turn.vertices = result.points.size() / 3;
    return result.error != 0 ? 1 : 0;
}

int run_plain(unsigned dim, Turn& turn) {
    const CgalTiming plain =
        dim == 2 ? cgal_insert_2(turn.points, turn.vertices) : cgal_insert_3(turn.points, turn.vertices);
    turn.seconds = plain.seconds;
    turn.vertices = plain.vertices;
    return 0;
}

int run_mesh_2(const PointSet& input, Turn& turn) {
    const CgalTiming mesh = cgal_mesh_2(input.coordinates.data(), input.size(), bound(2));
    turn.seconds = mesh.seconds;
    turn.vertices = mesh.vertices;
    return 0;
}

// One row, unless a turn failed. Says why on stderr.
void measure(const std::string& distribution, unsigned dim, std::size_t n, int turns, const char* mesher,
             Turn& turn, const std::function<int()>& work) {
    std::vector<double> seconds;
    std::size_t vertices = 0;
    for (int i = 0; i < turns; ++i) {
        const std::size_t before = turn.vertices;
        const std::string trouble = in_child(most_seconds, work);
        if (!trouble.empty()) {
            std::fprintf(stderr, "%s, %uD %s of %zu: %s\n", mesher, dim, distribution.c_str(), n, trouble.c_str());
            turn.vertices = before;
            return;
        }
        seconds.push_back(turn.seconds);
        vertices = turn.vertices;
    }
    std::printf("%u,%s,%s,%zu,%zu,%.6f\n", dim, distribution.c_str(), mesher, n, vertices, median(seconds));
    std::fflush(stdout);
}

void measure_all(unsigned dim, const std::string& distribution, std::size_t n, int turns, Turn& turn) {
    const PointSet input = ratio_input(distribution, dim, n);
    measure(distribution, dim, n, turns, "netmesh", turn, [&] { return run_netmesh(input, dim, turn); });
    if (turn.vertices == 0) return;
    // Its vertices are in turn.points until the next turn of netmesh.
    measure(distribution, dim, n, turns, "CGAL Delaunay", turn, [&] { return run_plain(dim, turn); });
    if (dim == 2) {
        measure(distribution, dim, n, turns, "CGAL Mesh_2", turn, [&] { return run_mesh_2(input, turn); });
    } else {
        measure(distribution, dim, n, turns, "TetGen", turn, [&] { return run_tetgen(input, turn); });
    }
}

}  // namespace

int main(int count, char** arguments) {
    const long most = count > 1 ? std::atol(arguments[1]) : 1000000;
    const int turns = count > 2 ? std::atoi(arguments[2]) : 3;
    if (count > 3 || most < 1000 || turns < 1) {
        std::fprintf(stderr, "usage: mesh_times [<most points, 1000 or more> [<turns>]]\n");
        return 2;
    }
    Turn& turn = shared<Turn>();
    std::printf("dim,distribution,mesher,points,vertices,seconds\n");
    for (const unsigned dim : {2U, 3U}) {
        for (const char* distribution : {"uniform", "sphere"}) {
            for (long n = 1000; n <= most; n *= 10) {
                measure_all(dim, distribution, static_cast<std::size_t>(n), n < 1000000 ? turns : 1, turn);
            }
        }
    }
    return 0;
}
