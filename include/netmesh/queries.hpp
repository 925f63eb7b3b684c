// netmesh/queries.hpp - questions about points in a mesh. A base of the class
// netmesh::mesh, for netmesh.hpp, which includes it. License: MIT OR Apache-2.0.

#ifndef NETMESH_QUERIES_HPP
#define NETMESH_QUERIES_HPP

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "../netmesh.h"
#include "getters.hpp"
#include "result.hpp"
#include "table.hpp"
#include "topology.hpp"

namespace netmesh {
namespace detail {

// Questions about points in a mesh.
class queries : public topology {
public:
    // Makes the index that queries need, which the first of them does otherwise; tells its bytes.
    result<std::uint64_t> try_index() const {
        std::uint64_t bytes = 0;
        nm_status status = nm_mesh_index(handle_, &bytes);
        return status == NM_OK ? result<std::uint64_t>(bytes) : failed(status);
    }

    // Finds the simplex that holds each of the points, dim coordinates each; NM_NONE outside.
    result<std::vector<std::uint32_t>> try_locate(span<const double> points,
                                                  std::uint32_t threads = 1) const {
        result<std::size_t> count = count_of(points);
        if (!count) {
            return failure{count.status(), count.message()};
        }
        return allocating("the ids", [&]() -> result<std::vector<std::uint32_t>> {
            std::vector<std::uint32_t> found(*count);
            nm_status status =
                nm_mesh_locate(handle_, *count, points.data(), threads, found.data());
            if (status != NM_OK) {
                return failed(status);
            }
            return found;
        });
    }

    // Finds the vertex nearest to each of the points, and its distance.
    result<nearest_vertices> try_nearest(span<const double> points,
                                         std::uint32_t threads = 1) const {
        return nearest_by<nearest_vertices>(nm_mesh_nearest, points, threads);
    }

    // Finds the input nearest to each of the points, by its number among the caller's points and of
    // equal ones the first, and its distance.
    result<nearest_inputs> try_nearest_input(span<const double> points,
                                             std::uint32_t threads = 1) const {
        return nearest_by<nearest_inputs>(nm_mesh_nearest_input, points, threads);
    }

    // Interpolates values at the points, components each, from those at the vertices.
    result<table<double>> try_interpolate(nm_interpolation interpolation, std::uint32_t components,
                                          span<const double> values, span<const double> points,
                                          std::uint32_t threads = 1) const {
        result<std::size_t> count = count_of(points);
        if (!count) {
            return failure{count.status(), count.message()};
        }
        result<nm_counts> counted = try_counts();
        if (!counted) {
            return failure{counted.status(), counted.message()};
        }
        if (components == 0 || values.size() != counted->vertices * components) {
            return wrong_size("values", values.size(), "vertices x components",
                              counted->vertices * components);
        }
        return allocating("the values", [&]() -> result<table<double>> {
            std::vector<double> out(*count * components);
            nm_status status =
                nm_mesh_interpolate(handle_, interpolation, components, values.data(), *count,
                                    points.data(), threads, out.data());
            if (status != NM_OK) {
                return failed(status);
            }
            return table<double>(std::move(out), components);
        });
    }

    // Extends values at the inputs, components each, to all vertices.
    result<table<double>> try_extend_values(std::uint32_t components,
                                            span<const double> input_values) const {
        result<nm_counts> counted = try_counts();
        if (!counted) {
            return failure{counted.status(), counted.message()};
        }
        if (components == 0 || input_values.size() != counted->inputs * components) {
            return wrong_size("input_values", input_values.size(), "inputs x components",
                              counted->inputs * components);
        }
        return allocating("the values", [&]() -> result<table<double>> {
            std::vector<double> out(static_cast<std::size_t>(counted->vertices) * components);
            nm_status status =
                nm_mesh_extend_values(handle_, components, input_values.data(), out.data());
            if (status != NM_OK) {
                return failed(status);
            }
            return table<double>(std::move(out), components);
        });
    }

#if NETMESH_EXCEPTIONS
    // Each function below does what the try_ function of its name does, and throws netmesh::error.
    std::uint64_t index() const { return try_index().value(); }
    std::vector<std::uint32_t> locate(span<const double> points, std::uint32_t threads = 1) const {
        return try_locate(points, threads).value();
    }
    nearest_vertices nearest(span<const double> points, std::uint32_t threads = 1) const {
        return try_nearest(points, threads).value();
    }
    nearest_inputs nearest_input(span<const double> points, std::uint32_t threads = 1) const {
        return try_nearest_input(points, threads).value();
    }
    table<double> interpolate(nm_interpolation interpolation, std::uint32_t components,
                              span<const double> values, span<const double> points,
                              std::uint32_t threads = 1) const {
        return try_interpolate(interpolation, components, values, points, threads).value();
    }
    table<double> extend_values(std::uint32_t components, span<const double> input_values) const {
        return try_extend_values(components, input_values).value();
    }
#endif

protected:
    explicit queries(nm_mesh *handle) noexcept : topology(handle) {}
};

}  // namespace detail
}  // namespace netmesh

#endif  // NETMESH_QUERIES_HPP
