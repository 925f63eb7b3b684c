// Options, progress and cancellation; errors as exceptions and as values.
#include "must.hpp"

#include <chrono>

using std::chrono::steady_clock;

static void mesh_with_a_bound(netmesh::mesh &mesh) {
    int reports = 0;
    // [options]
    const auto end = steady_clock::now() + std::chrono::seconds(60);
    netmesh::options options;
    options.output = NM_OUTPUT_WELL_SPACED;
    options.criterion = NM_CRITERION_RADIUS_EDGE;
    options.quality_bound = 1.8;
    options.progress = [&](const nm_progress &progress) {
        ++reports;
        std::cerr << '\r' << static_cast<int>(100 * progress.fraction) << " %";
        return steady_clock::now() < end;  // false cancels
    };
    mesh.run(options);
    // [end]
    std::cerr << '\n';
    expect(reports > 0, "the progress function was called");
    expect(mesh.quality().worst_radius_edge <= 1.8, "the bound holds");
}

static void cancel(netmesh::mesh &mesh) {
    const std::uint64_t before = mesh.counts().vertices;
    // [values]
    netmesh::options options;
    options.progress = [](const nm_progress &) { return false; };
    const netmesh::result<void> done = mesh.try_run(options);
    if (!done) {  // NM_CANCELLED, and the mesh is as it was
        std::cerr << nm_status_name(done.status()) << ": " << done.message() << '\n';
    }
    // [end]
    expect(done.status() == NM_CANCELLED, "the run was cancelled");
    expect(mesh.counts().vertices == before, "a cancelled run leaves the mesh as it was");
}

static void limit(netmesh::mesh &mesh) {
    netmesh::options options;
    options.max_vertices = 5001;
    try {
        mesh.run(options);
    } catch (const netmesh::error &error) {
        expect(error.status() == NM_LIMIT, "the run stopped at max_vertices");
        return;
    }
    expect(false, "a run beyond its limit throws");
}

static void control() {
    netmesh::mesh mesh(3, uniform_points(5000, 3));
    mesh_with_a_bound(mesh);
    cancel(mesh);
    limit(mesh);
}

int main() { return run_example(control); }
