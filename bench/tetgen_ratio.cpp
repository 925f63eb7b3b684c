// The whole job as a user sees it, points in and quality mesh out as arrays, beside TetGen: the same
// points, the same radius-edge bound. The two take turns, each turn in a child of its own: neither
// finds memory that an earlier turn has warmed, and a TetGen that crashes or hangs ends one turn.
//
//   cmake --build <build> --target tetgen_ratio, then <build>/bench/
//   tetgen_ratio                                    the table: bounds 2.0 and 1.414; uniform, gaussian,
//                                                   clusters, sphere at 10,000 and 100,000
//   tetgen_ratio <n> <bound> <turns> <uniform | gaussian | clusters | sphere | grid | ...>
//
// netmesh's seconds: create, run, points and simplices copied into vectors, free. TetGen's: its one
// call, which leaves arrays; making its input and copying its arrays are not in it.
#include <chrono>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <string>
#include <vector>

#include "clusters.hpp"
#include "in_child.hpp"
#include "netmesh.h"
#include "ratio.hpp"
#include "tetgen_box.hpp"

namespace {

constexpr unsigned most_seconds = 120;  // of one turn of either

struct Turn {
    double seconds;
    std::uint64_t vertices;
};

struct Medians {
    std::string distribution;
    std::size_t n = 0;
    double bound = 0.0;
    double our_vertices = 0.0, their_vertices = 0.0;
    double ours = 0.0, theirs = 0.0;
    double ratio = 0.0;
};

int run_netmesh(const PointSet& input, double bound, Turn& turn) {
    const auto start = std::chrono::steady_clock::now();
    nm_mesh* mesh = nullptr;
    require(nm_mesh_create(3, input.size(), input.coordinates.data(), 0, &mesh), "nm_mesh_create");
    nm_options options;
    require(nm_options_init(&options, sizeof options), "nm_options_init");
    options.output = NM_OUTPUT_WELL_SPACED;
    options.criterion = NM_CRITERION_RADIUS_EDGE;
    options.quality_bound = bound;
    require(nm_run(mesh, &options), "nm_run");
    const auto points = get<double>(mesh, nm_mesh_get_points, "nm_mesh_get_points");
    const auto simplices = get<std::uint32_t>(mesh, nm_mesh_get_simplices, "nm_mesh_get_simplices");
    nm_mesh_free(mesh);
    turn.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    turn.vertices = points.size() / 3;
    return simplices.empty() ? 1 : 0;
}

int run_tetgen(const PointSet& input, double bound, Turn& turn) {
    // The switches are those of experiments/peers/main.cpp. p: the box; q: the bound, and no bound on dihedral angles;
    // O0/0: no optimisation afterwards, as netmesh has none; Q: quiet.
    const TetgenResult result = tetgen_in_box(input, "pq" + std::to_string(bound) + "/0O0/0Q");
    turn = {result.seconds, result.points.size() / 3};
    return result.error != 0 ? 1 : 0;
}

// Answers whether there is a figure; says why where there is none.
bool take_turn(const char* mesher, const std::function<int()>& work) {
    const std::string trouble = in_child(most_seconds, work);
    if (!trouble.empty()) std::printf("%6s %s: %s\n", "", mesher, trouble.c_str());
    return trouble.empty();
}

Medians compare(std::size_t n, double bound, int turns, const std::string& distribution) {
    static Turn& turn = shared<Turn>();
    const PointSet input = ratio_input(distribution, 3, n);
    std::printf("%s %zu, radius-edge ratio at most %g\n", distribution.c_str(), n, bound);
    std::printf("%6s %10s %10s %10s %10s %8s\n", "turn", "netmesh", "TetGen", "netmesh s", "TetGen s", "ratio");
    std::vector<double> our_vertices, their_vertices, ours, theirs, ratios;
    for (int i = 1; i <= turns; ++i) {
        if (!take_turn("netmesh", [&] { return run_netmesh(input, bound, turn); })) continue;
        const Turn netmesh = turn;
        ours.push_back(netmesh.seconds);
        our_vertices.push_back(static_cast<double>(netmesh.vertices));
        if (!take_turn("TetGen", [&] { return run_tetgen(input, bound, turn); })) continue;
        theirs.push_back(turn.seconds);
        their_vertices.push_back(static_cast<double>(turn.vertices));
        ratios.push_back(netmesh.seconds / turn.seconds);
        std::printf("%6d %10zu %10zu %10.3f %10.3f %8.2f\n", i, static_cast<std::size_t>(netmesh.vertices),
                    static_cast<std::size_t>(turn.vertices), netmesh.seconds, turn.seconds, ratios.back());
    }
    const Medians medians{distribution, n, bound, median(our_vertices), median(their_vertices),
                          median(ours), median(theirs), median(ratios)};
    std::printf("%6s %10.0f %10.0f %10.3f %10.3f %8.2f\n\n", "median", medians.our_vertices,
                medians.their_vertices, medians.ours, medians.theirs, medians.ratio);
    std::fflush(stdout);
    return medians;
}

void compare_all() {
    constexpr int turns = 3;
    std::vector<Medians> all;
    for (const double bound : {2.0, 1.414}) {
        for (const std::size_t n : {10000, 100000}) {
            for (const char* distribution : {"uniform", "gaussian", "clusters", "sphere"}) {
                all.push_back(compare(n, bound, turns, distribution));
            }
        }
    }
    std::printf("%-10s %8s %6s %10s %10s %10s %10s %8s\n", "input", "n", "bound", "netmesh", "TetGen",
                "netmesh s", "TetGen s", "ratio");
    for (const Medians& row : all) {
        std::printf("%-10s %8zu %6g %10.0f %10.0f %10.3f %10.3f %8.2f\n", row.distribution.c_str(), row.n,
                    row.bound, row.our_vertices, row.their_vertices, row.ours, row.theirs, row.ratio);
    }
}

}  // namespace

int main(int count, char** arguments) {
    if (count == 1) {
        compare_all();
        return 0;
    }
    const long n = std::atol(arguments[1]);
    const double bound = count > 2 ? std::atof(arguments[2]) : 0.0;
    const int turns = count > 3 ? std::atoi(arguments[3]) : 0;
    if (count != 5 || n < 4 || !(bound > 0.0) || turns < 1) {
        std::fprintf(stderr, "usage: tetgen_ratio [<n> <bound> <turns> <distribution>]\n");
        return 2;
    }
    compare(static_cast<std::size_t>(n), bound, turns, arguments[4]);
    return 0;
}
