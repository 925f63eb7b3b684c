// Alpha shapes through netmesh/alpha_shape.hpp, beside CGAL's of the same points where CGAL is there.

#include <netmesh/alpha_shape.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include "check.hpp"
#include "inputs.hpp"

#ifdef NETMESH_WITH_CGAL
#include <CGAL/Alpha_shape_3.h>
#include <CGAL/Alpha_shape_cell_base_3.h>
#include <CGAL/Alpha_shape_vertex_base_3.h>
#include <CGAL/Delaunay_triangulation_3.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#endif

namespace {

netmesh::mesh delaunay(std::uint32_t dim, const std::vector<double>& points) {
    netmesh::mesh mesh(dim, points);
    netmesh::options plain;
    plain.algorithm = NM_ALGORITHM_DELAUNAY;
    mesh.run(plain);
    return mesh;
}

std::size_t count(const std::vector<std::uint8_t>& classes, nm_face_class wanted) {
    return static_cast<std::size_t>(std::count(classes.begin(), classes.end(), wanted));
}

// The parts of the interface agree with one another.
void shapes_agree_with_themselves(const std::string& scratch) {
    const netmesh::mesh mesh = delaunay(3, generate("uniform", 3, 300).coordinates);
    const netmesh::alpha_shape shape(mesh, netmesh::optimal_alpha(mesh));
    const nm_alpha_shape measures = shape.measures();
    CHECK(shape.alpha() >= netmesh::connecting_alpha(mesh) && measures.betti_count == 3);
    CHECK(measures.components == 1 && measures.volume > 0);
    long euler = 0;
    for (std::uint32_t k = 0; k <= 3; ++k) {
        const auto classes = shape.classes(k);
        CHECK(classes.size() == mesh.faces(k).size());
        CHECK(classes.size() - count(classes, NM_FACE_CLASS_EXTERIOR) == measures.face_counts[k]);
        euler += (k % 2 == 0 ? 1 : -1) * static_cast<long>(measures.face_counts[k]);
    }
    CHECK(euler == measures.euler_characteristic);
    // Each input is in a solid.
    CHECK(count(shape.classes(0), NM_FACE_CLASS_SINGULAR) == 0);
    CHECK(shape.boundary().size() == count(shape.classes(2), NM_FACE_CLASS_REGULAR));
    shape.save(scratch + "/alpha_shape.ply");
    const auto other = shape.try_save(scratch + "/alpha_shape.vtu");
    CHECK(!other && other.message().find("use .ply, .off, .stl or .obj") != std::string::npos);
    const auto negative = netmesh::alpha_shape(mesh, -1).try_measures();
    CHECK(!negative && negative.status() == NM_INVALID_ARGUMENT);
    const auto none = netmesh::try_optimal_alpha(mesh, 0);
    CHECK(!none && none.message().find("components is 0") != std::string::npos);
}

#ifdef NETMESH_WITH_CGAL

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Vertices = CGAL::Alpha_shape_vertex_base_3<Kernel>;
using Cells = CGAL::Alpha_shape_cell_base_3<Kernel>;
using Delaunay = CGAL::Delaunay_triangulation_3<Kernel, CGAL::Triangulation_data_structure_3<Vertices, Cells>>;
using Alpha = CGAL::Alpha_shape_3<Delaunay>;

nm_face_class class_of(Alpha::Classification_type type) {
    switch (type) {
        case Alpha::EXTERIOR: return NM_FACE_CLASS_EXTERIOR;
        case Alpha::SINGULAR: return NM_FACE_CLASS_SINGULAR;
        case Alpha::REGULAR: return NM_FACE_CLASS_REGULAR;
        default: return NM_FACE_CLASS_INTERIOR;
    }
}

// Points in general position: CGAL's values are rounded, and all others are far enough from them.
void shapes_are_cgals(const char* distribution) {
    const std::vector<double> points = generate(distribution, 3, 400).coordinates;
    const netmesh::mesh mesh = delaunay(3, points);
    std::vector<Kernel::Point_3> others;
    for (std::size_t i = 0; i < points.size(); i += 3) {
        others.emplace_back(points[i], points[i + 1], points[i + 2]);
    }
    Alpha cgal(others.begin(), others.end(), 0, Alpha::GENERAL);
    const double optimal = netmesh::optimal_alpha(mesh);
    // The least such value, by CGAL's definition. Its own search takes solid components for a monotone
    // number and may end above.
    const double rounding = 1e-9;
    CHECK(*cgal.find_optimal_alpha(1) >= optimal * (1 - rounding));
    CHECK(cgal.find_alpha_solid() <= optimal * (1 + rounding));
    CHECK(cgal.number_of_solid_components(optimal * (1 + rounding)) == 1);
    const double below = optimal * (1 - rounding);
    CHECK(below < cgal.find_alpha_solid() || cgal.number_of_solid_components(below) > 1);
    for (const double factor : {0.01, 0.3, 0.9999999, 1.0000001, 4.0}) {
        const double alpha = factor * optimal;
        const netmesh::alpha_shape shape(mesh, alpha);
        cgal.set_alpha(alpha);
        std::vector<std::uint8_t> vertices, edges, facets, cells;
        const auto add = [](std::vector<std::uint8_t>& to, Alpha::Classification_type type) {
            to.push_back(static_cast<std::uint8_t>(class_of(type)));
        };
        for (auto v = cgal.finite_vertices_begin(); v != cgal.finite_vertices_end(); ++v) {
            add(vertices, cgal.classify(Alpha::Vertex_handle(v)));
        }
        for (auto e = cgal.finite_edges_begin(); e != cgal.finite_edges_end(); ++e) {
            add(edges, cgal.classify(*e));
        }
        for (auto f = cgal.finite_facets_begin(); f != cgal.finite_facets_end(); ++f) {
            add(facets, cgal.classify(*f));
        }
        for (auto c = cgal.finite_cells_begin(); c != cgal.finite_cells_end(); ++c) {
            add(cells, cgal.classify(Alpha::Cell_handle(c)));
        }
        std::uint32_t k = 0;
        for (const auto* expected : {&vertices, &edges, &facets, &cells}) {
            const auto found = shape.classes(k++);
            CHECK(found.size() == expected->size());
            for (const nm_face_class each : {NM_FACE_CLASS_EXTERIOR, NM_FACE_CLASS_SINGULAR,
                                             NM_FACE_CLASS_REGULAR, NM_FACE_CLASS_INTERIOR}) {
                CHECK(count(found, each) == count(*expected, each));
            }
        }
    }
}

#endif

}  // namespace

int main(int argc, char** argv) {
    if (argc != 2) {
        return 2;
    }
    shapes_agree_with_themselves(argv[1]);
#ifdef NETMESH_WITH_CGAL
    for (const char* distribution : {"uniform", "gaussian"}) {
        shapes_are_cgals(distribution);
    }
#endif
    return check::result("alpha_shapes");
}
