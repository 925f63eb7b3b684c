// The faces of a mesh and their alpha values by brute force, straight from the definitions.
#ifndef NETMESH_TESTS_ALPHA_VALUES_HPP
#define NETMESH_TESTS_ALPHA_VALUES_HPP

#include <cstddef>
#include <cstdint>
#include <map>
#include <vector>

#include "mesh.hpp"

// Vertices, ascending.
using Face = std::vector<std::uint32_t>;

// The faces of each dimension, with their numbers in lexicographic order.
using Faces = std::vector<std::map<Face, std::size_t>>;

Faces faces_of(const ExportedMesh& mesh);

// A face without one of its vertices.
Face without(const Face& face, std::size_t index);

// The centre and the squared radius of the smallest ball that has some points on its boundary.
struct Ball {
    std::vector<long double> center;
    long double square = 0;
};
Ball circumscribed(const ExportedMesh& mesh, const Face& face);

// The alpha value of each face, by dimension and number. The points are in general position.
std::vector<std::vector<long double>> alpha_values(const ExportedMesh& mesh, const Faces& faces);

// A plain Delaunay triangulation.
MeshHandle delaunay_of(const PointSet& points);

#endif
