#include "cgal_turns.hpp"

#include <cstdint>
#include <cstdio>
#include <cstdlib>

#include "cgal_insert.hpp"
#include "clusters.hpp"
#include "ratio.hpp"

namespace {

CgalTiming cgal_insert(unsigned dim, const std::vector<double>& points) {
    const std::size_t n = points.size() / dim;
    return dim == 2   ? cgal_insert_2(points.data(), n)
           : dim == 3 ? cgal_insert_3(points.data(), n)
                      : cgal_insert_4(points.data(), n);
}

}  // namespace

Medians compare_with_cgal(unsigned dim, std::size_t n, int turns, const std::string& distribution,
                          const nm_options* options) {
    const PointSet input = ratio_input(distribution, dim, n);
    nm_mesh* mesh = nullptr;
    require(nm_mesh_create(dim, n, input.coordinates.data(), 0, &mesh), "nm_mesh_create");
    std::printf("%s %zu, %uD\n", distribution.c_str(), n, dim);
    std::printf("%6s %10s %10s %10s %8s\n", "turn", "vertices", "nm_run s", "CGAL s", "ratio");
    std::vector<double> ours, theirs, ratios;
    std::size_t vertex_count = 0;
    for (int turn = 1; turn <= turns; ++turn) {
        require(nm_run(mesh, options), "nm_run");
        nm_stats stats = NM_STATS_INIT;
        require(nm_mesh_stats(mesh, &stats), "nm_mesh_stats");
        std::uint64_t needed = 0;
        require(nm_mesh_get_points(mesh, nullptr, 0, &needed), "nm_mesh_get_points");
        std::vector<double> vertices(needed);
        require(nm_mesh_get_points(mesh, vertices.data(), needed, nullptr), "nm_mesh_get_points");
        const CgalTiming cgal = cgal_insert(dim, vertices);
        vertex_count = static_cast<std::size_t>(needed / dim);
        if (cgal.vertices != vertex_count) {
            std::fprintf(stderr, "CGAL has %zu vertices of %zu\n", cgal.vertices, vertex_count);
            std::exit(1);
        }
        ours.push_back(stats.seconds);
        theirs.push_back(cgal.seconds);
        ratios.push_back(stats.seconds / cgal.seconds);
        std::printf("%6d %10zu %10.6f %10.6f %8.2f\n", turn, cgal.vertices, ours.back(), theirs.back(),
                    ratios.back());
        std::fflush(stdout);
    }
    nm_mesh_free(mesh);
    const Medians medians{distribution, dim, n, vertex_count, median(ours), median(theirs), median(ratios)};
    std::printf("%6s %10s %10.6f %10.6f %8.2f\n\n", "median", "", medians.ours, medians.theirs, medians.ratio);
    return medians;
}

void print_medians(const std::vector<Medians>& all) {
    std::printf("%4s %-10s %8s %10s %10s %10s %8s\n", "dim", "input", "n", "vertices", "nm_run s", "CGAL s", "ratio");
    for (const Medians& row : all) {
        std::printf("%3uD %-10s %8zu %10zu %10.3f %10.3f %8.2f\n", row.dim, row.distribution.c_str(), row.n,
                    row.vertices, row.ours, row.theirs, row.ratio);
    }
}

int compare_by_arguments(int count, char** arguments, const char* program, const nm_options* options) {
    const auto dim = static_cast<unsigned>(count > 1 ? std::atoi(arguments[1]) : 0);
    const long n = count > 2 ? std::atol(arguments[2]) : 0;
    const int turns = count > 3 ? std::atoi(arguments[3]) : 0;
    if (count > 5 || dim < 2 || dim > 4 || n < 2 || turns < 1) {
        std::fprintf(stderr, "usage: %s [<dim> <n> <turns> [distribution]]\n", program);
        return 2;
    }
    compare_with_cgal(dim, static_cast<std::size_t>(n), turns, count == 5 ? arguments[4] : "uniform", options);
    return 0;
}
