#include "cgal_mesh_2.hpp"

#include <CGAL/Constrained_Delaunay_triangulation_2.h>
#include <CGAL/Delaunay_mesh_face_base_2.h>
#include <CGAL/Delaunay_mesh_size_criteria_2.h>
#include <CGAL/Delaunay_mesh_vertex_base_2.h>
#include <CGAL/Delaunay_mesher_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/bounding_box.h>

#include <chrono>
#include <vector>

CgalTiming cgal_mesh_2(const double* points, std::size_t n, double radius_edge) {
    using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
    using Data = CGAL::Triangulation_data_structure_2<CGAL::Delaunay_mesh_vertex_base_2<Kernel>,
                                                      CGAL::Delaunay_mesh_face_base_2<Kernel>>;
    using Triangulation = CGAL::Constrained_Delaunay_triangulation_2<Kernel, Data>;
    using Criteria = CGAL::Delaunay_mesh_size_criteria_2<Triangulation>;
    std::vector<Kernel::Point_2> range;
    range.reserve(n);
    for (std::size_t i = 0; i < n; ++i) range.emplace_back(points[2 * i], points[2 * i + 1]);
    const Kernel::Iso_rectangle_2 box = CGAL::bounding_box(range.begin(), range.end());
    const auto start = std::chrono::steady_clock::now();
    Triangulation triangulation;
    triangulation.insert(range.begin(), range.end());
    for (int i = 0; i < 4; ++i) triangulation.insert_constraint(box[i], box[i + 1]);
    CGAL::Delaunay_mesher_2<Triangulation, Criteria> mesher(triangulation);
    // The squared sine of the least angle; 0 is no bound on sizes.
    mesher.set_criteria(Criteria(0.25 / (radius_edge * radius_edge), 0.0));
    mesher.refine_mesh();
    const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - start;
    return {elapsed.count(), triangulation.number_of_vertices(), triangulation.number_of_faces()};
}
