// Many meshes at once, many readers of one mesh, and one mutator at a time, which is checked: a call
// that comes at the wrong time answers NM_STATE and changes nothing.
//
//   concurrency [number of meshes at once, at most and by default 64]
#include <atomic>
#include <chrono>
#include <cstdlib>
#include <functional>
#include <iostream>
#include <thread>
#include <vector>

#include "check.hpp"
#include "every_getter.hpp"
#include "jobs.hpp"

namespace {

constexpr int thread_count = 16;

// Runs `body` with the thread's number on all threads; they begin together.
void on_all_threads(const std::function<void(int)>& body) {
    std::atomic<int> waiting{thread_count};
    std::vector<std::thread> threads;
    for (int number = 0; number < thread_count; ++number) {
        threads.emplace_back([&, number] {
            --waiting;
            while (waiting > 0) std::this_thread::yield();
            body(number);
        });
    }
    for (std::thread& thread : threads) thread.join();
}

void many_meshes_at_once(std::size_t count) {
    std::vector<Job> all = jobs();
    REQUIRE(count > 0 && count <= all.size());
    all.resize(count);
    const std::vector<std::uint64_t> expected = hash_all(all);
    std::cout << hexadecimal(hash_of(expected)) << "  " << all.size() << " meshes, one after the other\n";
    // Whoever is free takes the next one; the second time in another order.
    for (const std::size_t step : {std::size_t{1}, std::size_t{37}}) {
        std::vector<MeshHandle> meshes;
        for (const Job& job : all) meshes.push_back(create_job(job));
        std::vector<std::uint64_t> hashes(all.size());
        std::atomic<std::size_t> next{0};
        on_all_threads([&](int) {
            for (std::size_t k; (k = next++) < all.size();) {
                const std::size_t i = k * step % all.size();
                run_job(all[i], meshes[i].get());
                hashes[i] = hash_of(meshes[i].get());
            }
        });
        check_same(all, hashes, expected, "at once");
        std::cout << hexadecimal(hash_of(hashes)) << "  " << thread_count << " threads at once\n";
    }
}

// A mesh that is made on one thread, run on another and freed on a third.
void handles_travel() {
    const Job job = jobs().front();
    MeshHandle mesh;
    std::thread([&] { mesh = create_job(job); }).join();
    std::thread([&] { run_job(job, mesh.get()); }).join();
    const std::uint64_t hash = hash_of(mesh.get());
    std::thread([&] { mesh.reset(); }).join();
    const MeshHandle here = create_job(job);
    run_job(job, here.get());
    CHECK(hash_of(here.get()) == hash);
}

void many_readers() {
    const MeshHandle mesh = create(generate("uniform", 3, 80));
    REQUIRE_OK(nm_run(mesh.get(), nullptr));
    const std::uint64_t expected = hash_of(mesh.get());
    const double aspect = quality_of(mesh.get()).worst_aspect;
    on_all_threads([&](int number) {
        for (int repetition = 0; repetition < 2; ++repetition) {
            CHECK(hash_of(mesh.get()) == expected);
            CHECK_EQUAL(quality_of(mesh.get()).worst_aspect, aspect);
            // From a different one on each thread, so that different ones meet.
            every_getter(mesh.get(), NM_OK, number);
        }
        if (number % 4 == 0) check_certificate(mesh.get());
    });
}

// Observations of the progress callback and of another thread on a mesh at work.
struct AtWork {
    nm_mesh* mesh;
    std::atomic<int> reports{0};
};

std::int32_t try_everything(const nm_progress*, void* user_data) {
    auto& at_work = *static_cast<AtWork*>(user_data);
    if (at_work.reports++ > 0) return 0;
    const auto refused = [&] {
        every_getter(at_work.mesh, NM_STATE, 0);
        CHECK_STATUS(nm_run(at_work.mesh, nullptr), NM_STATE);
        CHECK_SAYING(check::last_error().find("mesh") == 0, check::last_error());
    };
    refused();
    // The run waits in its callback while the others try, so they do come during it.
    on_all_threads([&](int) { refused(); });
    return 0;
}

void a_run_has_its_mesh_alone() {
    const PointSet points = generate("gaussian", 3, 100);
    const MeshHandle mesh = create(points);
    REQUIRE_OK(nm_run(mesh.get(), nullptr));
    const std::uint64_t expected = hash_of(mesh.get());
    AtWork at_work{mesh.get()};
    nm_options options = default_options();
    options.progress = try_everything;
    options.user_data = &at_work;
    CHECK_STATUS(nm_run(mesh.get(), &options), NM_OK);
    CHECK(at_work.reports > 0);
    CHECK(hash_of(mesh.get()) == expected);
    every_getter(mesh.get(), NM_OK, 0);
}

// nm_run from within a getter that calls back, and beside it.
void a_run_waits_for_no_getter() {
    const MeshHandle mesh = create(generate("uniform", 2, 50));
    REQUIRE_OK(nm_run(mesh.get(), nullptr));
    const std::uint64_t expected = hash_of(mesh.get());
    const nm_write_fn write = [](const void*, std::size_t, void* user_data) -> std::int32_t {
        auto* const exported = static_cast<nm_mesh*>(user_data);
        CHECK_STATUS(nm_run(exported, nullptr), NM_STATE);
        on_all_threads([&](int number) {
            CHECK_STATUS(nm_run(exported, nullptr), NM_STATE);
            every_getter(exported, NM_OK, number);
        });
        return 0;
    };
    CHECK_STATUS(nm_export_write(mesh.get(), NM_FORMAT_OFF, write, mesh.get()), NM_OK);
    CHECK(hash_of(mesh.get()) == expected);
    CHECK_STATUS(nm_run(mesh.get(), nullptr), NM_OK);
}

// Runs and getters at random moments: each one either has its turn or is refused, and whatever a
// getter hands out is of one and the same mesh.
void runs_and_getters_collide() {
    constexpr int runners = thread_count / 4;
    const MeshHandle mesh = create(generate("uniform", 2, 50));
    REQUIRE_OK(nm_run(mesh.get(), nullptr));
    const ExportedMesh expected = export_mesh(mesh.get());
    std::atomic<unsigned> ran{0}, read{0}, refused{0};
    std::atomic<int> running{runners};
    const auto count = [&](nm_status status, std::atomic<unsigned>& successes) {
        CHECK(status == NM_OK || status == NM_STATE);
        ++(status == NM_OK ? successes : refused);
        // Nobody waits in the library: a reader that never paused might never let a runner in.
        std::this_thread::sleep_for(std::chrono::microseconds(100));
        return status == NM_OK;
    };
    on_all_threads([&](int number) {
        if (number < runners) {
            for (int runs = 0; runs < 3;) runs += count(nm_run(mesh.get(), nullptr), ran);
            --running;
            return;
        }
        std::vector<double> points(expected.points.size());
        while (running > 0) {
            points.assign(points.size(), -1.0);
            const auto size = static_cast<std::uint64_t>(points.size());
            if (count(nm_mesh_get_points(mesh.get(), points.data(), size, nullptr), read)) {
                CHECK(points == expected.points);
            }
        }
    });
    CHECK_EQUAL(ran, 3u * runners);
    CHECK(export_mesh(mesh.get()) == expected);
    std::cout << ran << " runs, " << read << " reads, " << refused << " refused\n";
}

// One thread's failure must not show in another's message.
void messages_are_per_thread() {
    std::atomic<int> failed_calls{0};
    on_all_threads([&](int number) {
        const double points[2] = {0, 0};
        const unsigned dim = 100 + static_cast<unsigned>(number);
        nm_mesh* mesh = nullptr;
        CHECK_STATUS(nm_mesh_create(dim, 1, points, 0, &mesh), NM_DIMENSION);
        ++failed_calls;
        while (failed_calls < thread_count) std::this_thread::yield();
        const std::string message = check::last_error();
        CHECK_SAYING(message.find(std::to_string(dim)) != std::string::npos, message);
    });
}

}  // namespace

int main(int count, char** arguments) {
    many_meshes_at_once(count > 1 ? std::strtoul(arguments[1], nullptr, 10) : 64);
    handles_travel();
    many_readers();
    a_run_has_its_mesh_alone();
    a_run_waits_for_no_getter();
    runs_and_getters_collide();
    messages_are_per_thread();
    return check::result("concurrency");
}
