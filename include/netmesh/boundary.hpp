// netmesh/boundary.hpp - segments, facets and regions that a mesh keeps. A base of the class
// netmesh::mesh, for netmesh.hpp, which includes it. License: MIT OR Apache-2.0.

#ifndef NETMESH_BOUNDARY_HPP
#define NETMESH_BOUNDARY_HPP

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "../netmesh.h"
#include "fetch.hpp"
#include "queries.hpp"
#include "result.hpp"
#include "table.hpp"

namespace netmesh {
namespace detail {

// Segments, facets and regions: those that are given, and those of the mesh.
class boundary : public queries {
public:
    // Sets the segments that run() keeps as chains of edges, in 2D and 3D: two numbers of inputs
    // each, and a number of the caller's for each or none. They replace those before.
    result<void> try_set_segments(span<const std::uint32_t> inputs,
                                  span<const std::int32_t> markers = {}) {
        const std::size_t count = inputs.size() / 2;
        if (inputs.size() % 2 != 0 || (!markers.empty() && markers.size() != count)) {
            return wrong_size("inputs and markers", inputs.size(), "two and one a segment", 2 * count);
        }
        return outcome(nm_mesh_set_segments(handle_, count, inputs.data(),
                                                    markers.empty() ? nullptr : markers.data()));
    }

    // Sets the facets that run() keeps as triangles, in 3D: facet i has the loops loop_starts[i] to
    // loop_starts[i + 1], and loop j the inputs from input_starts[j] to input_starts[j + 1]. They
    // replace those before, and triangles. None at all: empty spans.
    result<void> try_set_facets(span<const std::uint64_t> loop_starts,
                                span<const std::uint64_t> input_starts,
                                span<const std::uint32_t> inputs,
                                span<const std::int32_t> markers = {}) {
        const std::size_t count = loop_starts.empty() ? 0 : loop_starts.size() - 1;
        if (!markers.empty() && markers.size() != count) {
            return wrong_size("markers", markers.size(), "one a facet", count);
        }
        const std::uint64_t loops = count == 0 ? 0 : loop_starts.back();
        if (input_starts.size() != (count == 0 ? input_starts.size() : loops + 1)) {
            return wrong_size("input_starts", input_starts.size(), "one more than loops", loops + 1);
        }
        const std::uint64_t length = loops == 0 || count == 0 ? 0 : input_starts.back();
        if (inputs.size() != length) {
            return wrong_size("inputs", inputs.size(), "the last of input_starts", length);
        }
        return outcome(nm_mesh_set_facets(handle_, count, loop_starts.data(),
                                                  input_starts.data(), inputs.data(),
                                                  markers.empty() ? nullptr : markers.data()));
    }

    // Sets facets that are polygons without holes: the numbers of inputs round each.
    result<void> try_set_facets(const std::vector<std::vector<std::uint32_t>> &polygons,
                                span<const std::int32_t> markers = {}) {
        return allocating("the facets", [&]() -> result<void> {
            std::vector<std::uint64_t> loops = {0}, starts = {0};
            std::vector<std::uint32_t> inputs;
            for (const std::vector<std::uint32_t> &polygon : polygons) {
                inputs.insert(inputs.end(), polygon.begin(), polygon.end());
                loops.push_back(loops.size());
                starts.push_back(inputs.size());
            }
            return try_set_facets(loops, starts, inputs, markers);
        });
    }

    // Sets the triangles of a surface that run() keeps, in 3D: three numbers of inputs each, and a
    // number of the caller's for each or none. They replace those before, and facets.
    result<void> try_set_triangles(span<const std::uint32_t> inputs,
                                   span<const std::int32_t> markers = {}) {
        const std::size_t count = inputs.size() / 3;
        if (inputs.size() % 3 != 0 || (!markers.empty() && markers.size() != count)) {
            return wrong_size("inputs and markers", inputs.size(), "three and one a triangle",
                              3 * count);
        }
        return outcome(nm_mesh_set_triangles(handle_, count, inputs.data(),
                                                     markers.empty() ? nullptr : markers.data()));
    }

    // Replaces the polygons of the facets by triangles between their inputs, for those that are not
    // plane. Returns the number of polygons.
    result<std::uint64_t> try_triangulate_facets() {
        std::uint64_t polygons = 0;
        result<void> done = outcome(nm_mesh_triangulate_facets(handle_, &polygons));
        if (!done) {
            return failure{done.status(), done.message()};
        }
        return polygons;
    }

    // Closes holes of the facets that have at most max_edges edges by triangles, which become the
    // last facets.
    result<nm_closed_holes> try_close_holes(std::uint32_t max_edges) {
        nm_closed_holes closed = NM_CLOSED_HOLES_INIT;
        result<void> done = outcome(nm_mesh_close_holes(handle_, max_edges, &closed));
        if (!done) {
            return failure{done.status(), done.message()};
        }
        return closed;
    }

    // Returns all pairs of facets and segments in 3D that meet in more than they share.
    result<std::vector<nm_intersection>> try_intersections() const {
        return structs<nm_intersection>(nm_mesh_get_intersections);
    }

    // Returns all edges of facets in 3D that are not one of two facets which run through them in
    // opposite directions.
    result<std::vector<nm_odd_edge>> try_odd_edges() const {
        return structs<nm_odd_edge>(nm_mesh_get_odd_edges);
    }

    // Sets the regions between segments in 2D or facets in 3D; each is NM_REGION_INIT before its
    // fields are set. They replace those before.
    result<void> try_set_regions(span<const nm_region> regions) {
        return outcome(nm_mesh_set_regions(handle_, regions.size(), regions.data()));
    }

    // Returns the edges that segments have become: two vertices each.
    result<table<std::uint32_t>> try_segments() const {
        result<std::vector<std::uint32_t>> ends = array<std::uint32_t>(nm_mesh_get_segments);
        if (!ends) {
            return failure{ends.status(), ends.message()};
        }
        return table<std::uint32_t>(std::move(*ends), 2);
    }

    // Returns the segment that each edge of segments() is a part of.
    result<std::vector<std::uint32_t>> try_segment_parents() const {
        return array<std::uint32_t>(nm_mesh_get_segment_parents);
    }

    // Returns the triangles that facets have become: three vertices each, counterclockwise where
    // the facet's normal points to.
    result<table<std::uint32_t>> try_facet_triangles() const {
        return in_rows(array<std::uint32_t>(nm_mesh_get_facet_triangles), 3);
    }

    // Returns the facet that each of facet_triangles() is a part of.
    result<std::vector<std::uint32_t>> try_facet_parents() const {
        return array<std::uint32_t>(nm_mesh_get_facet_parents);
    }

    // Returns the simplices before and behind each of facet_triangles(); NM_NONE where the domain
    // ends.
    result<table<std::uint32_t>> try_facet_simplices() const {
        return in_rows(array<std::uint32_t>(nm_mesh_get_facet_triangle_simplices), 2);
    }

    // Returns the label of each simplex's region; the result is empty without segments and facets.
    result<std::vector<std::int32_t>> try_simplex_regions() const {
        return array<std::int32_t>(nm_mesh_get_simplex_regions);
    }

    // Returns the simplices with all vertices on one facet, which are flat but for roundings,
    // ascending.
    result<std::vector<std::uint32_t>> try_flat_simplices() const {
        return array<std::uint32_t>(nm_mesh_get_flat_simplices);
    }

#if NETMESH_EXCEPTIONS
    // Each function below does what the try_ function of its name does, and throws netmesh::error.
    void set_segments(span<const std::uint32_t> inputs, span<const std::int32_t> markers = {}) {
        try_set_segments(inputs, markers).value();
    }
    void set_facets(span<const std::uint64_t> loop_starts, span<const std::uint64_t> input_starts,
                    span<const std::uint32_t> inputs, span<const std::int32_t> markers = {}) {
        try_set_facets(loop_starts, input_starts, inputs, markers).value();
    }
    void set_facets(const std::vector<std::vector<std::uint32_t>> &polygons,
                    span<const std::int32_t> markers = {}) {
        try_set_facets(polygons, markers).value();
    }
    void set_triangles(span<const std::uint32_t> inputs, span<const std::int32_t> markers = {}) {
        try_set_triangles(inputs, markers).value();
    }
    std::uint64_t triangulate_facets() { return try_triangulate_facets().value(); }
    nm_closed_holes close_holes(std::uint32_t max_edges) { return try_close_holes(max_edges).value(); }
    void set_regions(span<const nm_region> regions) { try_set_regions(regions).value(); }
    table<std::uint32_t> segments() const { return try_segments().value(); }
    std::vector<std::uint32_t> segment_parents() const { return try_segment_parents().value(); }
    table<std::uint32_t> facet_triangles() const { return try_facet_triangles().value(); }
    std::vector<std::uint32_t> facet_parents() const { return try_facet_parents().value(); }
    table<std::uint32_t> facet_simplices() const { return try_facet_simplices().value(); }
    std::vector<nm_intersection> intersections() const { return try_intersections().value(); }
    std::vector<nm_odd_edge> odd_edges() const { return try_odd_edges().value(); }
    std::vector<std::int32_t> simplex_regions() const { return try_simplex_regions().value(); }
    std::vector<std::uint32_t> flat_simplices() const { return try_flat_simplices().value(); }
#endif

protected:
    explicit boundary(nm_mesh *handle) noexcept : queries(handle) {}

private:
    // Returns an array of structs, each of which has the size that the first one tells.
    template <class T>
    result<std::vector<T>> structs(getter<T> fetch) const {
        return fetched<T>([&](T *buf, std::uint64_t capacity, std::uint64_t *needed) {
            if (buf != nullptr) {
                buf->struct_size = sizeof *buf;
            }
            return fetch(handle_, buf, capacity, needed);
        });
    }
};

}  // namespace detail

// Gives points in 2D or 3D that are nearly others the coordinates of these, and returns their number.
inline result<std::uint64_t> try_merge_points(std::uint32_t dim, span<double> coordinates,
                                              double ratio = 1e-9) {
    const std::size_t count = dim == 0 ? 0 : coordinates.size() / dim;
    if (count * dim != coordinates.size()) {
        return detail::wrong_size("coordinates", coordinates.size(), "points x dim", count * dim);
    }
    std::uint64_t moved = 0;
    const nm_status status = nm_merge_points(dim, count, coordinates.data(), ratio, &moved);
    return status == NM_OK ? result<std::uint64_t>(moved) : detail::failed(status);
}

#if NETMESH_EXCEPTIONS
// Does the same, and throws netmesh::error.
inline std::uint64_t merge_points(std::uint32_t dim, span<double> coordinates, double ratio = 1e-9) {
    return try_merge_points(dim, coordinates, ratio).value();
}
#endif

}  // namespace netmesh

#endif  // NETMESH_BOUNDARY_HPP
