#include <CGAL/Constrained_Delaunay_triangulation_2.h>
#include <CGAL/Delaunay_mesh_face_base_2.h>
#include <CGAL/Delaunay_mesh_size_criteria_2.h>
#include <CGAL/Delaunay_mesh_vertex_base_2.h>
#include <CGAL/Delaunay_mesher_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <algorithm>
#include <chrono>
#include <unordered_map>

#include "peers.hpp"

namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using VertexBase = CGAL::Delaunay_mesh_vertex_base_2<Kernel>;
using FaceBase = CGAL::Delaunay_mesh_face_base_2<Kernel>;
using Triangulation = CGAL::Constrained_Delaunay_triangulation_2<
    Kernel, CGAL::Triangulation_data_structure_2<VertexBase, FaceBase>>;
using Criteria = CGAL::Delaunay_mesh_size_criteria_2<Triangulation>;
using Mesher = CGAL::Delaunay_mesher_2<Triangulation, Criteria>;

void insert_box(const PointSet& points, Triangulation& triangulation) {
    double low[2];
    double high[2];
    for (int k = 0; k < 2; ++k) {
        low[k] = high[k] = points.point(0)[k];
        for (std::size_t i = 0; i < points.size(); ++i) {
            low[k] = std::min(low[k], points.point(i)[k]);
            high[k] = std::max(high[k], points.point(i)[k]);
        }
        const double side = high[k] - low[k];
        low[k] -= side;
        high[k] += side;
    }
    const Kernel::Point_2 corners[] = {
        {low[0], low[1]}, {high[0], low[1]}, {high[0], high[1]}, {low[0], high[1]}};
    for (int i = 0; i < 4; ++i) triangulation.insert_constraint(corners[i], corners[(i + 1) % 4]);
}

PeerMesh exported(const Triangulation& triangulation) {
    PeerMesh mesh;
    std::unordered_map<const void*, std::uint32_t> ids;
    for (auto v = triangulation.finite_vertices_begin(); v != triangulation.finite_vertices_end(); ++v) {
        ids.emplace(&*v, static_cast<std::uint32_t>(ids.size()));
        mesh.points.push_back(v->point().x());
        mesh.points.push_back(v->point().y());
    }
    for (auto f = triangulation.finite_faces_begin(); f != triangulation.finite_faces_end(); ++f) {
        for (int i = 0; i < 3; ++i) mesh.simplices.push_back(ids.at(&*f->vertex(i)));
    }
    return mesh;
}

}  // namespace

PeerMesh refine_2(const PointSet& points, double radius_edge_bound) {
    std::vector<Kernel::Point_2> range;
    for (std::size_t i = 0; i < points.size(); ++i) {
        range.emplace_back(points.point(i)[0], points.point(i)[1]);
    }
    const auto start = std::chrono::steady_clock::now();
    Triangulation triangulation;
    insert_box(points, triangulation);
    triangulation.insert(range.begin(), range.end());
    // Its bound is the squared sine of the least angle, which is asin(1 / (2 radius-edge)).
    const double sine = 0.5 / radius_edge_bound;
    Mesher mesher(triangulation, Criteria(sine * sine, 0.0));
    mesher.refine_mesh();
    const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - start;
    PeerMesh mesh = exported(triangulation);
    mesh.seconds = elapsed.count();
    return mesh;
}
