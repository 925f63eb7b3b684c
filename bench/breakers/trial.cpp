#include "trial.hpp"

#include <sys/resource.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstring>
#include <vector>

#include "heap.hpp"

namespace {

// Remembers the answer and its message; true if it is NM_OK.
bool answered(Outcome& outcome, nm_status status) {
    outcome.status = status;
    if (status != NM_OK) nm_last_error(outcome.message, sizeof outcome.message);
    return status == NM_OK;
}

// Input by input: its vertex is there, says that it is an input and has the coordinates given, with
// their bits where it is the first of its kind.
std::uint64_t count_kept(const PointSet& points, const nm_mesh* mesh) {
    std::uint64_t coordinates = 0, vertices = 0, inputs = 0;
    nm_mesh_get_points(mesh, nullptr, 0, &coordinates);
    nm_mesh_get_vertex_kinds(mesh, nullptr, 0, &vertices);
    nm_mesh_get_input_vertices(mesh, nullptr, 0, &inputs);
    if (inputs != points.size() || coordinates != vertices * points.dim) return 0;
    std::vector<double> kept(coordinates);
    std::vector<std::uint8_t> kinds(vertices);
    std::vector<std::uint32_t> vertex_of(inputs);
    if (nm_mesh_get_points(mesh, kept.data(), kept.size(), nullptr) != NM_OK
        || nm_mesh_get_vertex_kinds(mesh, kinds.data(), kinds.size(), nullptr) != NM_OK
        || nm_mesh_get_input_vertices(mesh, vertex_of.data(), vertex_of.size(), nullptr) != NM_OK) {
        return 0;
    }
    std::uint64_t count = 0;
    std::uint32_t distinct = 0;
    for (std::size_t i = 0; i < points.size(); ++i) {
        const std::uint32_t vertex = vertex_of[i];
        if (vertex > distinct || vertex >= vertices || kinds[vertex] != NM_VERTEX_INPUT) continue;
        const double* given = points.point(i);
        const double* found = kept.data() + std::size_t{vertex} * points.dim;
        const bool first = vertex == distinct;
        distinct += first;
        count += first ? std::memcmp(given, found, points.dim * sizeof(double)) == 0
                       : std::equal(given, given + points.dim, found);
    }
    return count;
}

std::uint64_t resident_peak() {
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    return static_cast<std::uint64_t>(usage.ru_maxrss) * 1024;
}

// Creates and runs; measures both together.
bool mesh_it(const Trial& trial, const PointSet& points, nm_mesh** mesh, Outcome& outcome) {
    nm_options options;
    if (!answered(outcome, nm_options_init(&options, sizeof options))) return false;
    options.output = trial.output;
    options.max_vertices = trial.max_vertices;
    const std::size_t before = heap::restart();
    const auto start = std::chrono::steady_clock::now();
    outcome.stage = Stage::creating;
    bool good = answered(outcome, nm_mesh_create(points.dim, points.size(), points.coordinates.data(), 0, mesh));
    if (good) {
        outcome.stage = Stage::running;
        good = answered(outcome, nm_run(*mesh, &options));
    }
    const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - start;
    outcome.seconds = elapsed.count();
    outcome.heap_bytes = heap::peak() - before;
    outcome.resident_bytes = resident_peak();
    return good;
}

}  // namespace

const char* stage_name(Stage stage) {
    switch (stage) {
        case Stage::generating: return "making the points";
        case Stage::creating: return "nm_mesh_create";
        case Stage::running: return "nm_run";
        case Stage::validating: return "nm_mesh_validate";
        case Stage::done: return "the end";
    }
    return "?";
}

void run_trial(const Trial& trial, Outcome& outcome) {
    const PointSet points = trial.what.points();
    outcome.inputs = points.size();
    nm_mesh* mesh = nullptr;
    if (mesh_it(trial, points, &mesh, outcome)) {
        nm_counts counts = NM_COUNTS_INIT;
        nm_stats stats = NM_STATS_INIT;
        nm_report report = NM_REPORT_INIT;
        bool good = answered(outcome, nm_mesh_counts(mesh, &counts)) && answered(outcome, nm_mesh_stats(mesh, &stats));
        outcome.vertices = counts.vertices;
        outcome.precision_limited = stats.precision_limited;
        outcome.inputs_kept = count_kept(points, mesh);
        outcome.stage = Stage::validating;
        good = good && answered(outcome, nm_mesh_validate(mesh, 3, &report));
        outcome.certificate_level = report.level;
        outcome.violations = report.violations;
        std::memcpy(outcome.violation, report.message, sizeof outcome.violation);
    }
    nm_mesh_free(mesh);
    outcome.stage = Stage::done;
}
