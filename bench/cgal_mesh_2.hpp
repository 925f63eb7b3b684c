// CGAL's Mesh_2 on points in their bounding box.
#ifndef NETMESH_BENCH_CGAL_MESH_2_HPP
#define NETMESH_BENCH_CGAL_MESH_2_HPP

#include <cstddef>

#include "cgal_insert.hpp"

// Triangulates the points and the edges of their box, and refines to that radius-edge ratio. The
// seconds are those of both.
CgalTiming cgal_mesh_2(const double* points, std::size_t n, double radius_edge);

#endif
