#include "mesh.hpp"

#include <algorithm>
#include <cstring>

#include "check.hpp"

namespace {

// Asks for the size, then for the data, as a caller would.
template <class Item, class Getter>
std::vector<Item> get(const nm_mesh* mesh, Getter getter, std::uint64_t expected) {
    std::uint64_t needed = 0;
    REQUIRE_OK(getter(mesh, nullptr, 0, &needed));
    CHECK_EQUAL(needed, expected);
    std::vector<Item> items(needed);
    REQUIRE_OK(getter(mesh, items.data(), items.size(), &needed));
    CHECK_EQUAL(needed, items.size());
    return items;
}

template <class Item>
bool same_bytes(const std::vector<Item>& a, const std::vector<Item>& b) {
    return a.size() == b.size()
           && (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(Item)) == 0);
}

}  // namespace

nm_options default_options() {
    nm_options options;
    REQUIRE_OK(nm_options_init(&options, sizeof options));
    return options;
}

MeshHandle create(const PointSet& points) {
    nm_mesh* mesh = nullptr;
    REQUIRE_OK(nm_mesh_create(points.dim, points.size(), points.coordinates.data(), 0, &mesh));
    return MeshHandle(mesh);
}

nm_counts counts_of(const nm_mesh* mesh) {
    auto counts = sized<nm_counts>();
    REQUIRE_OK(nm_mesh_counts(mesh, &counts));
    return counts;
}

nm_quality quality_of(const nm_mesh* mesh) {
    auto quality = sized<nm_quality>();
    REQUIRE_OK(nm_mesh_quality(mesh, &quality));
    return quality;
}

nm_stats stats_of(const nm_mesh* mesh) {
    auto stats = sized<nm_stats>();
    REQUIRE_OK(nm_mesh_stats(mesh, &stats));
    return stats;
}

bool operator==(const ExportedMesh& a, const ExportedMesh& b) {
    return a.dim == b.dim && same_bytes(a.points, b.points) && same_bytes(a.simplices, b.simplices)
           && same_bytes(a.neighbors, b.neighbors) && same_bytes(a.kinds, b.kinds)
           && same_bytes(a.vertex_domains, b.vertex_domains)
           && same_bytes(a.input_vertices, b.input_vertices)
           && same_bytes(a.domain_radii, b.domain_radii)
           && same_bytes(a.domain_centers, b.domain_centers)
           && same_bytes(a.domain_parents, b.domain_parents);
}

ExportedMesh export_mesh(const nm_mesh* mesh) {
    const nm_counts counts = counts_of(mesh);
    const std::uint64_t entries = counts.simplices * (counts.dim + 1);
    ExportedMesh out;
    out.dim = counts.dim;
    out.points = get<double>(mesh, nm_mesh_get_points, counts.vertices * counts.dim);
    out.simplices = get<std::uint32_t>(mesh, nm_mesh_get_simplices, entries);
    out.neighbors = get<std::uint32_t>(mesh, nm_mesh_get_neighbors, entries);
    out.kinds = get<std::uint8_t>(mesh, nm_mesh_get_vertex_kinds, counts.vertices);
    out.vertex_domains = get<std::uint32_t>(mesh, nm_mesh_get_vertex_domains, counts.vertices);
    out.input_vertices = get<std::uint32_t>(mesh, nm_mesh_get_input_vertices, counts.inputs);
    for (const nm_domain& domain : get<nm_domain>(mesh, nm_mesh_get_domains, counts.domains)) {
        out.domain_radii.push_back(domain.radius);
        out.domain_centers.push_back(domain.center);
        out.domain_parents.push_back(domain.parent);
    }
    return out;
}

void check_inputs_kept(const PointSet& points, const nm_mesh* mesh, const ExportedMesh& exported) {
    const nm_counts counts = counts_of(mesh);
    CHECK_EQUAL(counts.inputs, points.size());
    REQUIRE(exported.input_vertices.size() == points.size());
    const std::size_t bytes = points.dim * sizeof(double);
    std::uint32_t distinct = 0;
    for (std::size_t i = 0; i < points.size(); ++i) {
        const std::uint32_t vertex = exported.input_vertices[i];
        REQUIRE(vertex <= distinct && vertex < exported.vertex_count());
        const bool first = vertex == distinct;
        distinct += first;
        const double* given = points.point(i);
        const double* kept = exported.point(vertex);
        const bool same = first ? std::memcmp(given, kept, bytes) == 0
                                : std::equal(given, given + points.dim, kept);
        CHECK_SAYING(same, "input " + std::to_string(i) + ", vertex " + std::to_string(vertex));
        if (exported.kinds[vertex] != NM_VERTEX_INPUT) {
            CHECK_SAYING(false, "kind of input " + std::to_string(i));
        }
    }
    CHECK_EQUAL(counts.duplicates, points.size() - distinct);
    for (std::size_t v = distinct; v < exported.vertex_count(); ++v) {
        if (exported.kinds[v] == NM_VERTEX_INPUT) {
            CHECK_SAYING(false, "vertex " + std::to_string(v) + " says input and is none");
        }
    }
}

void check_certificate(const nm_mesh* mesh, std::uint32_t level) {
    auto report = sized<nm_report>();
    REQUIRE_OK(nm_mesh_validate(mesh, level, &report));
    CHECK_SAYING(report.violations == 0, report.message);
    CHECK_EQUAL(report.level, level);
    CHECK(report.checked > 0);
}

double default_aspect_bound(unsigned dim) {
    return dim == 2 ? 3.0 : dim == 3 ? 4.0 : dim == 4 ? 5.0 : 6.0;
}
