// The peers of the experiments: points in, mesh out.
#ifndef NETMESH_EXPERIMENTS_PEERS_HPP
#define NETMESH_EXPERIMENTS_PEERS_HPP

#include <cstdint>
#include <vector>

#include "inputs.hpp"

struct PeerMesh {
    double seconds = 0.0;
    std::vector<double> points;
    std::vector<std::uint32_t> simplices;
};

// CGAL's Delaunay refinement of the points in a box of three times their bounding box.
PeerMesh refine_2(const PointSet& points, double radius_edge_bound);

// CGAL's Delaunay triangulation of the points alone, in the plane and in space.
PeerMesh delaunay(const PointSet& points);

#endif
