// The surface through points, through netmesh/surface.hpp: each number against what the facets say.
#include <netmesh/surface.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "check.hpp"

namespace {

constexpr std::size_t on_torus = 2400;

// Points of a torus of radii 2 and 1 on a twisted grid, and two far from it.
std::vector<double> torus() {
    const double turn = 6.283185307179586;
    std::vector<double> points;
    for (std::size_t i = 0; i < on_torus; ++i) {
        const double u = turn * (double(i % 60) / 60), v = turn * (double(i / 60) / 40 + double(i % 60) / 2400);
        const double reach = 2 + std::cos(v);
        points.insert(points.end(), {reach * std::cos(u), reach * std::sin(u), std::sin(v)});
    }
    points.insert(points.end(), {0, 0, 9, 0, 0, -9});
    return points;
}

netmesh::mesh triangulated(std::uint32_t dim, const std::vector<double>& points) {
    netmesh::mesh mesh(dim, points);
    netmesh::options options;
    options.algorithm = NM_ALGORITHM_DELAUNAY;
    mesh.run(options);
    return mesh;
}

void check_torus(const std::string& scratch) {
    const std::vector<double> points = torus();
    const netmesh::mesh mesh = triangulated(3, points);
    const netmesh::surface surface(mesh);
    const nm_surface measures = surface.measures();
    CHECK(measures.shells == 1 && measures.handles == 1 && measures.vertices == on_torus);
    CHECK(measures.facets == 2 * on_torus && measures.left_out == 2);
    CHECK(surface.left_out() == (std::vector<std::uint32_t>{on_torus, on_torus + 1}));
    CHECK(surface.genera() == std::vector<std::uint64_t>{1});

    // Each edge is there once in each direction, and the divergence theorem has the volume.
    std::set<std::pair<std::uint32_t, std::uint32_t>> edges;
    double volume = 0;
    const auto facets = surface.facets();
    for (auto facet : facets) {
        for (int k = 0; k < 3; ++k) {
            CHECK(edges.emplace(facet[k], facet[(k + 1) % 3]).second);
        }
        const double *a = &points[3 * facet[0]], *b = &points[3 * facet[1]], *c = &points[3 * facet[2]];
        volume += a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) +
                  a[2] * (b[0] * c[1] - b[1] * c[0]);
    }
    for (const auto& edge : edges) {
        CHECK(edges.count({edge.second, edge.first}) == 1);
    }
    CHECK(std::abs(volume / 6 - measures.volume) < 1e-9 * measures.volume);
    const double smooth = 2 * 9.869604401089358 * 2;
    CHECK(std::abs(measures.volume / smooth - 1) < 0.02);

    const auto insides = surface.insides();
    CHECK(insides.size() == mesh.counts().simplices);
    CHECK(std::count(insides.begin(), insides.end(), std::uint8_t(1)) > 0);
    const nm_report report = surface.validate();
    CHECK(report.violations == 0 && report.level == 3);
    surface.save(scratch + "/torus.stl");
}

// Half of a sphere, which ends once and has the same points on it.
void check_bowl() {
    std::vector<double> points;
    for (int i = 0; i < 1000; ++i) {
        const double z = (i + 0.5) / 1000, turn = 2.399963229728653 * i, reach = std::sqrt(1 - z * z);
        points.insert(points.end(), {reach * std::cos(turn), reach * std::sin(turn), z});
    }
    const netmesh::mesh mesh = triangulated(3, points);
    const netmesh::surface surface(mesh, NM_SURFACE_OPEN);
    const nm_surface measures = surface.measures();
    CHECK(measures.shells == 1 && measures.ends == 1 && measures.one_sided == 0 && measures.volume == 0);
    CHECK(measures.left_out == 0 && measures.handles == 0);
    std::set<std::pair<std::uint32_t, std::uint32_t>> edges;
    for (auto facet : surface.facets()) {
        for (int k = 0; k < 3; ++k) {
            CHECK(edges.emplace(facet[k], facet[(k + 1) % 3]).second);
        }
    }
    const auto alone = std::count_if(edges.begin(), edges.end(), [&](const std::pair<std::uint32_t, std::uint32_t>& e) {
        return edges.count({e.second, e.first}) == 0;
    });
    CHECK(static_cast<std::uint64_t>(alone) == 2 * measures.vertices - 2 - measures.facets && alone > 10);
    const auto sampling = surface.sampling();
    std::uint64_t needed = 0;
    std::vector<double> copied(1000);
    CHECK(nm_mesh_get_surface_sampling(mesh.get(), NM_SURFACE_OPEN, copied.data(), copied.size(), &needed) == NM_OK);
    CHECK(needed == 1000 && copied == sampling);
    CHECK(sampling.size() == 1000);
    CHECK(static_cast<std::uint64_t>(std::count_if(sampling.begin(), sampling.end(), [](double r) { return r > 1; })) ==
          measures.sparse);
    CHECK(*std::min_element(sampling.begin(), sampling.end()) > 0.01);
    CHECK(surface.validate().violations == 0);
    CHECK(netmesh::surface(mesh).measures().ends == 0);
}

void check_refusals() {
    const std::vector<double> square = {0, 0, 1, 0, 1, 1, 0, 1};
    const netmesh::mesh mesh = triangulated(2, square);
    CHECK(netmesh::surface(mesh).measures().volume == 1);
    const auto saved = netmesh::surface(mesh).try_save("square.stl");
    CHECK(!saved && saved.status() == NM_INVALID_ARGUMENT);
    netmesh::mesh refined(2, square);
    const auto early = netmesh::surface(refined).try_measures();
    CHECK(!early && early.status() == NM_STATE);
    refined.run();
    const auto wrong = netmesh::surface(refined).try_facets();
    CHECK(!wrong && wrong.status() == NM_INVALID_ARGUMENT);
}

// The functions of C that the header stands on, and their array getters' rules.
void check_c_functions(const std::string& scratch) {
    const netmesh::mesh held = triangulated(3, torus());
    const nm_mesh* mesh = held.get();
    nm_surface measures = NM_SURFACE_INIT;
    nm_report report = NM_REPORT_INIT;
    CHECK(nm_mesh_surface(mesh, NM_SURFACE_CLOSED, &measures) == NM_OK && measures.handles == 1);
    CHECK(nm_mesh_surface(mesh, NM_SURFACE_CLOSED, nullptr) == NM_NULL_ARGUMENT);
    CHECK(nm_mesh_validate_surface(mesh, NM_SURFACE_CLOSED, &report) == NM_OK && report.violations == 0);
    std::uint64_t needed = 0;
    CHECK(nm_mesh_get_surface_facets(mesh, NM_SURFACE_CLOSED, nullptr, 0, &needed) == NM_OK && needed == 3 * measures.facets);
    CHECK(nm_mesh_get_surface_left_out(mesh, NM_SURFACE_CLOSED, nullptr, 0, &needed) == NM_OK && needed == 2);
    CHECK(nm_mesh_get_surface_genera(mesh, NM_SURFACE_CLOSED, nullptr, 0, &needed) == NM_OK && needed == 1);
    CHECK(nm_mesh_get_surface_insides(mesh, nullptr, 0, &needed) == NM_OK);
    CHECK(needed == held.counts().simplices);
    std::uint32_t one = 7;
    CHECK(nm_mesh_get_surface_left_out(mesh, NM_SURFACE_CLOSED, &one, 1, &needed) == NM_CAPACITY && one == 7);
    CHECK(nm_export_surface(mesh, NM_SURFACE_CLOSED, (scratch + "/torus.obj").c_str()) == NM_OK);
    CHECK(nm_export_surface(mesh, NM_SURFACE_CLOSED, "torus.vtu") == NM_INVALID_ARGUMENT);
}

}  // namespace

int main(int argc, char** argv) {
    CHECK(argc == 2);
    check_torus(argv[1]);
    check_bowl();
    check_refusals();
    check_c_functions(argv[1]);
    return 0;
}
