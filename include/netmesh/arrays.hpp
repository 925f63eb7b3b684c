// netmesh/arrays.hpp - arrays of a mesh and of selections of its simplices. A base of the class
// netmesh::mesh, for netmesh.hpp, which includes it. License: MIT OR Apache-2.0.

#ifndef NETMESH_ARRAYS_HPP
#define NETMESH_ARRAYS_HPP

#include <cstdint>
#include <vector>

#include "../netmesh.h"
#include "fetch.hpp"
#include "getters.hpp"
#include "options.hpp"
#include "result.hpp"
#include "table.hpp"

namespace netmesh {
namespace detail {

// Arrays of a mesh, and of selections of its simplices.
class arrays : protected getters {
public:
    result<nm_counts> try_counts() const { return filled<nm_counts>(nm_mesh_counts); }

    // Returns vertices x dim coordinates; the distinct inputs come first.
    result<table<double>> try_points() const { return rows<double>(nm_mesh_get_points, 0); }

    // Returns simplices x (dim + 1) vertex ids, positively oriented.
    result<table<std::uint32_t>> try_simplices() const {
        return rows<std::uint32_t>(nm_mesh_get_simplices, 1);
    }

    // Returns simplices x (dim + 1) simplex ids, the i-th opposite vertex i; NM_NONE on the hull.
    result<table<std::uint32_t>> try_neighbors() const {
        return rows<std::uint32_t>(nm_mesh_get_neighbors, 1);
    }

    // Returns an nm_vertex_kind per vertex.
    result<std::vector<std::uint8_t>> try_vertex_kinds() const {
        return array<std::uint8_t>(nm_mesh_get_vertex_kinds);
    }

    // Returns the innermost domain of each vertex; NM_NONE where there are no domains.
    result<std::vector<std::uint32_t>> try_vertex_domains() const {
        return array<std::uint32_t>(nm_mesh_get_vertex_domains);
    }

    // Returns 1 for each vertex whose cell doubles are too coarse for, 0 for the others.
    result<std::vector<std::uint8_t>> try_precision_limited() const {
        return array<std::uint8_t>(nm_mesh_get_precision_limited);
    }

    // Returns the vertex of each input; equal inputs share one.
    result<std::vector<std::uint32_t>> try_input_vertices() const {
        return array<std::uint32_t>(nm_mesh_get_input_vertices);
    }

    // Returns the input that each vertex is, by its number among the caller's points and of equal
    // ones the first; NM_NONE for vertices that are no inputs.
    result<std::vector<std::uint32_t>> try_vertex_inputs() const {
        return array<std::uint32_t>(nm_mesh_get_vertex_inputs);
    }

    // Returns the tree of domains, the root first, every parent before its children.
    result<std::vector<nm_domain>> try_domains() const {
        return array<nm_domain>(nm_mesh_get_domains);
    }

    // Returns the ids of a selection's simplices; arrays of the selection with a row for each
    // simplex are in this order. Arrays of a selection are not stored, and have the ids of the
    // whole mesh.
    result<std::vector<std::uint32_t>> try_selected(const selection &wanted = {}) const {
        return array<std::uint32_t>(nm_mesh_get_selected, wanted);
    }

    // Returns edges x 2 vertex ids, the lesser first.
    result<table<std::uint32_t>> try_edges(const selection &wanted = {}) const {
        return in_rows(array<std::uint32_t>(nm_mesh_get_edges, wanted), 2);
    }

    // Returns facets and the two simplices of each; NM_NONE in place of the second on the hull.
    result<facet_tables> try_facets(const selection &wanted = {}) const {
        return facets_of(nm_mesh_get_facets, nm_mesh_get_facet_simplices, wanted, 2);
    }

    // Returns the facets on the hull, oriented outwards, and the simplex of each.
    result<facet_tables> try_hull(const selection &wanted = {}) const {
        return facets_of(nm_mesh_get_hull, nm_mesh_get_hull_simplices, wanted, 1);
    }

    // Lists for each vertex the simplices that have it.
    result<lists<std::uint32_t>> try_vertex_simplices(const selection &wanted = {}) const {
        return lists_of(nm_mesh_get_vertex_simplices, nm_mesh_get_vertex_simplex_starts, wanted);
    }

    // Lists for each vertex those that share an edge with it.
    result<lists<std::uint32_t>> try_vertex_neighbors(const selection &wanted = {}) const {
        return lists_of(nm_mesh_get_vertex_neighbors, nm_mesh_get_vertex_neighbor_starts, wanted);
    }

    // Returns the centres of the circumscribed balls, simplices x dim coordinates.
    result<table<double>> try_circumcenters(const selection &wanted = {}) const {
        return points_of<double>(nm_mesh_get_circumcenters, wanted);
    }

    // Returns the radii of the circumscribed balls.
    result<std::vector<double>> try_circumradii(const selection &wanted = {}) const {
        return array<double>(nm_mesh_get_circumradii, wanted);
    }

    // Returns the volumes of simplices, in 2D their areas.
    result<std::vector<double>> try_volumes(const selection &wanted = {}) const {
        return array<double>(nm_mesh_get_volumes, wanted);
    }

    // Lists for each vertex the simplices whose circumcentres are the corners of its Voronoi cell.
    result<lists<std::uint32_t>> try_regions(const selection &wanted = {}) const {
        return lists_of(nm_mesh_get_regions, nm_mesh_get_region_starts, wanted);
    }

    // Returns the volumes of Voronoi cells, infinite where a cell is unbounded.
    result<std::vector<double>> try_region_volumes(const selection &wanted = {}) const {
        return array<double>(nm_mesh_get_region_volumes, wanted);
    }

    // Returns the share of each Voronoi cell in the volume of the mesh.
    result<std::vector<double>> try_region_shares(const selection &wanted = {}) const {
        return array<double>(nm_mesh_get_region_shares, wanted);
    }

    // Lists for each edge the simplices whose circumcentres are the corners of the ridge between
    // its two Voronoi cells.
    result<lists<std::uint32_t>> try_ridge_corners(const selection &wanted = {}) const {
        return lists_of(nm_mesh_get_ridge_corners, nm_mesh_get_ridge_starts, wanted);
    }

    // Returns 1 for each ridge that is bounded, 0 for the others.
    result<std::vector<std::uint8_t>> try_ridge_bounded(const selection &wanted = {}) const {
        return array<std::uint8_t>(nm_mesh_get_ridge_bounded, wanted);
    }

    // Returns an nm_placement per simplex.
    result<std::vector<std::uint8_t>> try_placements(nm_extent extent) const {
        return fetched<std::uint8_t>(
            [this, extent](std::uint8_t *buf, std::uint64_t capacity, std::uint64_t *needed) {
                return nm_mesh_get_placements(handle_, extent, buf, capacity, needed);
            });
    }

#if NETMESH_EXCEPTIONS
    // Each function below does what the try_ function of its name does, and throws netmesh::error.
    nm_counts counts() const { return try_counts().value(); }
    std::uint32_t dim() const { return counts().dim; }
    table<double> points() const { return try_points().value(); }
    table<std::uint32_t> simplices() const { return try_simplices().value(); }
    table<std::uint32_t> neighbors() const { return try_neighbors().value(); }
    std::vector<std::uint8_t> vertex_kinds() const { return try_vertex_kinds().value(); }
    std::vector<std::uint32_t> vertex_domains() const { return try_vertex_domains().value(); }
    std::vector<std::uint8_t> precision_limited() const { return try_precision_limited().value(); }
    std::vector<std::uint32_t> input_vertices() const { return try_input_vertices().value(); }
    std::vector<std::uint32_t> vertex_inputs() const { return try_vertex_inputs().value(); }
    std::vector<nm_domain> domains() const { return try_domains().value(); }
    std::vector<std::uint32_t> selected(const selection &wanted = {}) const {
        return try_selected(wanted).value();
    }
    table<std::uint32_t> edges(const selection &wanted = {}) const {
        return try_edges(wanted).value();
    }
    facet_tables facets(const selection &wanted = {}) const { return try_facets(wanted).value(); }
    facet_tables hull(const selection &wanted = {}) const { return try_hull(wanted).value(); }
    lists<std::uint32_t> vertex_simplices(const selection &wanted = {}) const {
        return try_vertex_simplices(wanted).value();
    }
    lists<std::uint32_t> vertex_neighbors(const selection &wanted = {}) const {
        return try_vertex_neighbors(wanted).value();
    }
    table<double> circumcenters(const selection &wanted = {}) const {
        return try_circumcenters(wanted).value();
    }
    std::vector<double> circumradii(const selection &wanted = {}) const {
        return try_circumradii(wanted).value();
    }
    std::vector<double> volumes(const selection &wanted = {}) const {
        return try_volumes(wanted).value();
    }
    lists<std::uint32_t> regions(const selection &wanted = {}) const {
        return try_regions(wanted).value();
    }
    std::vector<double> region_volumes(const selection &wanted = {}) const {
        return try_region_volumes(wanted).value();
    }
    std::vector<double> region_shares(const selection &wanted = {}) const {
        return try_region_shares(wanted).value();
    }
    lists<std::uint32_t> ridge_corners(const selection &wanted = {}) const {
        return try_ridge_corners(wanted).value();
    }
    std::vector<std::uint8_t> ridge_bounded(const selection &wanted = {}) const {
        return try_ridge_bounded(wanted).value();
    }
    std::vector<std::uint8_t> placements(nm_extent extent) const {
        return try_placements(extent).value();
    }
#endif

protected:
    explicit arrays(nm_mesh *handle) noexcept : getters(handle) {}
};

}  // namespace detail
}  // namespace netmesh

#endif  // NETMESH_ARRAYS_HPP
