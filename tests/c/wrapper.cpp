// Additions of netmesh.hpp to the C interface: ownership, exceptions, vectors. Argument: a directory.

#include <cstdint>
#include <iostream>
#include <sstream>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "netmesh.hpp"

static int failures = 0;

#define CHECK(condition)                                                        \
    do {                                                                        \
        if (!(condition)) {                                                     \
            std::cerr << "wrapper.cpp:" << __LINE__ << ": " #condition << '\n'; \
            ++failures;                                                         \
        }                                                                       \
    } while (false)

static_assert(!std::is_copy_constructible<netmesh::mesh>::value, "move-only");
static_assert(!std::is_copy_assignable<netmesh::mesh>::value, "move-only");
static_assert(std::is_nothrow_move_constructible<netmesh::mesh>::value, "for vectors");
static_assert(std::is_nothrow_move_assignable<netmesh::mesh>::value, "for vectors");

template <typename Body>
static nm_status status_of(Body body) {
    try {
        body();
    } catch (const netmesh::error &error) {
        CHECK(error.what()[0] != '\0');
        return error.status();
    }
    return NM_OK;
}

static std::vector<double> make_points(int count) {
    std::vector<double> points;
    std::uint32_t state = 3;
    for (int i = 0; i < 3 * count; ++i) {
        state = state * 1664525u + 1013904223u;
        points.push_back(static_cast<double>(state >> 8) / 16777216.0);
    }
    return points;
}

static void test_before_a_run() {
    std::vector<double> points = {0, 0, 1, 0, 0, 1, 0, 0};
    netmesh::mesh mesh(2, points);
    CHECK(mesh.dim() == 2 && mesh.counts().inputs == 4 && mesh.counts().vertices == 3);
    CHECK(mesh.points().flat() == std::vector<double>({0, 0, 1, 0, 0, 1}));
    CHECK(mesh.input_vertices() == std::vector<std::uint32_t>({0, 1, 2, 0}));
    CHECK(mesh.vertex_inputs() == std::vector<std::uint32_t>({0, 1, 2}));
    CHECK(mesh.vertex_kinds() == std::vector<std::uint8_t>(3, NM_VERTEX_INPUT));
    CHECK(mesh.domains().empty());
    CHECK(status_of([&] { mesh.simplices(); }) == NM_STATE);
    CHECK(status_of([&] { mesh.quality(); }) == NM_STATE);
    CHECK(status_of([&] { mesh.quality_histogram(NM_MEASURE_ASPECT, std::vector{1.0}); }) ==
          NM_STATE);
    CHECK(status_of([&] { netmesh::mesh odd(3, points); }) == NM_INVALID_ARGUMENT);
    CHECK(status_of([&] { netmesh::mesh none(0, points); }) == NM_DIMENSION);
    CHECK(status_of([&] { netmesh::mesh::from_file("no/such.xyz"); }) == NM_IO);
}

static void test_moves() {
    netmesh::mesh first(3, make_points(10));
    const nm_mesh *handle = first.get();
    netmesh::mesh second(std::move(first));
    CHECK(second.get() == handle && first.get() == nullptr);
    CHECK(status_of([&] { first.counts(); }) == NM_NULL_ARGUMENT);
    first = netmesh::mesh(3, make_points(20));
    CHECK(first.counts().inputs == 20);
    first = std::move(second);
    CHECK(first.get() == handle && first.counts().inputs == 10);
    netmesh::mesh &self = first;
    first = std::move(self);
    CHECK(first.get() == handle);
    netmesh::mesh third(first.release());
    CHECK(third.get() == handle && first.get() == nullptr);
}

static void test_run() {
    netmesh::mesh mesh(3, make_points(6000));  // enough for the run to be reported on
    int reports = 0;
    double fraction = -1;
    netmesh::options options;
    options.seed = 5;
    options.progress = [&](const nm_progress &progress) {
        ++reports;
        CHECK(progress.fraction >= fraction);
        fraction = progress.fraction;
        return true;
    };
    mesh.run(options);
    CHECK(reports > 0);
    nm_counts counts = mesh.counts();
    CHECK(mesh.left_out().edges + mesh.left_out().faces + mesh.left_out().cells == 0);
    CHECK(mesh.simplices().size() == counts.simplices && counts.simplices > 0);
    CHECK(mesh.neighbors().size() == counts.simplices && mesh.neighbors().width() == 4);
    CHECK(mesh.points().size() == counts.vertices && mesh.points().width() == 3);
    CHECK(mesh.vertex_domains().size() == counts.vertices);
    CHECK(mesh.precision_limited().size() == counts.vertices);
    CHECK(mesh.domains().size() == counts.domains);
    CHECK(mesh.stats().input_vertices == 6000);
    CHECK(mesh.quality().max_degree > 0);
    const std::vector<double> edges = {0, 30, 180};
    const netmesh::histogram some = mesh.quality_histogram(NM_MEASURE_DIHEDRAL_ANGLE, edges);
    const netmesh::histogram all = mesh.quality_histogram(NM_MEASURE_DIHEDRAL_ANGLE, edges, true);
    CHECK(all.counts.size() == 4 && all.counts[1] + all.counts[2] == 6 * counts.simplices);
    CHECK(some.counts[1] > 0 && some.counts[1] < all.counts[1]);
    CHECK(some.least == mesh.quality().min_angle_degrees && some.largest < 180);
    CHECK(mesh.try_quality_histogram(NM_MEASURE_ASPECT, {}).status() == NM_INVALID_ARGUMENT);
    nm_report report = mesh.validate();
    CHECK(report.level == 3 && report.violations == 0);
    if (report.violations > 0) {
        std::cerr << report.message << '\n';
    }
    netmesh::table<std::uint32_t> simplices = mesh.simplices();
    options.progress = [](const nm_progress &) { return false; };
    CHECK(status_of([&] { mesh.run(options); }) == NM_CANCELLED);
    bool rethrown = false;
    options.progress = [](const nm_progress &) -> bool { throw std::runtime_error("mine"); };
    try {
        mesh.run(options);
    } catch (const std::runtime_error &error) {
        rethrown = std::string(error.what()) == "mine";
    }
    CHECK(rethrown);
    CHECK(mesh.simplices() == simplices);
    options.epsilon = 7;
    CHECK(status_of([&] { mesh.run(options); }) == NM_INVALID_ARGUMENT);
}

static void test_export(const std::string &directory) {
    netmesh::mesh mesh(3, make_points(50));
    std::ostringstream stream, pieces;
    mesh.run();
    mesh.save(directory + "/mesh.vtu");
    mesh.write(NM_FORMAT_VTU, stream);
    CHECK(!stream.str().empty());
    mesh.write(NM_FORMAT_VTU, [&](const char *data, std::size_t size) {
        pieces.write(data, static_cast<std::streamsize>(size));
        return true;
    });
    CHECK(pieces.str() == stream.str());
    auto refuse = [](const char *, std::size_t) { return false; };
    CHECK(status_of([&] { mesh.write(NM_FORMAT_VTU, refuse); }) == NM_IO);
    CHECK(status_of([&] { mesh.write(NM_FORMAT_VTU, nullptr); }) == NM_NULL_ARGUMENT);
    bool rethrown = false;
    try {
        mesh.write(NM_FORMAT_VTU, [](const char *, std::size_t) -> bool { throw 17; });
    } catch (int thrown) {
        rethrown = thrown == 17;
    }
    CHECK(rethrown);
}

int main(int argc, char **argv) {
    if (argc != 2) {
        return 2;
    }
    try {
        test_before_a_run();
        test_moves();
        test_run();
        test_export(argv[1]);
    } catch (const std::exception &error) {
        std::cerr << "uncaught: " << error.what() << '\n';
        return 1;
    }
    if (failures == 0) {
        std::cout << "the wrapper holds\n";
    }
    return failures != 0;
}
