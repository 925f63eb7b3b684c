// netmesh.hpp: meshes that free themselves, errors as exceptions and as values, arrays as ranges.
//
//   cpp_wrapper <directory for its files>
#include <netmesh.hpp>

#include <algorithm>
#include <array>
#include <cstdio>
#include <iostream>
#include <iterator>
#include <memory>
#include <set>
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
// Spans of what may change come from what stays; of constants from temporaries too.
static_assert(std::is_convertible_v<std::vector<double>, netmesh::span<const double>>);
static_assert(std::is_convertible_v<std::vector<double>&, netmesh::span<double>>);
static_assert(!std::is_convertible_v<std::vector<double>, netmesh::span<double>>);
static_assert(!std::is_convertible_v<const std::vector<double>&, netmesh::span<double>>);
static_assert(!std::is_convertible_v<std::vector<float>&, netmesh::span<const double>>);
static_assert(std::is_convertible_v<netmesh::span<double>, netmesh::span<const double>>);
// A field that nm_options got has to be in netmesh::options too.
static_assert(sizeof(nm_options) == 184 + 4 * sizeof(void*));

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

template <class Result>
void expect_failure(int line, nm_status expected, const char* word, const Result& result) {
    check::that(!result && !result.has_value(), __FILE__, line, "it fails");
    check::that(result.status() == expected, __FILE__, line, "status", result.status_name());
    check::that(result.message().find(word) != std::string::npos, __FILE__, line, "message", result.message());
    check::that(result.message().find('\0') == std::string::npos, __FILE__, line, "no NUL in the message");
}

void a_whole_job(const std::string& directory) {
    const PointSet points = generate("uniform", 3, 300);
    netmesh::mesh mesh(3, points.coordinates);
    CHECK_EQUAL(mesh.dim(), 3u);
    mesh.run();
    const nm_counts counts = mesh.counts();
    CHECK_EQUAL(counts.inputs, 300u);
    CHECK_EQUAL(mesh.points().size(), counts.vertices);
    CHECK_EQUAL(mesh.points().width(), 3u);
    CHECK_EQUAL(mesh.simplices().size(), counts.simplices);
    CHECK_EQUAL(mesh.simplices().width(), 4u);
    CHECK_EQUAL(mesh.neighbors().size(), counts.simplices);
    CHECK_EQUAL(mesh.neighbors().width(), 4u);
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
    CHECK(mesh.to_string(NM_FORMAT_OFF) == off.str());
}

// Each way over a mesh's arrays says the same.
void ranges() {
    const PointSet points = generate("uniform", 3, 100);
    netmesh::mesh mesh(3, points.coordinates);
    mesh.run();
    const netmesh::table<double> vertices = mesh.points();
    const netmesh::table<std::uint32_t> simplices = mesh.simplices(), neighbors = mesh.neighbors();
    std::size_t s = 0, shared = 0;
    for (const netmesh::span<const std::uint32_t> simplex : simplices) {
        CHECK_EQUAL(simplex.size(), 4u);
        CHECK(std::equal(simplex.begin(), simplex.end(), simplices[s].begin()));
        CHECK(simplex.data() == simplices.data() + 4 * s);
        for (std::size_t i = 0; i < 4; ++i) {
            if (neighbors[s][i] == NM_NONE) continue;
            // The neighbour opposite vertex i has the other three.
            const std::set<std::uint32_t> own(simplex.begin(), simplex.end());
            for (const std::uint32_t vertex : simplices[neighbors[s][i]]) shared += own.count(vertex);
            CHECK(std::count(simplices[neighbors[s][i]].begin(), simplices[neighbors[s][i]].end(), simplex[i]) == 0);
            shared -= 3;
        }
        ++s;
    }
    CHECK_EQUAL(s, simplices.size());
    CHECK_EQUAL(shared, 0u);
    for (std::size_t v = 0; v < points.size(); ++v) {
        CHECK(std::equal(vertices[v].begin(), vertices[v].end(), points.point(v)));
    }
    const auto first = vertices.begin(), last = vertices.end();
    CHECK_EQUAL(static_cast<std::size_t>(last - first), vertices.size());
    CHECK(first[2].data() == vertices[2].data() && (first + 2)->data() == vertices[2].data());
    CHECK((last - 1)->data() == vertices[vertices.size() - 1].data() && first < last && !(last <= first));
    auto walk = first;
    CHECK((*walk++).data() == vertices[0].data() && (*walk--).data() == vertices[1].data() && walk == first);
    CHECK((*++walk).data() == vertices[1].data() && (*--walk).data() == vertices[0].data());

    const netmesh::table<double> none;
    CHECK(none.empty() && none.begin() == none.end() && none.end() - none.begin() == 0);
    CHECK(vertices == mesh.points() && vertices != none);
    const double* memory = vertices.data();
    netmesh::table<double> moved = mesh.points();
    memory = moved.data();
    CHECK(std::move(moved).flat().data() == memory);  // moved out, not copied

    // The tree of domains: parents first.
    std::uint32_t index = 0;
    for (const nm_domain& domain : mesh.domains()) {
        CHECK(index == 0 ? domain.parent == NM_NONE : domain.parent < index);
        CHECK(domain.center < vertices.size() && domain.radius > 0);
        ++index;
    }
    CHECK(index > 0);
}

void spans() {
    const double array[] = {0, 0, 1, 0, 0, 1};
    const std::array<double, 6> standard{0, 0, 1, 0, 0, 1};
    const netmesh::span<const double> of_pointer(array, 6);
    CHECK_EQUAL(netmesh::mesh(2, array).counts().inputs, 3u);
    CHECK_EQUAL(netmesh::mesh(2, standard).counts().inputs, 3u);
    CHECK_EQUAL(netmesh::mesh(2, of_pointer).counts().inputs, 3u);
    CHECK_EQUAL(netmesh::mesh(2, std::vector<double>(array, array + 6)).counts().inputs, 3u);
    CHECK_EQUAL(netmesh::mesh(2, array, 2, 4).counts().inputs, 2u);  // every four doubles
    CHECK(of_pointer.front() == 0 && of_pointer.back() == 1 && of_pointer[2] == 1 && !of_pointer.empty());
    CHECK(netmesh::span<double>().empty());
}

void defaults() {
    nm_options library;
    REQUIRE_OK(nm_options_init(&library, sizeof library));
    const netmesh::options ours;
    CHECK(ours.output == library.output && ours.algorithm == library.algorithm);
    CHECK(ours.ordering == library.ordering && ours.criterion == library.criterion);
    CHECK(ours.threads == library.threads && ours.quality_bound == library.quality_bound);
    CHECK(ours.epsilon == library.epsilon && ours.delta == library.delta && ours.gamma == library.gamma);
    CHECK(ours.yield_radius == library.yield_radius && ours.encroachment == library.encroachment);
    CHECK(ours.cage_scale == library.cage_scale && ours.root_scale == library.root_scale);
    CHECK(ours.seed == library.seed && ours.max_vertices == library.max_vertices);
    CHECK(!ours.progress && library.progress == nullptr && !ours.instruments && library.instruments == 0);
    CHECK(ours.min_angle == library.min_angle);
    CHECK(ours.extent == library.extent && ours.crossings == library.crossings);
    CHECK(ours.interior == library.interior);
    CHECK(ours.max_edge == library.max_edge && !ours.size && library.size == nullptr);
    CHECK(ours.size_from_curvature == library.size_from_curvature);
    CHECK(ours.min_dihedral == library.min_dihedral && ours.gives_way == library.gives_way);
}

// Every option arrives: those with a range are refused by name, the others change the result.
void every_option_arrives() {
    const PointSet points = generate("uniform", 3, 200);
    netmesh::mesh mesh(3, points.coordinates);
    const auto refused = [&](int line, const char* name, auto set) {
        netmesh::options options;
        set(options);
        expect_error(line, NM_INVALID_ARGUMENT, name, [&] { mesh.run(options); });
    };
    using netmesh::options;
    refused(__LINE__, "quality_bound", [](options& o) { o.quality_bound = -1; });
    refused(__LINE__, "epsilon", [](options& o) { o.epsilon = -1; });
    refused(__LINE__, "delta", [](options& o) { o.delta = -1; });
    refused(__LINE__, "gamma", [](options& o) { o.gamma = -1; });
    refused(__LINE__, "yield_radius", [](options& o) { o.yield_radius = -1; });
    refused(__LINE__, "encroachment", [](options& o) { o.encroachment = -1; });
    refused(__LINE__, "cage_scale", [](options& o) { o.cage_scale = -1; });
    refused(__LINE__, "root_scale", [](options& o) { o.root_scale = -1; });
    refused(__LINE__, "min_angle", [](options& o) { o.min_angle = 20; });  // in 2D only
    refused(__LINE__, "min_dihedral", [](options& o) { o.min_dihedral = -1; });
    refused(__LINE__, "max_edge", [](options& o) { o.max_edge = -1; });
    refused(__LINE__, "size_from_curvature", [](options& o) { o.size_from_curvature = 1; });  // of facets
    refused(__LINE__, "size answers", [](options& o) {
        o.output = NM_OUTPUT_WELL_SPACED;
        o.size = [](const double*) { return 0.0; };
    });
    refused(__LINE__, "output", [](options& o) { o.output = static_cast<nm_output>(77); });
    refused(__LINE__, "algorithm", [](options& o) { o.algorithm = static_cast<nm_algorithm>(77); });
    refused(__LINE__, "ordering", [](options& o) { o.ordering = static_cast<nm_ordering>(77); });
    refused(__LINE__, "gives_way", [](options& o) { o.gives_way = static_cast<nm_gives_way>(77); });
    refused(__LINE__, "extent", [](options& o) { o.extent = static_cast<nm_extent>(77); });
    refused(__LINE__, "crossings", [](options& o) { o.crossings = static_cast<nm_crossings>(77); });
    refused(__LINE__, "interior", [](options& o) { o.interior = NM_INTERIOR_PARITY; });  // of curves
    refused(__LINE__, "coplanar", [](options& o) { o.coplanar = 11; });
    refused(__LINE__, "criterion", [](options& o) { o.criterion = static_cast<nm_criterion>(77); });
    options limited;
    limited.max_vertices = 201;
    expect_error(__LINE__, NM_LIMIT, "max_vertices", [&] { mesh.run(limited); });
    expect_error(__LINE__, NM_STATE, "no result", [&] { mesh.options_of_run(); });
    mesh.run();
    const auto usual = mesh.points();
    const options resolved = mesh.options_of_run();
    CHECK(resolved.output == NM_OUTPUT_HIERARCHICAL && resolved.extent == NM_EXTENT_ALL);
    CHECK(resolved.quality_bound == 4 && !resolved.instruments && !resolved.progress);
    CHECK_EQUAL(mesh.stats().max_ply, 0u);
    options seeded;
    seeded.seed = 99;
    seeded.instruments = true;
    seeded.threads = 0;
    mesh.run(seeded);
    CHECK(mesh.points() != usual);
    CHECK(mesh.stats().max_ply > 0);
    CHECK(mesh.options_of_run().seed == 99 && mesh.options_of_run().instruments);
    options angled;
    angled.min_dihedral = 5;
    mesh.run(angled);
    CHECK_EQUAL(mesh.options_of_run().output, NM_OUTPUT_WELL_SPACED);
}

void progress_and_moves() {
    const PointSet points = generate("gaussian", 3, 5000);  // some tenths of a second: progress is seen
    netmesh::mesh first(3, points.coordinates.data(), points.size());
    auto reports = std::make_unique<int>(0);
    netmesh::options options;
    options.output = NM_OUTPUT_WELL_SPACED;
    options.quality_bound = 5;
    options.progress = [&](const nm_progress& progress) {
        CHECK(progress.fraction <= 1);
        return ++*reports, true;
    };
    first.run(options);
    CHECK_EQUAL(first.counts().domains, 1u);
    CHECK(*reports > 0);
    const auto simplices = first.simplices();
    netmesh::mesh second = std::move(first);
    CHECK(second.simplices() == simplices);
    expect_error(__LINE__, NM_NULL_ARGUMENT, "mesh", [&] { first.counts(); });
    first = std::move(second);
    CHECK(first.simplices() == simplices);
    netmesh::mesh& itself = first;
    first = std::move(itself);
    CHECK(first.simplices() == simplices);
    nm_mesh_free(first.release());
    CHECK(first.get() == nullptr);
}

// Sizes by a function, at the inputs and on a background; what the function throws comes out.
void sizes() {
    const PointSet points = generate("uniform", 2, 50);
    netmesh::mesh mesh(2, points.coordinates);
    netmesh::options options;
    options.output = NM_OUTPUT_WELL_SPACED;
    const auto vertices = [&] {
        mesh.run(options);
        return mesh.counts().vertices;
    };
    const std::uint64_t plain = vertices();
    mesh.set_sizes(std::vector<double>(50, 0.05));
    const std::uint64_t sized = vertices();
    CHECK(sized > plain + 100);
    CHECK_EQUAL(mesh.sizes().size(), sized);
    CHECK_EQUAL(mesh.sizes().front(), 0.05);
    expect_error(__LINE__, NM_INVALID_ARGUMENT, "count is 49", [&] {
        mesh.set_sizes(std::vector<double>(49, 0.05));
    });
    mesh.set_sizes(std::vector<double>());
    CHECK_EQUAL(vertices(), plain);
    mesh.set_background(mesh, std::vector<double>(plain, 0.05));
    CHECK_EQUAL(vertices(), sized);
    mesh.remove_background();
    CHECK_EQUAL(vertices(), plain);
    options.size = [](const double* x) { return 0.05 + 0 * x[1]; };
    CHECK_EQUAL(vertices(), sized);
    options.max_edge = 0.05;
    CHECK(vertices() > sized);
    options.size = [](const double*) -> double { throw std::length_error("mine"); };
    bool caught = false;
    try {
        mesh.run(options);
    } catch (const std::length_error& error) {
        caught = std::string(error.what()) == "mine";
    }
    CHECK(caught);
}

void errors() {
    const std::vector<double> odd(5, 1.0);
    expect_error(__LINE__, NM_INVALID_ARGUMENT, "5", [&] { netmesh::mesh(2, odd); });
    expect_error(__LINE__, NM_DIMENSION, "dim", [&] { netmesh::mesh(0, odd); });
    expect_error(__LINE__, NM_IO, "missing", [] { netmesh::mesh::from_file("missing.xyz"); });
    const PointSet points = generate("uniform", 3, 5000);
    netmesh::mesh mesh(3, points.coordinates);
    expect_error(__LINE__, NM_STATE, "nm_run", [&] { mesh.simplices(); });
    expect_error(__LINE__, NM_NULL_ARGUMENT, "write", [&] { mesh.write(NM_FORMAT_XYZ, nullptr); });
    netmesh::options options;
    options.progress = [](const nm_progress&) { return false; };
    expect_error(__LINE__, NM_CANCELLED, "cancel", [&] { mesh.run(options); });
    // An exception of a callback comes out of run() itself, and the mesh still works.
    options.progress = [](const nm_progress&) -> bool { throw std::length_error("mine"); };
    bool caught = false;
    try {
        mesh.run(options);
    } catch (const std::length_error& error) {
        caught = std::string(error.what()) == "mine";
    }
    CHECK(caught);
    caught = false;
    try {
        mesh.write(NM_FORMAT_XYZ, [](const char*, std::size_t) -> bool { throw 17; });
    } catch (int thrown) {
        caught = thrown == 17;
    }
    CHECK(caught);
    expect_error(__LINE__, NM_IO, "", [&] { mesh.write(NM_FORMAT_XYZ, [](const char*, std::size_t) { return false; }); });
    std::ostringstream broken;
    broken.setstate(std::ios::badbit);
    expect_error(__LINE__, NM_IO, "", [&] { mesh.write(NM_FORMAT_XYZ, broken); });
    mesh.run();
    CHECK_EQUAL(mesh.validate().violations, 0u);
}

// Asks for results without exceptions.
void results(const std::string& directory) {
    using netmesh::mesh;
    const std::vector<double> odd(5, 1.0);
    expect_failure(__LINE__, NM_INVALID_ARGUMENT, "5", mesh::try_create(2, odd));
    expect_failure(__LINE__, NM_DIMENSION, "dim", mesh::try_create(9, odd.data(), 1));
    expect_failure(__LINE__, NM_IO, "missing", mesh::try_from_file("missing.xyz"));
    const PointSet points = generate("uniform", 2, 400);
    netmesh::result<mesh> made = mesh::try_create(2, points.coordinates);
    REQUIRE(made && made.has_value() && made.status() == NM_OK && made.message().empty());
    CHECK_EQUAL(std::string(made.status_name()), "NM_OK");
    expect_failure(__LINE__, NM_STATE, "nm_run", made->try_simplices());
    expect_failure(__LINE__, NM_STATE, "nm_run", made->try_neighbors());
    expect_failure(__LINE__, NM_STATE, "nm_run", made->try_quality());
    expect_failure(__LINE__, NM_STATE, "nm_run", made->try_stats());
    expect_failure(__LINE__, NM_STATE, "nm_run", made->try_validate());
    expect_failure(__LINE__, NM_STATE, "run", made->try_to_string(NM_FORMAT_OFF));
    expect_failure(__LINE__, NM_STATE, "run", made->try_save(directory + "/cpp_wrapper.off"));
    netmesh::options options;
    options.epsilon = 9;
    expect_failure(__LINE__, NM_INVALID_ARGUMENT, "epsilon", made->try_run(options));
    REQUIRE(made->try_run());
    const nm_counts counts = *made->try_counts();
    CHECK_EQUAL(made->try_points()->size(), counts.vertices);
    CHECK_EQUAL(made->try_simplices()->size(), counts.simplices);
    CHECK_EQUAL(made->try_neighbors()->size(), counts.simplices);
    CHECK_EQUAL(made->try_vertex_kinds()->size(), counts.vertices);
    CHECK_EQUAL(made->try_vertex_domains()->size(), counts.vertices);
    CHECK_EQUAL(made->try_precision_limited()->size(), counts.vertices);
    CHECK_EQUAL(made->try_input_vertices()->size(), 400u);
    CHECK_EQUAL(made->try_domains()->size(), counts.domains);
    CHECK_EQUAL(made->try_stats()->input_vertices, 400u);
    CHECK(made->try_quality()->max_degree > 2);
    const std::vector<double> edges = {1, 2};
    CHECK_EQUAL(made->try_quality_histogram(NM_MEASURE_ASPECT, edges)->counts.size(), 3u);
    CHECK_EQUAL(made->try_validate()->violations, 0u);
    expect_failure(__LINE__, NM_INVALID_ARGUMENT, "level", made->try_validate(7));
    std::ostringstream stream;
    CHECK(made->try_write(NM_FORMAT_OFF, stream));
    CHECK(*made->try_to_string(NM_FORMAT_OFF) == stream.str() && !stream.str().empty());
    mesh moved = *std::move(made);
    CHECK_EQUAL(moved.counts().vertices, counts.vertices);
    expect_failure(__LINE__, NM_NULL_ARGUMENT, "mesh", made->try_points());
    // value() throws what is missing.
    expect_error(__LINE__, NM_INVALID_ARGUMENT, "epsilon", [&] { moved.try_run(options).value(); });
    expect_error(__LINE__, NM_DIMENSION, "dim", [&] { mesh::try_create(9, odd.data(), 1).value(); });
    // A callback's own exception is the caller's, here too.
    options.epsilon = 0;
    options.progress = [](const nm_progress&) -> bool { throw 3; };
    bool caught = false;
    netmesh::mesh larger(3, generate("uniform", 3, 5000).coordinates);
    try {
        (void)larger.try_run(options);
    } catch (int thrown) {
        caught = thrown == 3;
    }
    CHECK(caught);
}

const std::vector<std::vector<std::uint32_t>> sides = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4},
                                                       {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
const std::vector<double> cube = {0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0, 0, 0, 1, 1, 0, 1, 0, 1, 1, 1, 1, 1};

// A cube of one facet a side, with a label, by each of the ways to give facets.
void facets() {
    netmesh::mesh mesh(3, cube);
    const std::vector<std::int32_t> markers = {1, 2, 3, 4, 5, 6};
    mesh.set_facets(sides, markers);
    CHECK(mesh.intersections().empty());
    CHECK(mesh.odd_edges().empty());
    nm_region region = NM_REGION_INIT;
    region.label = 9;
    for (double& x : region.seed) x = 0.5;
    mesh.set_regions(netmesh::span<const nm_region>(&region, 1));
    expect_failure(__LINE__, NM_STATE, "nm_run", mesh.try_facet_triangles());
    expect_failure(__LINE__, NM_STATE, "nm_run", mesh.try_facet_parents());
    expect_failure(__LINE__, NM_STATE, "nm_run", mesh.try_facet_simplices());
    mesh.run();
    const auto triangles = mesh.facet_triangles(), simplices = mesh.facet_simplices();
    const auto parents = mesh.facet_parents();
    CHECK_EQUAL(triangles.size(), mesh.counts().facet_triangles);
    REQUIRE(triangles.size() >= 12 && parents.size() == triangles.size() && simplices.size() == triangles.size());
    CHECK(parents.front() == 0 && parents.back() == 5 && std::is_sorted(parents.begin(), parents.end()));
    const auto tetrahedra = mesh.simplices();
    for (std::size_t i = 0; i < triangles.size(); ++i) {
        // The sides look outwards.
        CHECK(simplices[i][0] == NM_NONE && simplices[i][1] < tetrahedra.size());
        const auto own = tetrahedra[simplices[i][1]];
        for (const std::uint32_t vertex : triangles[i]) {
            CHECK(std::count(own.begin(), own.end(), vertex) == 1);
        }
    }
    double volume = 0;
    for (const double one : mesh.volumes()) volume += one;
    CHECK(volume > 1 - 1e-12 && volume < 1 + 1e-12);
    for (const std::int32_t label : mesh.simplex_regions()) CHECK_EQUAL(label, 9);
    CHECK_EQUAL(mesh.flat_simplices().size(), mesh.quality().flat);
    CHECK_EQUAL(mesh.validate().violations, 0u);

    // Arrays, and triangles of which pairs are one facet, make the same mesh.
    const std::string first = mesh.to_string(NM_FORMAT_VTU);
    std::vector<std::uint64_t> loops, starts;
    std::vector<std::uint32_t> inputs, corners;
    for (std::uint64_t i = 0; i < 7; ++i) loops.push_back(i), starts.push_back(4 * i);
    for (const auto& side : sides) {
        inputs.insert(inputs.end(), side.begin(), side.end());
        corners.insert(corners.end(), {side[0], side[1], side[2], side[0], side[2], side[3]});
    }
    mesh.set_facets(loops, starts, inputs, markers);
    mesh.run();
    CHECK(mesh.to_string(NM_FORMAT_VTU) == first);
    mesh.set_triangles(corners);
    mesh.run();
    const auto of_triangles = mesh.facet_parents();
    CHECK(std::set<std::uint32_t>(of_triangles.begin(), of_triangles.end())
          == std::set<std::uint32_t>({0, 2, 4, 6, 8, 10}));
}

// A cube without a side gets one.
void holes() {
    netmesh::mesh mesh(3, cube);
    mesh.set_facets({sides.begin(), sides.end() - 1});
    CHECK_EQUAL(mesh.close_holes(3).open_edges, 4u);
    const nm_closed_holes closed = mesh.close_holes(4);
    CHECK(closed.holes == 1 && closed.triangles == 2 && closed.open_edges == 0);
    mesh.run();
    CHECK_EQUAL(mesh.facet_parents().back(), 6u);
    expect_failure(__LINE__, NM_INVALID_ARGUMENT, "max_edges", mesh.try_close_holes(2));
}

// A side that is not plane becomes triangles.
void bent_sides() {
    std::vector<double> points(cube.begin(), cube.end());
    points[18] += 0.1;
    netmesh::mesh mesh(3, points);
    mesh.set_facets({sides.begin(), sides.end()});
    expect_error(__LINE__, NM_INVALID_ARGUMENT, "plane", [&] { mesh.run(); });
    const std::uint64_t polygons = mesh.triangulate_facets();
    CHECK_EQUAL(polygons, 6u);
    mesh.run();
    CHECK(mesh.counts().simplices > 0);
}

// A corner that was written twice, with other roundings, is one.
void corners() {
    std::vector<double> points(cube.begin(), cube.end());
    points.insert(points.end(), {cube[0] + 1e-15, cube[1], cube[2]});
    const std::uint64_t moved = netmesh::merge_points(3, points);
    CHECK_EQUAL(moved, 1u);
    CHECK_EQUAL(points[24], cube[0]);
    expect_failure(__LINE__, NM_INVALID_ARGUMENT, "ratio", netmesh::try_merge_points(3, points, 0.5));
    expect_failure(__LINE__, NM_INVALID_ARGUMENT, "coordinates", netmesh::try_merge_points(2, points));
}

// Facets that cannot be are refused, and those that cross are told.
void facets_in_need() {
    netmesh::mesh mesh(3, cube);
    const std::vector<std::int32_t> markers = {1};
    const std::vector<std::uint64_t> loops = {0, 1}, starts = {0, 3}, short_starts = {0};
    const std::vector<std::uint32_t> triangle = {0, 1, 2}, crossing = {0, 3, 5, 1, 2, 7};
    const netmesh::span<const std::uint32_t> two(triangle.data(), 2);
    expect_failure(__LINE__, NM_INVALID_ARGUMENT, "markers", mesh.try_set_facets(sides, markers));
    expect_failure(__LINE__, NM_INVALID_ARGUMENT, "input_starts",
                   mesh.try_set_facets(loops, short_starts, triangle));
    expect_failure(__LINE__, NM_INVALID_ARGUMENT, "inputs", mesh.try_set_facets(loops, starts, two));
    expect_failure(__LINE__, NM_INVALID_ARGUMENT, "three", mesh.try_set_triangles(two));
    expect_failure(__LINE__, NM_INVALID_ARGUMENT, "three", mesh.try_set_triangles(crossing, markers));
    expect_failure(__LINE__, NM_INVALID_ARGUMENT, "facets[0]", mesh.try_set_facets({{0, 1}}));
    CHECK(mesh.try_set_facets(loops, starts, triangle, markers));
    CHECK(mesh.try_set_facets({}, {}, {}));
    mesh.set_triangles(crossing);
    const std::vector<nm_intersection> found = mesh.intersections();
    REQUIRE(found.size() == 1);
    CHECK(found[0].kind == NM_INTERSECTION_CROSS && found[0].first == 0 && found[0].second == 1);
    CHECK(found[0].first_feature == NM_FEATURE_FACET && found[0].struct_size == sizeof found[0]);
    const std::vector<nm_odd_edge> edges = mesh.odd_edges();
    REQUIRE(edges.size() == 6);
    CHECK(edges[0].fault == NM_EDGE_OPEN && edges[0].inputs[0] == 0 && edges[0].inputs[1] == 3);
    CHECK(edges[0].facets == 1 && edges[5].struct_size == sizeof edges[5]);
    expect_error(__LINE__, NM_INVALID_ARGUMENT, "cross", [&] { mesh.run(); });
    netmesh::mesh plane(2, generate("uniform", 2, 10).coordinates);
    expect_failure(__LINE__, NM_INVALID_ARGUMENT, "3D", plane.try_intersections());
    expect_failure(__LINE__, NM_INVALID_ARGUMENT, "3D", plane.try_odd_edges());
    expect_failure(__LINE__, NM_INVALID_ARGUMENT, "3D", plane.try_set_triangles(triangle));
}

}  // namespace

int main(int count, char** arguments) {
    if (count != 2) {
        std::cerr << "usage: cpp_wrapper <directory>\n";
        return 2;
    }
    a_whole_job(arguments[1]);
    ranges();
    spans();
    defaults();
    every_option_arrives();
    progress_and_moves();
    sizes();
    errors();
    results(arguments[1]);
    facets_in_need();
    facets();
    holes();
    bent_sides();
    corners();
    return check::result("cpp_wrapper");
}
