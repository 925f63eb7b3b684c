// netmesh/closed_complex.hpp - a mesh with a vertex at infinity: one more simplex for each facet of
// the hull, so that every simplex has a neighbour across every facet. It is what triangulation
// libraries such as CGAL store. License: MIT OR Apache-2.0.

#ifndef NETMESH_CLOSED_COMPLEX_HPP
#define NETMESH_CLOSED_COMPLEX_HPP

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "../netmesh.hpp"

#if !NETMESH_EXCEPTIONS
#error "netmesh/closed_complex.hpp needs exceptions"
#endif

namespace netmesh {

// Simplices finite, finite + 1, ... have the vertex at infinity, NM_NONE, as a vertex; those before
// are the mesh's own. Orientations fit together: two neighbours put the vertices of their common facet
// in opposite orders. Across facet i of simplex s is neighbors[s * vertices_each + i], never NM_NONE.
struct closed_complex {
    std::size_t vertices_each = 0;  // dim + 1
    std::size_t finite = 0;
    std::vector<std::uint32_t> vertices;
    std::vector<std::uint32_t> neighbors;

    std::size_t simplices() const noexcept {
        return vertices_each == 0 ? 0 : vertices.size() / vertices_each;
    }

    // Throws netmesh::error as mesh.simplices() does, and NM_CAPACITY where 32 bits do not number the
    // simplices. O(simplices): the walk round each ridge of the hull visits what is incident to it.
    explicit closed_complex(const netmesh::mesh &mesh) {
        table<std::uint32_t> own_vertices = mesh.simplices();
        table<std::uint32_t> own_neighbors = mesh.neighbors();
        vertices_each = own_vertices.width();
        finite = own_vertices.size();
        vertices = std::move(own_vertices).flat();
        neighbors = std::move(own_neighbors).flat();
        add_infinite();
        link_infinite();
    }

private:
    // Places in neighbors that face infinity; the i-th one's infinite simplex is finite + i.
    std::vector<std::size_t> hull_;

    void add_infinite() {
        for (std::size_t place = 0; place < finite * vertices_each; ++place) {
            if (neighbors[place] == NM_NONE) {
                const std::size_t id = finite + hull_.size();
                if (id >= NM_NONE) {
                    throw error(NM_CAPACITY, "the simplices and those at infinity are more than 2^32 - 1");
                }
                neighbors[place] = static_cast<std::uint32_t>(id);
                hull_.push_back(place);
            }
        }
        const std::size_t all = finite + hull_.size();
        vertices.reserve(all * vertices_each);
        neighbors.resize(all * vertices_each, NM_NONE);
        // The vertices are those of the finite simplex, with infinity opposite the facet; two of
        // them change places, since infinity is on the facet's other side.
        for (const std::size_t place : hull_) {
            const std::size_t first = place - place % vertices_each;
            const std::size_t added = vertices.size();
            for (std::size_t k = 0; k < vertices_each; ++k) {
                vertices.push_back(first + k == place ? NM_NONE : vertices[first + k]);
            }
            std::swap(vertices[added], vertices[added + 1]);
        }
    }

    void link_infinite() {
        for (std::size_t h = 0; h < hull_.size(); ++h) {
            const std::size_t owner = hull_[h] / vertices_each, apex = hull_[h] % vertices_each;
            const std::size_t row = (finite + h) * vertices_each;
            for (std::size_t k = 0; k < vertices_each; ++k) {
                neighbors[row + k] = k == apex ? static_cast<std::uint32_t>(owner)
                                               : across_ridge(owner, apex, k);
            }
            std::swap(neighbors[row], neighbors[row + 1]);
        }
    }

    // Finds the infinite simplex beyond the hull facet that shares with the one opposite apex the
    // ridge without the vertices apex and other: the way goes round the ridge through the mesh.
    std::uint32_t across_ridge(std::size_t simplex, std::size_t apex, std::size_t other) const {
        for (;;) {
            const std::uint32_t next = neighbors[simplex * vertices_each + other];
            if (next >= finite) {
                return next;
            }
            const std::uint32_t pivot = vertices[simplex * vertices_each + apex];
            apex = index_of(neighbors, next, static_cast<std::uint32_t>(simplex));
            other = index_of(vertices, next, pivot);
            simplex = next;
        }
    }

    std::size_t index_of(const std::vector<std::uint32_t> &rows, std::size_t row,
                         std::uint32_t wanted) const {
        std::size_t k = 0;
        while (k + 1 < vertices_each && rows[row * vertices_each + k] != wanted) {
            ++k;
        }
        return k;
    }
};

}  // namespace netmesh

#endif  // NETMESH_CLOSED_COMPLEX_HPP
