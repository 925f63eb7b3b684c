// How much dearer is a quality mesh than a plain Delaunay triangulation of the same vertices? nm_run
// and CGAL take turns in one process; the ratio of each turn is robust against a machine whose speed
// drifts, its median against a disturbed turn.
//
//   cgal_ratio                              uniform 100,000 in 2D and 3D, 10,000 in 4D, 5 turns
//   cgal_ratio <dim> <n> <turns> [uniform | gaussian | sphere | grid | ...]
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

#include "cgal_insert.hpp"
#include "inputs.hpp"
#include "netmesh.h"

namespace {

void require(nm_status status, const char* call) {
    if (status == NM_OK) return;
    char message[512];
    nm_last_error(message, sizeof message);
    std::fprintf(stderr, "%s: %s: %s\n", call, nm_status_name(status), message);
    std::exit(1);
}

double median(std::vector<double> values) {
    std::sort(values.begin(), values.end());
    const std::size_t half = values.size() / 2;
    return values.size() % 2 == 1 ? values[half] : (values[half - 1] + values[half]) / 2;
}

CgalTiming cgal_insert(unsigned dim, const std::vector<double>& points) {
    const std::size_t n = points.size() / dim;
    return dim == 2   ? cgal_insert_2(points.data(), n)
           : dim == 3 ? cgal_insert_3(points.data(), n)
                      : cgal_insert_4(points.data(), n);
}

void compare(unsigned dim, std::size_t n, int turns, const std::string& distribution) {
    const PointSet input = generate(distribution, dim, n);
    nm_mesh* mesh = nullptr;
    require(nm_mesh_create(dim, n, input.coordinates.data(), 0, &mesh), "nm_mesh_create");
    std::printf("%s %zu, %uD\n", distribution.c_str(), n, dim);
    std::printf("%6s %10s %10s %10s %8s\n", "turn", "vertices", "nm_run s", "CGAL s", "ratio");
    std::vector<double> ours, theirs, ratios;
    for (int turn = 1; turn <= turns; ++turn) {
        require(nm_run(mesh, nullptr), "nm_run");
        nm_stats stats{};
        stats.struct_size = sizeof stats;
        require(nm_mesh_stats(mesh, &stats), "nm_mesh_stats");
        std::uint64_t needed = 0;
        require(nm_mesh_get_points(mesh, nullptr, 0, &needed), "nm_mesh_get_points");
        std::vector<double> vertices(needed);
        require(nm_mesh_get_points(mesh, vertices.data(), needed, nullptr), "nm_mesh_get_points");
        const CgalTiming cgal = cgal_insert(dim, vertices);
        if (cgal.vertices != needed / dim) {
            std::fprintf(stderr, "CGAL has %zu vertices of %zu\n", cgal.vertices,
                         static_cast<std::size_t>(needed / dim));
            std::exit(1);
        }
        ours.push_back(stats.seconds);
        theirs.push_back(cgal.seconds);
        ratios.push_back(stats.seconds / cgal.seconds);
        std::printf("%6d %10zu %10.3f %10.3f %8.2f\n", turn, cgal.vertices, ours.back(), theirs.back(),
                    ratios.back());
        std::fflush(stdout);
    }
    std::printf("%6s %10s %10.3f %10.3f %8.2f\n\n", "median", "", median(ours), median(theirs), median(ratios));
    nm_mesh_free(mesh);
}

}  // namespace

int main(int count, char** arguments) {
    if (count == 1) {
        compare(2, 100000, 5, "uniform");
        compare(3, 100000, 5, "uniform");
        compare(4, 10000, 5, "uniform");
        return 0;
    }
    const auto dim = static_cast<unsigned>(count > 1 ? std::atoi(arguments[1]) : 0);
    const long n = count > 2 ? std::atol(arguments[2]) : 0;
    const int turns = count > 3 ? std::atoi(arguments[3]) : 0;
    if (count > 5 || dim < 2 || dim > 4 || n < 2 || turns < 1) {
        std::fprintf(stderr, "usage: cgal_ratio [<dim> <n> <turns> [distribution]]\n");
        return 2;
    }
    compare(dim, static_cast<std::size_t>(n), turns, count == 5 ? arguments[4] : "uniform");
    return 0;
}
