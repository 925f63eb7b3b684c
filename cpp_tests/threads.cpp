// Two threads with two meshes give the bytes that one thread gives; many threads may read one mesh;
// the option `threads` changes nothing in the result.
#include <atomic>
#include <thread>
#include <vector>

#include "check.hpp"
#include "inputs.hpp"
#include "mesh.hpp"

namespace {

ExportedMesh run(const PointSet& points, nm_output output, std::uint32_t threads = 1) {
    const MeshHandle mesh = create(points);
    nm_options options = default_options();
    options.output = output;
    options.threads = threads;
    REQUIRE_OK(nm_run(mesh.get(), &options));
    return export_mesh(mesh.get());
}

void two_meshes_at_once() {
    const PointSet plane = generate("gaussian", 2, 4000);
    const PointSet space = generate("uniform", 3, 2000);
    const ExportedMesh plane_alone = run(plane, NM_OUTPUT_HIERARCHICAL);
    const ExportedMesh space_alone = run(space, NM_OUTPUT_WELL_SPACED);
    CHECK(plane_alone.simplex_count() > 0 && space_alone.simplex_count() > 0);
    for (int repetition = 0; repetition < 3; ++repetition) {
        ExportedMesh plane_beside;
        ExportedMesh space_beside;
        std::thread one([&] { plane_beside = run(plane, NM_OUTPUT_HIERARCHICAL); });
        std::thread two([&] { space_beside = run(space, NM_OUTPUT_WELL_SPACED); });
        one.join();
        two.join();
        CHECK(plane_beside == plane_alone);
        CHECK(space_beside == space_alone);
    }
}

void concurrent_readers() {
    const PointSet points = generate("uniform", 3, 2000);
    const MeshHandle mesh = create(points);
    REQUIRE_OK(nm_run(mesh.get(), nullptr));
    const ExportedMesh expected = export_mesh(mesh.get());
    const double aspect = quality_of(mesh.get()).worst_aspect;
    std::vector<std::thread> readers;
    for (int reader = 0; reader < 4; ++reader) {
        readers.emplace_back([&] {
            for (int repetition = 0; repetition < 5; ++repetition) {
                CHECK(export_mesh(mesh.get()) == expected);
                CHECK_EQUAL(quality_of(mesh.get()).worst_aspect, aspect);
                check_certificate(mesh.get());
            }
        });
    }
    for (std::thread& reader : readers) reader.join();
}

// One thread's failure must not show in another's message.
void messages_are_per_thread() {
    std::atomic<int> failed_calls{0};
    const auto fail = [&](std::uint32_t dim, const char* number) {
        const double points[2] = {0, 0};
        nm_mesh* mesh = nullptr;
        CHECK_STATUS(nm_mesh_create(dim, 1, points, 0, &mesh), NM_DIMENSION);
        ++failed_calls;
        while (failed_calls < 2) std::this_thread::yield();
        CHECK_SAYING(check::last_error().find(number) != std::string::npos, check::last_error());
    };
    std::thread one(fail, 77u, "77");
    std::thread two(fail, 99u, "99");
    one.join();
    two.join();
}

void option_threads() {
    const PointSet points = generate("uniform", 2, 4000);
    const ExportedMesh one = run(points, NM_OUTPUT_HIERARCHICAL, 1);
    for (const std::uint32_t threads : {0u, 2u, 3u}) {
        CHECK(run(points, NM_OUTPUT_HIERARCHICAL, threads) == one);
    }
}

}  // namespace

int main() {
    two_meshes_at_once();
    concurrent_readers();
    messages_are_per_thread();
    option_threads();
    return check::result("threads");
}
