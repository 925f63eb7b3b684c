#include <CGAL/Delaunay_triangulation_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <chrono>
#include <vector>

#include "cgal_insert.hpp"

CgalTiming cgal_insert_2(const double* points, std::size_t n) {
    using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
    std::vector<Kernel::Point_2> range;
    range.reserve(n);
    for (std::size_t i = 0; i < n; ++i) range.emplace_back(points[2 * i], points[2 * i + 1]);
    const auto start = std::chrono::steady_clock::now();
    CGAL::Delaunay_triangulation_2<Kernel> triangulation;
    triangulation.insert(range.begin(), range.end());
    const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - start;
    return {elapsed.count(), triangulation.number_of_vertices(), triangulation.number_of_faces()};
}
