// netmesh/cgal.hpp - meshes as CGAL's Delaunay triangulations in 2D and 3D, and points of CGAL as
// inputs (CGAL 5.5 or later). License of this file: MIT OR Apache-2.0. CGAL's triangulations, which it
// includes, are GPL (or commercial): a program that uses this file is under their terms.
//
//     using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
//     std::vector<Kernel::Point_3> points = ...;
//     netmesh::mesh mesh = netmesh::cgal::make_mesh(points);
//     mesh.run();
//     CGAL::Delaunay_triangulation_3<Kernel> triangulation;
//     auto vertices = netmesh::cgal::fill(mesh, triangulation);    // vertices[id]: a Vertex_handle
//
// NO INSERTION. fill() writes vertices, cells and neighbours into CGAL's data structure: linear time,
// no predicate is evaluated. The result has all that CGAL expects, the infinite vertex, the infinite
// cells and coherent orientations included; is_valid() holds.
//
// COSPHERICAL POINTS. Of points on one empty sphere, such as those of a grid, every triangulation is
// Delaunay. is_valid() accepts each, in 2D and 3D: it asks that no vertex is strictly inside. CGAL
// itself picks one by a symbolic perturbation, and netmesh picks another. Queries (locate,
// nearest_vertex, dual, iterators) do not depend on it, nor do insert() and remove() in 2D; in 3D these
// two build on CGAL's own choice and may fail near such points. is_unique() tells in linear time
// whether there are any; if not, all functions of CGAL may be used.
//
// Errors are thrown as netmesh::error; what CGAL throws passes through.

#ifndef NETMESH_CGAL_HPP
#define NETMESH_CGAL_HPP

#include <cstddef>
#include <cstdint>
#include <iterator>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include <CGAL/Delaunay_triangulation_2.h>
#include <CGAL/Delaunay_triangulation_3.h>
#include <CGAL/Dimension.h>
#include <CGAL/number_utils.h>

#include "closed_complex.hpp"
#include "strided.hpp"

namespace netmesh {
namespace cgal {
namespace detail {

// Names that CGAL has for 2D and for 3D.
template <typename Triangulation>
struct traits {
    static constexpr int dim = 0;  // no triangulation that fill() knows
};

template <typename Gt, typename Tds>
struct traits<CGAL::Delaunay_triangulation_2<Gt, Tds>> {
    static constexpr int dim = 2;
    using triangulation = CGAL::Delaunay_triangulation_2<Gt, Tds>;
    using data_structure = typename triangulation::Triangulation_data_structure;
    using cell = typename triangulation::Face_handle;
    using vertex = typename triangulation::Vertex_handle;
    using point = typename triangulation::Point;

    static cell create_cell(data_structure &tds) { return tds.create_face(); }
    static void set_incident(vertex v, cell c) { v->set_face(c); }
    static point make_point(span<const double> x) { return point(x[0], x[1]); }
    static auto finite_cells(const triangulation &t) { return t.finite_face_handles(); }
    static bool on_sphere(const triangulation &t, cell c, const point &p) {
        return t.side_of_oriented_circle(c, p) == CGAL::ON_ORIENTED_BOUNDARY;
    }
};

// Traits of triangulations without a location policy: Fast_location is a hierarchy of
// triangulations.
template <typename Gt, typename Tds, typename Lock>
struct traits<CGAL::Delaunay_triangulation_3<Gt, Tds, CGAL::Default, Lock>> {
    static constexpr int dim = 3;
    using triangulation = CGAL::Delaunay_triangulation_3<Gt, Tds, CGAL::Default, Lock>;
    using data_structure = typename triangulation::Triangulation_data_structure;
    using cell = typename triangulation::Cell_handle;
    using vertex = typename triangulation::Vertex_handle;
    using point = typename triangulation::Point;

    static cell create_cell(data_structure &tds) { return tds.create_cell(); }
    static void set_incident(vertex v, cell c) { v->set_cell(c); }
    static point make_point(span<const double> x) { return point(x[0], x[1], x[2]); }
    static auto finite_cells(const triangulation &t) { return t.finite_cell_handles(); }
    static bool on_sphere(const triangulation &t, cell c, const point &p) {
        return t.side_of_sphere(c, p) == CGAL::ON_BOUNDARY;
    }
};

// Puts id into the info() of a vertex or cell, where it has one that takes ids.
template <typename Handle>
auto set_info(Handle handle, std::uint32_t id, int)
    -> decltype(handle->info() = static_cast<std::remove_reference_t<decltype(handle->info())>>(id),
                void()) {
    handle->info() = static_cast<std::remove_reference_t<decltype(handle->info())>>(id);
}
template <typename Handle>
void set_info(Handle, std::uint32_t, long) {}

template <typename Triangulation>
std::vector<typename traits<Triangulation>::vertex> create_vertices(
    typename traits<Triangulation>::data_structure &tds, const table<double> &points) {
    std::vector<typename traits<Triangulation>::vertex> vertices;
    vertices.reserve(points.size());
    for (span<const double> x : points) {
        vertices.push_back(tds.create_vertex());
        vertices.back()->set_point(traits<Triangulation>::make_point(x));
        set_info(vertices.back(), static_cast<std::uint32_t>(vertices.size() - 1), 0);
    }
    return vertices;
}

template <typename Triangulation>
void create_cells(typename traits<Triangulation>::data_structure &tds, const closed_complex &complex,
                  const std::vector<typename traits<Triangulation>::vertex> &vertices,
                  typename traits<Triangulation>::vertex infinite) {
    using kind = traits<Triangulation>;
    constexpr int each = kind::dim + 1;
    const std::size_t count = complex.simplices();
    std::vector<typename kind::cell> cells;
    cells.reserve(count);
    const std::uint32_t *id = complex.vertices.data();
    for (std::size_t c = 0; c < count; ++c) {
        const typename kind::cell cell = kind::create_cell(tds);
        for (int k = 0; k < each; ++k, ++id) {
            const typename kind::vertex vertex = *id == NM_NONE ? infinite : vertices[*id];
            cell->set_vertex(k, vertex);
            kind::set_incident(vertex, cell);
        }
        set_info(cell, c < complex.finite ? static_cast<std::uint32_t>(c) : NM_NONE, 0);
        cells.push_back(cell);
    }
    const std::uint32_t *neighbor = complex.neighbors.data();
    for (const typename kind::cell &cell : cells) {
        for (int k = 0; k < each; ++k, ++neighbor) {
            cell->set_neighbor(k, cells[*neighbor]);
        }
    }
}

// Returns a coordinate that must be a double: exact kernels hold others too.
template <typename Number>
double exact_double(const Number &number, std::size_t point, int coordinate) {
    const double value = CGAL::to_double(number);
    if (!(Number(value) == number)) {
        throw error(NM_INVALID_ARGUMENT, "points[" + std::to_string(point) + "] coordinate " +
                                             std::to_string(coordinate) + " is not a double");
    }
    return value;
}
inline double exact_double(double number, std::size_t, int) { return number; }
inline double exact_double(float number, std::size_t, int) { return static_cast<double>(number); }

}  // namespace detail

// Makes a mesh of the points of a range (forward iterators): CGAL's Point_2 or Point_3 of any
// Cartesian or homogeneous kernel. A coordinate that is no double, which exact kernels may hold, is
// an error (NM_INVALID_ARGUMENT); the other errors are those of mesh(). O(n).
template <typename Points>
mesh make_mesh(const Points &points) {
    using std::begin;
    using std::end;
    using point = typename std::iterator_traits<decltype(begin(points))>::value_type;
    constexpr int dim = CGAL::Ambient_dimension<point>::value;
    static_assert(dim == 2 || dim == 3, "a range of Point_2 or Point_3");
    std::vector<double> coordinates;
    coordinates.reserve(static_cast<std::size_t>(std::distance(begin(points), end(points))) * dim);
    std::size_t i = 0;
    for (const point &p : points) {
        for (int k = 0; k < dim; ++k) {
            coordinates.push_back(detail::exact_double(p.cartesian(k), i, k));
        }
        ++i;
    }
    return mesh(static_cast<std::uint32_t>(dim), coordinates);
}

// Replaces what a CGAL::Delaunay_triangulation_2 or _3 holds by a mesh of the same dimension. Answers
// the vertex handles by the ids of the mesh: vertices[mesh.input_vertices()[i]] is input i. Where
// vertices or cells have an info() that takes integers, it becomes the id; NM_NONE in infinite cells,
// untouched in the infinite vertex. The triangulation keeps its traits.
//
// Not for the location policy Fast_location, nor for triangulations derived from these two: both
// keep more than can be filled here (a derived one that does not may be cast to its base).
//
// Errors: NM_STATE (no result yet), NM_DIMENSION (the mesh has another). After an error, or an
// exception of CGAL's, the triangulation is as it was. O(simplices).
template <typename Triangulation>
std::vector<typename Triangulation::Vertex_handle> fill(const mesh &mesh, Triangulation &triangulation) {
    using kind = detail::traits<Triangulation>;
    static_assert(kind::dim != 0, "CGAL::Delaunay_triangulation_2, or _3 without Fast_location");
    static_assert(std::is_constructible_v<typename kind::point, double, double> || kind::dim == 3,
                  "points in the plane have two coordinates");
    if (mesh.dim() != static_cast<std::uint32_t>(kind::dim)) {
        throw error(NM_DIMENSION, "the mesh has dim = " + std::to_string(mesh.dim()) +
                                      ", the triangulation " + std::to_string(kind::dim));
    }
    const closed_complex complex(mesh);
    typename kind::data_structure tds;
    tds.set_dimension(kind::dim);
    const typename kind::vertex infinite = tds.create_vertex();
    std::vector<typename kind::vertex> vertices =
        detail::create_vertices<Triangulation>(tds, mesh.points());
    detail::create_cells<Triangulation>(tds, complex, vertices, infinite);
    triangulation.tds().swap(tds);
    triangulation.set_infinite_vertex(infinite);
    return vertices;
}

// Returns true if the Delaunay triangulation of its vertices is the only one: no dim + 2 of them
// lie on a sphere with none inside. Exact if the kernel's predicates are. Vertices in a plane in
// space are not looked into: false. O(cells).
template <typename Triangulation>
bool is_unique(const Triangulation &triangulation) {
    using kind = detail::traits<Triangulation>;
    static_assert(kind::dim != 0, "CGAL::Delaunay_triangulation_2, or _3 without Fast_location");
    if (triangulation.dimension() != kind::dim) {
        return triangulation.dimension() < 2;  // on a line there are no circles
    }
    for (const typename kind::cell cell : kind::finite_cells(triangulation)) {
        for (int k = 0; k <= kind::dim; ++k) {
            const typename kind::cell beyond = cell->neighbor(k);
            const typename kind::vertex apex = beyond->vertex(beyond->index(cell));
            if (!triangulation.is_infinite(apex) &&
                kind::on_sphere(triangulation, cell, apex->point())) {
                return false;
            }
        }
    }
    return true;
}

}  // namespace cgal
}  // namespace netmesh

#endif  // NETMESH_CGAL_HPP
