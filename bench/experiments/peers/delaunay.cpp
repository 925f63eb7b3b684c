#include <CGAL/Delaunay_triangulation_2.h>
#include <CGAL/Delaunay_triangulation_3.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <chrono>
#include <unordered_map>

#include "peers.hpp"

namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;

template <class Vertices, class Simplices>
void export_to(PeerMesh& mesh, Vertices vertices, Simplices simplices, int dim) {
    std::unordered_map<const void*, std::uint32_t> ids;
    for (auto v : vertices) {
        ids.emplace(&*v, static_cast<std::uint32_t>(ids.size()));
        for (int k = 0; k < dim; ++k) mesh.points.push_back(v->point()[k]);
    }
    for (auto s : simplices) {
        for (int i = 0; i <= dim; ++i) mesh.simplices.push_back(ids.at(&*s->vertex(i)));
    }
}

template <class Triangulation, class Point>
double insert_all(Triangulation& triangulation, const std::vector<Point>& range) {
    const auto start = std::chrono::steady_clock::now();
    triangulation.insert(range.begin(), range.end());
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

}  // namespace

PeerMesh delaunay(const PointSet& points) {
    PeerMesh mesh;
    if (points.dim == 2) {
        std::vector<Kernel::Point_2> range;
        for (std::size_t i = 0; i < points.size(); ++i) {
            range.emplace_back(points.point(i)[0], points.point(i)[1]);
        }
        CGAL::Delaunay_triangulation_2<Kernel> triangulation;
        mesh.seconds = insert_all(triangulation, range);
        export_to(mesh, triangulation.finite_vertex_handles(), triangulation.finite_face_handles(), 2);
    } else {
        std::vector<Kernel::Point_3> range;
        for (std::size_t i = 0; i < points.size(); ++i) {
            range.emplace_back(points.point(i)[0], points.point(i)[1], points.point(i)[2]);
        }
        CGAL::Delaunay_triangulation_3<Kernel> triangulation;
        mesh.seconds = insert_all(triangulation, range);
        export_to(mesh, triangulation.finite_vertex_handles(), triangulation.finite_cell_handles(), 3);
    }
    return mesh;
}
