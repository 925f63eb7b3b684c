#include <CGAL/Delaunay_triangulation.h>
#include <CGAL/Epick_d.h>

#include <chrono>
#include <iterator>
#include <vector>

#include "cgal_insert.hpp"

CgalTiming cgal_insert_4(const double* points, std::size_t n) {
    using Kernel = CGAL::Epick_d<CGAL::Dimension_tag<4>>;
    std::vector<Kernel::Point_d> range;
    range.reserve(n);
    for (std::size_t i = 0; i < n; ++i) range.emplace_back(points + 4 * i, points + 4 * (i + 1));
    const auto start = std::chrono::steady_clock::now();
    CGAL::Delaunay_triangulation<Kernel> triangulation(4);
    triangulation.insert(range.begin(), range.end());
    const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - start;
    const auto finite = std::distance(triangulation.finite_full_cells_begin(), triangulation.finite_full_cells_end());
    return {elapsed.count(), triangulation.number_of_vertices(), static_cast<std::size_t>(finite)};
}
