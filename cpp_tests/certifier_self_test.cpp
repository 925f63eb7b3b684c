// The referee must be able to say no: sound triangulations pass, and each way of damaging one is
// seen.
#include <iostream>
#include <string>
#include <utility>

#include "certify.hpp"
#include "check.hpp"
#include "inputs.hpp"
#include "mesh.hpp"
#include "reference.hpp"

namespace {

ExportedMesh delaunay_of(const PointSet& points) {
    const MeshHandle mesh = create(points);
    nm_options options = default_options();
    options.algorithm = NM_ALGORITHM_DELAUNAY;
    REQUIRE_OK(nm_run(mesh.get(), &options));
    return export_mesh(mesh.get());
}

// The first simplex with, or without, a facet on the hull.
std::size_t find_simplex(const ExportedMesh& mesh, bool on_hull) {
    for (std::size_t s = 0; s < mesh.simplex_count(); ++s) {
        bool hull = false;
        for (unsigned i = 0; i <= mesh.dim; ++i) hull = hull || mesh.neighbors_of(s)[i] == NM_NONE;
        if (hull == on_hull) return s;
    }
    REQUIRE(false);
    return 0;
}

void swap_vertices(ExportedMesh& mesh) {
    std::uint32_t* vertices = mesh.simplices.data() + find_simplex(mesh, false) * (mesh.dim + 1);
    std::swap(vertices[0], vertices[1]);
}

void cut_adjacency(ExportedMesh& mesh) {
    mesh.neighbors[find_simplex(mesh, false) * (mesh.dim + 1)] = NM_NONE;
}

// Keeps every orientation, as long as the step is small, but not the empty spheres for long.
void move_vertex(ExportedMesh& mesh) {
    const std::uint32_t vertex = mesh.simplex(find_simplex(mesh, false))[0];
    for (unsigned k = 0; k < mesh.dim; ++k) mesh.points[vertex * mesh.dim + k] += 0.05;
}

void name_a_stranger(ExportedMesh& mesh) { mesh.simplices[0] = static_cast<std::uint32_t>(mesh.vertex_count()); }

void leave_a_vertex_out(ExportedMesh& mesh) {
    for (unsigned k = 0; k < mesh.dim; ++k) mesh.points.push_back(0.5);
    mesh.kinds.push_back(NM_VERTEX_STEINER);
}

// Takes a simplex off the hull and closes the gap in the numbering: a dent.
void dent_the_hull(ExportedMesh& mesh) {
    const unsigned per_simplex = mesh.dim + 1;
    const auto gone = static_cast<std::uint32_t>(find_simplex(mesh, true));
    const auto last = static_cast<std::uint32_t>(mesh.simplex_count() - 1);
    for (std::uint32_t& neighbor : mesh.neighbors) {
        if (neighbor == gone) neighbor = NM_NONE;
    }
    for (std::uint32_t& neighbor : mesh.neighbors) {
        if (neighbor == last) neighbor = gone;
    }
    for (unsigned i = 0; i < per_simplex; ++i) {
        mesh.simplices[gone * per_simplex + i] = mesh.simplices[last * per_simplex + i];
        mesh.neighbors[gone * per_simplex + i] = mesh.neighbors[last * per_simplex + i];
    }
    mesh.simplices.resize(last * per_simplex);
    mesh.neighbors.resize(last * per_simplex);
}

struct Damage {
    const char* name;
    void (*apply)(ExportedMesh&);
};

constexpr Damage damages[] = {
    {"two vertices swapped", swap_vertices},      {"a neighbour forgotten", cut_adjacency},
    {"a vertex moved", move_vertex},            {"an id out of range", name_a_stranger},
    {"a vertex left out", leave_a_vertex_out},  {"a dent in the hull", dent_the_hull},
};

void judge(unsigned dim) {
    const ExportedMesh sound = delaunay_of(generate("uniform", dim, 200));
    const auto reference = make_reference(dim, sound.points.data(), sound.vertex_count());
    const Certificate certificate = certify(sound, *reference);
    CHECK(certificate.violations.empty());
    const Comparison comparison = compare(sound, certificate, *reference);
    CHECK_EQUAL(comparison.differing, 0u);
    CHECK_EQUAL(comparison.ours, comparison.theirs);
    for (const Damage& damage : damages) {
        check::context = std::to_string(dim) + "D, " + damage.name;
        ExportedMesh damaged = sound;
        damage.apply(damaged);
        const auto witness = make_reference(dim, damaged.points.data(), damaged.vertex_count());
        const Certificate verdict = certify(damaged, *witness);
        if (CHECK(!verdict.violations.empty())) {
            std::cout << check::context << ": " << verdict.violations.front() << std::endl;
        }
    }
}

}  // namespace

int main() {
    for (unsigned dim = 2; dim <= 4; ++dim) judge(dim);
    return check::result("certifier_self_test");
}
