// The plain task of the ratio: CGAL's Delaunay triangulation of given points, spatially sorted by
// CGAL itself, with the kernel its users would take.
#ifndef NETMESH_BENCH_CGAL_INSERT_HPP
#define NETMESH_BENCH_CGAL_INSERT_HPP

#include <cstddef>

struct CgalTiming {
    double seconds = 0.0;        // the insertion of the range, nothing else
    std::size_t vertices = 0;
    std::size_t simplices = 0;
};

CgalTiming cgal_insert_2(const double* points, std::size_t n);
CgalTiming cgal_insert_3(const double* points, std::size_t n);
CgalTiming cgal_insert_4(const double* points, std::size_t n);

#endif
