// A mesh as CGAL's Delaunay_triangulation_3, for CGAL's queries. CGAL's triangulations are GPL.
//
//     c++ -std=c++17 -Iinclude examples/cpp/cgal_triangulation.cpp -Ltarget/release -lnetmesh -lgmp -lmpfr

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/point_generators_3.h>

#include <algorithm>
#include <iostream>
#include <iterator>
#include <vector>

#include "netmesh/cgal.hpp"

int main() {
    using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
    std::vector<Kernel::Point_3> points;
    std::copy_n(CGAL::Random_points_on_sphere_3<Kernel::Point_3>(1.0), 500, std::back_inserter(points));
    try {
        netmesh::mesh mesh = netmesh::cgal::make_mesh(points);
        mesh.run();
        // [cgal]
        CGAL::Delaunay_triangulation_3<Kernel> triangulation;
        const auto vertices = netmesh::cgal::fill(mesh, triangulation);  // linear, nothing is inserted
        // [end]
        std::cout << triangulation.number_of_vertices() << " vertices, "
                  << triangulation.number_of_finite_cells() << " cells; input 0 has "
                  << triangulation.degree(vertices[mesh.input_vertices()[0]]) << " neighbours, next to "
                  << "the origin is " << triangulation.nearest_vertex({0, 0, 0})->point() << '\n';
        return triangulation.is_valid() ? 0 : 1;
    } catch (const netmesh::error &error) {
        std::cerr << error.status_name() << ": " << error.what() << '\n';
        return 1;
    }
}
