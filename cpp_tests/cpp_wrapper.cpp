// netmesh.hpp: handles that free themselves, errors as exceptions, arrays as vectors.
//
//   cpp_wrapper <directory for its files>
#include <netmesh.hpp>

#include <cstdio>
#include <iostream>
#include <sstream>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "check.hpp"
#include "inputs.hpp"

namespace {

static_assert(!std::is_copy_constructible_v<netmesh::mesh> && !std::is_copy_assignable_v<netmesh::mesh>);
static_assert(std::is_nothrow_move_constructible_v<netmesh::mesh>);
static_assert(std::is_nothrow_move_assignable_v<netmesh::mesh>);

template <class Call>
void expect_error(int line, nm_status expected, const char* word, Call call) {
    try {
        call();
        check::that(false, __FILE__, line, "it throws");
    } catch (const netmesh::error& error) {
        check::that(error.status() == expected, __FILE__, line, "status", error.status_name());
        check::that(std::string(error.what()).find(word) != std::string::npos, __FILE__, line, "message",
                    error.what());
    }
}

void a_whole_job(const std::string& directory) {
    const PointSet points = generate("uniform", 3, 300);
    netmesh::mesh mesh(3, points.coordinates);
    CHECK_EQUAL(mesh.dim(), 3u);
    mesh.run();
    const nm_counts counts = mesh.counts();
    CHECK_EQUAL(counts.inputs, 300u);
    CHECK_EQUAL(mesh.points().size(), counts.vertices * 3);
    CHECK_EQUAL(mesh.simplices().size(), counts.simplices * 4);
    CHECK_EQUAL(mesh.neighbors().size(), counts.simplices * 4);
    CHECK_EQUAL(mesh.vertex_kinds().size(), counts.vertices);
    CHECK_EQUAL(mesh.vertex_domains().size(), counts.vertices);
    CHECK_EQUAL(mesh.precision_limited().size(), counts.vertices);
    CHECK_EQUAL(mesh.input_vertices().size(), 300u);
    CHECK_EQUAL(mesh.domains().size(), counts.domains);
    CHECK_EQUAL(mesh.stats().input_vertices, 300u);
    CHECK_AT_MOST(mesh.quality().worst_aspect, 4.0 * (1 + 1e-7));
    CHECK_EQUAL(mesh.validate().violations, 0u);
    CHECK_EQUAL(mesh.validate(2).level, 2u);

    const std::string path = directory + "/cpp_wrapper.xyz";
    mesh.save(path);
    CHECK_EQUAL(netmesh::mesh::from_file(path).counts().inputs, counts.vertices);
    std::remove(path.c_str());
    std::ostringstream off;
    mesh.write(NM_FORMAT_OFF, off);
    CHECK(!off.str().empty());
}

void options_and_moves() {
    const PointSet points = generate("gaussian", 3, 5000);  // some tenths of a second: progress is seen
    netmesh::mesh first(3, points.coordinates.data(), points.size());
    int reports = 0;
    first.run(netmesh::options().output(NM_OUTPUT_WELL_SPACED).quality_bound(5).seed(7).instruments(true).progress(
        [&](const nm_progress&) { return ++reports, true; }));
    CHECK_EQUAL(first.counts().domains, 1u);
    CHECK(reports > 0);
    CHECK(first.stats().max_ply > 0);
    const auto simplices = first.simplices();
    netmesh::mesh second = std::move(first);
    CHECK(second.simplices() == simplices);
    expect_error(__LINE__, NM_NULL_ARGUMENT, "mesh", [&] { first.counts(); });
    first = std::move(second);
    CHECK(first.simplices() == simplices);
    nm_mesh_free(first.release());
    CHECK(first.get() == nullptr);
}

void errors() {
    const std::vector<double> odd(5, 1.0);
    expect_error(__LINE__, NM_INVALID_ARGUMENT, "5", [&] { netmesh::mesh(2, odd); });
    expect_error(__LINE__, NM_IO, "missing", [] { netmesh::mesh::from_file("missing.xyz"); });
    const PointSet points = generate("uniform", 3, 5000);
    netmesh::mesh mesh(3, points.coordinates);
    expect_error(__LINE__, NM_STATE, "nm_run", [&] { mesh.simplices(); });
    expect_error(__LINE__, NM_INVALID_ARGUMENT, "quality_bound",
                 [&] { mesh.run(netmesh::options().quality_bound(0.5)); });
    expect_error(__LINE__, NM_CANCELLED, "cancel", [&] {
        mesh.run(netmesh::options().progress([](const nm_progress&) { return false; }));
    });
    // What a callback throws comes out of run() itself, and the mesh still works.
    bool caught = false;
    try {
        mesh.run(netmesh::options().progress(
            [](const nm_progress&) -> bool { throw std::length_error("mine"); }));
    } catch (const std::length_error& error) {
        caught = std::string(error.what()) == "mine";
    }
    CHECK(caught);
    mesh.run();
    CHECK_EQUAL(mesh.validate().violations, 0u);
}

}  // namespace

int main(int count, char** arguments) {
    if (count != 2) {
        std::cerr << "usage: cpp_wrapper <directory>\n";
        return 2;
    }
    a_whole_job(arguments[1]);
    options_and_moves();
    errors();
    return check::result("cpp_wrapper");
}
