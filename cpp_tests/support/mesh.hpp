// The C ABI as the tests use it: a handle that frees itself, and a mesh copied out of it. On
// purpose not netmesh.hpp: that wrapper is itself under test.
#ifndef NETMESH_TESTS_MESH_HPP
#define NETMESH_TESTS_MESH_HPP

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "inputs.hpp"
#include "netmesh.h"

struct MeshFree {
    void operator()(nm_mesh* mesh) const { nm_mesh_free(mesh); }
};
using MeshHandle = std::unique_ptr<nm_mesh, MeshFree>;

// Structs of the ABI with struct_size set.
template <class Struct>
Struct sized() {
    Struct value{};
    value.struct_size = sizeof(Struct);
    return value;
}

nm_options default_options();
MeshHandle create(const PointSet& points);

// Everything a mesh holds, as plain vectors; equality is equality of bytes.
struct ExportedMesh {
    unsigned dim = 0;
    std::vector<double> points;
    std::vector<std::uint32_t> simplices;
    std::vector<std::uint32_t> neighbors;
    std::vector<std::uint8_t> kinds;
    std::vector<std::uint32_t> vertex_domains;
    std::vector<std::uint32_t> input_vertices;
    std::vector<double> domain_radii;
    std::vector<std::uint32_t> domain_centers;
    std::vector<std::uint32_t> domain_parents;

    std::size_t vertex_count() const { return kinds.size(); }
    std::size_t simplex_count() const { return simplices.size() / (dim + 1); }
    const double* point(std::uint32_t vertex) const { return points.data() + std::size_t{vertex} * dim; }
    const std::uint32_t* simplex(std::size_t s) const { return simplices.data() + s * (dim + 1); }
    const std::uint32_t* neighbors_of(std::size_t s) const { return neighbors.data() + s * (dim + 1); }
};

bool operator==(const ExportedMesh& a, const ExportedMesh& b);

// Copies the mesh out; the sizes of all getters are checked against nm_mesh_counts.
ExportedMesh export_mesh(const nm_mesh* mesh);

nm_counts counts_of(const nm_mesh* mesh);
nm_quality quality_of(const nm_mesh* mesh);
nm_stats stats_of(const nm_mesh* mesh);

// Every input is a vertex with its own bits (-0.0 and 0.0 being one number); duplicates share one;
// the distinct inputs come first, in input order.
void check_inputs_kept(const PointSet& points, const nm_mesh* mesh, const ExportedMesh& exported);

// The certificate at level 3 (level 2 for plain Delaunay) without a violation.
void check_certificate(const nm_mesh* mesh, std::uint32_t level = 3);

// The default bound of the Voronoi aspect in a dimension.
double default_aspect_bound(unsigned dim);

#endif
