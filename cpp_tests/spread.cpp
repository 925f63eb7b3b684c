// The paper's point: the mesh of n points has O(n) vertices whatever their spread. 256 points in 32
// nested clusters, spreads from 2^64 to 2^1800, eight seeds.
//
//   spread <dim>
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <iostream>
#include <string>
#include <vector>

#include "check.hpp"
#include "inputs.hpp"
#include "mesh.hpp"

namespace {

constexpr int log_spreads[] = {64, 256, 512, 1024, 1800};
constexpr int seeds = 8;

struct Outcome {
    double ratio;  // vertices per input
    double aspect;
    unsigned long long precision_limited;
};

Outcome run(unsigned dim, int log_spread, int seed) {
    check::context = "spread 2^" + std::to_string(log_spread) + ", seed " + std::to_string(seed);
    const PointSet points = nested_clusters(dim, log_spread, static_cast<std::uint64_t>(seed));
    const MeshHandle mesh = create(points);
    const nm_options options = default_options();
    REQUIRE_OK(nm_run(mesh.get(), &options));
    check_inputs_kept(points, mesh.get(), export_mesh(mesh.get()));
    check_certificate(mesh.get());
    const nm_counts counts = counts_of(mesh.get());
    const nm_quality quality = quality_of(mesh.get());
    CHECK_EQUAL(counts.inputs, 256u);
    CHECK_EQUAL(counts.duplicates, 0u);
    CHECK_AT_MOST(quality.worst_aspect, default_aspect_bound(dim) * (1 + 1e-7));
    return {static_cast<double>(counts.vertices) / static_cast<double>(counts.inputs),
            quality.worst_aspect, quality.precision_limited};
}

}  // namespace

int main(int count, char** arguments) {
    const auto dim = static_cast<unsigned>(count == 2 ? std::atoi(arguments[1]) : 0);
    if (dim != 2 && dim != 3) {
        std::cerr << "usage: spread <2|3>\n";
        return 2;
    }
    const double most = dim == 2 ? 13.0 : 20.0;
    constexpr double most_growth = 1.15;

    std::string table = "vertices per input, " + std::to_string(dim)
                        + "D, 256 points in 32 nested clusters\n  spread";
    for (int seed = 1; seed <= seeds; ++seed) table += "  seed " + std::to_string(seed);
    table += "  aspect  limited\n";

    std::vector<double> at_512(seeds);
    for (const int log_spread : log_spreads) {
        char cell[64];
        std::snprintf(cell, sizeof cell, "  2^%-4d", log_spread);
        table += cell;
        double aspect = 0.0;
        unsigned long long limited = 0;
        for (int seed = 1; seed <= seeds; ++seed) {
            const Outcome outcome = run(dim, log_spread, seed);
            std::snprintf(cell, sizeof cell, "  %6.2f", outcome.ratio);
            table += cell;
            CHECK_AT_MOST(outcome.ratio, most);
            double& reference = at_512[static_cast<std::size_t>(seed - 1)];
            if (log_spread == 512) reference = outcome.ratio;
            if (log_spread == 1800) CHECK_AT_MOST(outcome.ratio, most_growth * reference);
            aspect = std::max(aspect, outcome.aspect);
            limited += outcome.precision_limited;
        }
        std::snprintf(cell, sizeof cell, "  %6.3f  %7llu\n", aspect, limited);
        table += cell;
    }
    std::cout << table << std::flush;
    return check::result("spread");
}
