// Memory that a run takes: resident before, at its peak and afterwards, in all and per simplex.
// Uniform points, default options; each case in a process of its own.
//
//   cmake --build <build> --target memory_use, then <build>/bench/
//   memory_use                1,000,000 points in 3D, then in 2D
//   memory_use <dim> <n>
//
// Resident pages count in full: where the system gives large pages (src/memory/pages.rs), up to one of
// these per array is air. The system is asked to forget the peak before each stage.
#include <malloc.h>

#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <string>

#include "in_child.hpp"
#include "inputs.hpp"
#include "netmesh.h"
#include "ratio.hpp"

namespace {

// A field of /proc/self/status that is given in kB.
double mebibytes(const std::string& field) {
    std::ifstream status("/proc/self/status");
    for (std::string name; status >> name;) {
        double kibibytes = 0.0;
        if (name == field + ":" && status >> kibibytes) return kibibytes / 1024;
    }
    std::fprintf(stderr, "/proc/self/status has no %s\n", field.c_str());
    std::exit(1);
}

double resident() { return mebibytes("VmRSS"); }
double peak() { return mebibytes("VmHWM"); }

// From here on the peak is that of what follows.
void forget_peak() {
    std::ofstream clear("/proc/self/clear_refs");
    clear << 5;
    clear.close();
    if (clear.fail()) std::printf("the peak cannot be reset here: it is that of the whole process\n");
}

int measure(unsigned dim, std::size_t n) {
    const PointSet input = generate("uniform", dim, n);
    malloc_trim(0);
    const double before = resident();
    forget_peak();
    nm_mesh* mesh = nullptr;
    require(nm_mesh_create(dim, n, input.coordinates.data(), 0, &mesh), "nm_mesh_create");
    const double create_peak = peak();
    malloc_trim(0);
    const double created = resident();

    forget_peak();
    require(nm_run(mesh, nullptr), "nm_run");
    const double run_peak = peak();
    // free() keeps what lies below the heap's end; what the mesh needs is what is left without that.
    const double ended = resident();
    malloc_trim(0);
    const double trimmed = resident();

    nm_counts counts = NM_COUNTS_INIT;
    require(nm_mesh_counts(mesh, &counts), "nm_mesh_counts");
    nm_stats stats = NM_STATS_INIT;
    require(nm_mesh_stats(mesh, &stats), "nm_mesh_stats");
    const auto per_simplex = [&](double now) {
        return (now - before) * 1048576 / static_cast<double>(counts.simplices);
    };
    std::printf("uniform %zu, %uD: %zu vertices, %zu simplices, %.3f s\n", n, dim,
                static_cast<std::size_t>(counts.vertices), static_cast<std::size_t>(counts.simplices),
                stats.seconds);
    std::printf("%-34s %10s %18s\n", "", "MiB", "bytes per simplex");
    std::printf("%-34s %10.1f\n", "before nm_mesh_create, points too", before);
    std::printf("%-34s %10.1f\n", "peak of nm_mesh_create", create_peak);
    std::printf("%-34s %10.1f %18.1f\n", "after it", created, per_simplex(created));
    std::printf("%-34s %10.1f %18.1f\n", "peak of nm_run", run_peak, per_simplex(run_peak));
    std::printf("%-34s %10.1f %18.1f\n", "after it", ended, per_simplex(ended));
    std::printf("%-34s %10.1f %18.1f\n", "after malloc_trim(0)", trimmed, per_simplex(trimmed));
    nm_mesh_free(mesh);
    malloc_trim(0);
    std::printf("%-34s %10.1f\n\n", "after nm_mesh_free", resident());
    return 0;
}

bool measured(unsigned dim, std::size_t n) {
    const std::string trouble = in_child(0, [&] { return measure(dim, n); });
    if (!trouble.empty()) std::fprintf(stderr, "uniform %zu, %uD: %s\n", n, dim, trouble.c_str());
    return trouble.empty();
}

}  // namespace

int main(int count, char** arguments) {
    if (count == 1) {
        const bool in_space = measured(3, 1000000);
        return measured(2, 1000000) && in_space ? 0 : 1;
    }
    const int dim = std::atoi(arguments[1]);
    const long n = count == 3 ? std::atol(arguments[2]) : 0;
    if (dim < NM_MIN_DIM || dim > NM_MAX_DIM || n < 2) {
        std::fprintf(stderr, "usage: memory_use [<dim> <n>]\n");
        return 2;
    }
    return measured(static_cast<unsigned>(dim), static_cast<std::size_t>(n)) ? 0 : 1;
}
