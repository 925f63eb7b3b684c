// netmesh/getters.hpp - a handle of the C interface, and arrays that its getters fill. For netmesh.hpp, which
// includes it. License: MIT OR Apache-2.0.

#ifndef NETMESH_GETTERS_HPP
#define NETMESH_GETTERS_HPP

#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "../netmesh.h"
#include "fetch.hpp"
#include "options.hpp"
#include "result.hpp"
#include "table.hpp"

namespace netmesh {

// Answer of nearest(), with an element for each of the points.
struct nearest_vertices {
    std::vector<std::uint32_t> vertices;
    std::vector<double> distances;
};

// Answer of nearest_input(), with an element for each of the points: numbers of the caller's
// points.
struct nearest_inputs {
    std::vector<std::uint32_t> inputs;
    std::vector<double> distances;
};

// Numbers of values of a measure below the first edge, in each bin and above the last edge, and the
// least value and the largest.
struct histogram {
    std::vector<std::uint64_t> counts;
    double least = 0;
    double largest = 0;
};

// Facets, with dim vertices each, and the simplices that have them.
struct facet_tables {
    table<std::uint32_t> vertices;
    table<std::uint32_t> simplices;
};

namespace detail {

// Handle of a mesh; netmesh::mesh owns it. Nobody copies it, or frees it, by way of a base.
class getters {
protected:
    explicit getters(nm_mesh *handle) noexcept : handle_(handle) {}
    getters(const getters &) = delete;
    getters &operator=(const getters &) = delete;
    ~getters() = default;

    template <typename Struct>
    result<Struct> filled(nm_status (*fill)(const nm_mesh *, Struct *)) const noexcept {
        Struct value = sized<Struct>();
        nm_status status = fill(handle_, &value);
        return status == NM_OK ? result<Struct>(value) : failed(status);
    }

    template <typename Element>
    using getter = nm_status (*)(const nm_mesh *, Element *, std::uint64_t, std::uint64_t *);

    template <typename Element>
    using selected_getter = nm_status (*)(const nm_mesh *, const nm_selection *, Element *,
                                          std::uint64_t, std::uint64_t *);

    template <typename Element>
    using face_getter = nm_status (*)(const nm_mesh *, std::uint32_t, Element *, std::uint64_t,
                                      std::uint64_t *);

    template <typename Element>
    result<std::vector<Element>> array(getter<Element> fetch) const {
        return fetched<Element>([this, fetch](Element *buf, std::uint64_t capacity,
                                              std::uint64_t *needed) {
            return fetch(handle_, buf, capacity, needed);
        });
    }

    template <typename Element>
    result<std::vector<Element>> array(selected_getter<Element> fetch,
                                       const selection &wanted) const {
        nm_selection which = raw(wanted);
        return fetched<Element>([this, fetch, &which](Element *buf, std::uint64_t capacity,
                                                      std::uint64_t *needed) {
            return fetch(handle_, &which, buf, capacity, needed);
        });
    }

    template <typename Element>
    result<std::vector<Element>> array(face_getter<Element> fetch, std::uint32_t k) const {
        return fetched<Element>([this, fetch, k](Element *buf, std::uint64_t capacity,
                                                 std::uint64_t *needed) {
            return fetch(handle_, k, buf, capacity, needed);
        });
    }

    // Gets an array in rows of dim + more elements.
    template <typename Element>
    result<table<Element>> rows(getter<Element> fetch, std::size_t more) const {
        result<nm_counts> counted = filled<nm_counts>(nm_mesh_counts);
        if (!counted) {
            return failure{counted.status(), counted.message()};
        }
        return in_rows(array<Element>(fetch), counted->dim + more);
    }

    // Gets an array of the faces of dimension k in rows of k + 1 ids.
    result<table<std::uint32_t>> of_faces(face_getter<std::uint32_t> fetch,
                                          std::uint32_t k) const {
        return in_rows(array<std::uint32_t>(fetch, k), std::size_t{k} + 1);
    }

    // Gets an array of a selection in rows of dim elements.
    template <typename Element>
    result<table<Element>> points_of(selected_getter<Element> fetch,
                                     const selection &wanted) const {
        result<nm_counts> counted = filled<nm_counts>(nm_mesh_counts);
        if (!counted) {
            return failure{counted.status(), counted.message()};
        }
        return in_rows(array<Element>(fetch, wanted), counted->dim);
    }

    result<facet_tables> facets_of(selected_getter<std::uint32_t> vertices_of,
                                   selected_getter<std::uint32_t> simplices_of,
                                   const selection &wanted, std::size_t sides) const {
        result<table<std::uint32_t>> first = points_of<std::uint32_t>(vertices_of, wanted);
        if (!first) {
            return failure{first.status(), first.message()};
        }
        result<table<std::uint32_t>> second =
            in_rows(array<std::uint32_t>(simplices_of, wanted), sides);
        if (!second) {
            return failure{second.status(), second.message()};
        }
        return facet_tables{*std::move(first), *std::move(second)};
    }

    // Gets lists of a selection, or of the faces of a dimension.
    template <typename Elements, typename Starts, typename Wanted>
    result<lists<std::uint32_t>> lists_of(Elements elements, Starts starts,
                                          const Wanted &wanted) const {
        result<std::vector<std::uint64_t>> begins = array<std::uint64_t>(starts, wanted);
        if (!begins) {
            return failure{begins.status(), begins.message()};
        }
        result<std::vector<std::uint32_t>> ids = array<std::uint32_t>(elements, wanted);
        if (!ids) {
            return failure{ids.status(), ids.message()};
        }
        return lists<std::uint32_t>(*std::move(begins), *std::move(ids));
    }

    // Returns the number of points that coordinates make.
    result<std::size_t> count_of(span<const double> points) const {
        result<nm_counts> counted = filled<nm_counts>(nm_mesh_counts);
        if (!counted) {
            return failure{counted.status(), counted.message()};
        }
        if (points.size() % counted->dim != 0) {
            return failure{NM_INVALID_ARGUMENT, "points holds " + std::to_string(points.size()) +
                                                    " coordinates, not a multiple of dim = " +
                                                    std::to_string(counted->dim)};
        }
        return points.size() / counted->dim;
    }

    template <typename Found, typename Query>
    result<Found> nearest_by(Query query, span<const double> points,
                             std::uint32_t threads) const {
        result<std::size_t> count = count_of(points);
        if (!count) {
            return failure{count.status(), count.message()};
        }
        return allocating("the ids", [&]() -> result<Found> {
            std::vector<std::uint32_t> ids(*count);
            std::vector<double> distances(*count);
            nm_status status = query(handle_, *count, points.data(), threads, ids.data(),
                                     distances.data());
            if (status != NM_OK) {
                return failed(status);
            }
            return Found{std::move(ids), std::move(distances)};
        });
    }

    nm_mesh *handle_;
};

}  // namespace detail
}  // namespace netmesh

#endif  // NETMESH_GETTERS_HPP
