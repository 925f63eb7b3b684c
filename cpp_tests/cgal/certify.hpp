// Is this mesh the Delaunay triangulation of its vertices? Judged by CGAL alone: netmesh's own
// checker has no say here.
#ifndef NETMESH_TESTS_CERTIFY_HPP
#define NETMESH_TESTS_CERTIFY_HPP

#include <cstdint>
#include <string>
#include <vector>

#include "mesh.hpp"
#include "reference.hpp"

struct Certificate {
    std::uint64_t facets = 0;
    std::uint64_t hull_facets = 0;
    // Facets whose two simplices share one circumsphere: there the triangulation may differ.
    std::uint64_t ties = 0;
    // Per simplex: it has such a facet.
    std::vector<bool> has_tie;
    // Faults, with ids; empty if the mesh is certified.
    std::vector<std::string> violations;
};

// Every simplex positively oriented, adjacency symmetric, every interior facet locally Delaunay,
// the hull locally convex, the Euler characteristic of a ball. Together: a Delaunay triangulation
// of the convex hull.
Certificate certify(const ExportedMesh& mesh, const Reference& reference);

struct Comparison {
    std::uint64_t ours = 0;
    std::uint64_t theirs = 0;
    // Simplices of ours that CGAL's triangulation does not have.
    std::uint64_t differing = 0;
    // Simplices among them whose circumsphere is strictly empty, which every Delaunay
    // triangulation must have.
    std::uint64_t inexcusable = 0;
    // Sum of the simplices' volumes, relative to CGAL's.
    double volume_ratio = 0.0;
};

// Compares sets of sorted tuples of vertex ids.
Comparison compare(const ExportedMesh& mesh, const Certificate& certificate,
                   const Reference& reference);

#endif
