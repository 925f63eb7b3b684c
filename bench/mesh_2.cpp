// CGAL's Mesh_2 on a domain: mesh_2 DEGREES < DOMAIN prints how many vertices it has.
//
// DOMAIN is the counts of points, segments and holes, then the points, the segments by the numbers of
// their ends from 0, and a point in each hole, separated by white space. What Mesh_2 does not end is
// for the caller to end (python/tests/peers_of_segments.py).
#include <CGAL/Constrained_Delaunay_triangulation_2.h>
#include <CGAL/Delaunay_mesh_face_base_2.h>
#include <CGAL/Delaunay_mesh_size_criteria_2.h>
#include <CGAL/Delaunay_mesh_vertex_base_2.h>
#include <CGAL/Delaunay_mesher_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <iostream>
#include <vector>

namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Data = CGAL::Triangulation_data_structure_2<CGAL::Delaunay_mesh_vertex_base_2<Kernel>,
                                                  CGAL::Delaunay_mesh_face_base_2<Kernel>>;
using Triangulation = CGAL::Constrained_Delaunay_triangulation_2<Kernel, Data>;
using Criteria = CGAL::Delaunay_mesh_size_criteria_2<Triangulation>;

std::vector<Kernel::Point_2> read_points(std::size_t count) {
    std::vector<Kernel::Point_2> points;
    for (std::size_t i = 0; i < count; ++i) {
        double x = 0, y = 0;
        std::cin >> x >> y;
        points.emplace_back(x, y);
    }
    return points;
}

std::size_t vertices(double degrees) {
    std::size_t points = 0, segments = 0, holes = 0;
    std::cin >> points >> segments >> holes;
    const std::vector<Kernel::Point_2> ends = read_points(points);
    Triangulation triangulation;
    triangulation.insert(ends.begin(), ends.end());
    for (std::size_t i = 0; i < segments; ++i) {
        std::size_t a = 0, b = 0;
        std::cin >> a >> b;
        triangulation.insert_constraint(ends.at(a), ends.at(b));
    }
    const std::vector<Kernel::Point_2> seeds = read_points(holes);
    const double sine = std::sin(degrees * std::acos(-1.0) / 180);
    CGAL::Delaunay_mesher_2<Triangulation, Criteria> mesher(triangulation);
    mesher.set_seeds(seeds.begin(), seeds.end());
    mesher.set_criteria(Criteria(sine * sine, 0.0));
    mesher.refine_mesh();
    return triangulation.number_of_vertices();
}

}  // namespace

int main(int count, char** arguments) {
    try {
        std::printf("%zu\n", vertices(count > 1 ? std::atof(arguments[1]) : 20.7));
        return 0;
    } catch (const std::exception& error) {
        std::fprintf(stderr, "%s\n", error.what());
        return 1;
    }
}
