// netmesh.hpp - netmesh for C++17 and later: meshes that free themselves, errors as exceptions or as
// values, arrays as ranges. Header-only, over netmesh.h, which is the manual for everything that is
// only named here: shapes, units, ranges, costs. License: MIT OR Apache-2.0.
//
//     std::vector<double> points = ...;                        // n x 3
//     netmesh::mesh mesh(3, points);
//     netmesh::options options;
//     options.quality_bound = 4;
//     mesh.run(options);
//     for (netmesh::span<const std::uint32_t> vertices : mesh.simplices()) { ... vertices[0] ... }
//     mesh.save("mesh.vtu");
//
// ERRORS. Each function that can fail is there twice. mesh(), run(), points() and so on throw
// netmesh::error, with status() and the library's sentence as what(). try_create(), try_run(),
// try_points() and so on answer a netmesh::result, which has a value, or status() and message():
//
//     netmesh::result<netmesh::mesh> mesh = netmesh::mesh::try_create(3, points);
//     if (!mesh) return report(mesh.status(), mesh.message());
//     if (netmesh::result<void> done = mesh->try_run(); !done) ...
//
// After either failure the mesh is as it was before the call. Without exceptions (-fno-exceptions)
// there are only the latter; a vector that finds no memory then ends the program, as C++ has it, and
// whoever cannot bear that gives buffers of their own to the C interface through get().
//
// CALLBACKS may be anything callable. What they throw stops the call, crosses the library safely and
// leaves the function that was called, try_ or not.
//
// THREADS. Const member functions of one mesh may run at the same time in several threads; run()
// needs the mesh for itself and fails with NM_STATE where it does not have it.
//
// HEADERS. This header has what makes a mesh and judges it; the rest of the class is in its bases, one a
// topic, which it includes: arrays of the mesh (netmesh/arrays.hpp), faces and filtrations
// (netmesh/topology.hpp), questions about points (netmesh/queries.hpp), segments, facets and regions
// (netmesh/boundary.hpp), files and streams (netmesh/writers.hpp). The bases' names are no interface.
//
// ALPHA SHAPES: netmesh/alpha_shape.hpp. SURFACES through points: netmesh/surface.hpp.
//
// ADAPTERS. Points from other layouts: netmesh/strided.hpp. CGAL, TetGen and Eigen: netmesh/cgal.hpp,
// netmesh/tetgen.hpp, netmesh/eigen.hpp.

#ifndef NETMESH_HPP
#define NETMESH_HPP

#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "netmesh.h"
#include "netmesh/arrays.hpp"
#include "netmesh/boundary.hpp"
#include "netmesh/callbacks.hpp"
#include "netmesh/fetch.hpp"
#include "netmesh/getters.hpp"
#include "netmesh/options.hpp"
#include "netmesh/queries.hpp"
#include "netmesh/result.hpp"
#include "netmesh/table.hpp"
#include "netmesh/topology.hpp"
#include "netmesh/writers.hpp"

namespace netmesh {

// Returns the version of the library that is linked, "major.minor.patch".
inline std::string version() { return nm_version(); }

// Points, and after run() their mesh. A mesh moves and does not copy; with a moved-from mesh
// everything but assignment and destruction fails with NM_NULL_ARGUMENT.
class mesh : public detail::writers {
public:
    // Takes over a handle of the C interface, and frees it at the end.
    explicit mesh(nm_mesh *handle) noexcept : writers(handle) {}

    mesh(mesh &&other) noexcept : writers(other.release()) {}

    mesh &operator=(mesh &&other) noexcept {
        nm_mesh *taken = other.release();
        nm_mesh_free(handle_);
        handle_ = taken;
        return *this;
    }

    mesh(const mesh &) = delete;
    mesh &operator=(const mesh &) = delete;

    ~mesh() { nm_mesh_free(handle_); }

    // Returns the handle for the C interface; it stays this object's.
    nm_mesh *get() noexcept { return handle_; }
    const nm_mesh *get() const noexcept { return handle_; }

    // Gives the handle away; it is the caller's to free from now on.
    nm_mesh *release() noexcept { return std::exchange(handle_, nullptr); }

    // Copies n points: coordinate k of point i is points[i * stride + k]; stride 0 means dim.
    static result<mesh> try_create(std::uint32_t dim, const double *points, std::size_t n,
                                   std::size_t stride = 0) {
        nm_mesh *handle = nullptr;
        nm_status status = nm_mesh_create(dim, n, points, stride, &handle);
        return made(status, handle);
    }

    // Copies points, dim coordinates each, one point after the other.
    static result<mesh> try_create(std::uint32_t dim, span<const double> points) {
        if (dim != 0 && points.size() % dim != 0) {
            return failure{NM_INVALID_ARGUMENT, "points holds " + std::to_string(points.size()) +
                                                    " coordinates, not a multiple of dim = " +
                                                    std::to_string(dim)};
        }
        return try_create(dim, points.data(), dim == 0 ? 0 : points.size() / dim);
    }

    // Reads the points of a file, and the segments and regions that it has; the path is UTF-8.
    static result<mesh> try_from_file(const std::string &path_utf8,
                                      nm_format format = NM_FORMAT_AUTO) {
        nm_mesh *handle = nullptr;
        nm_status status = nm_mesh_create_from_file(path_utf8.c_str(), format, &handle);
        return made(status, handle);
    }

    // Reads the points of a file from chosen columns, and further columns as attributes of the
    // points, chosen as by nm_mesh_create_from_columns; an empty choice is the format's own, or
    // none.
    static result<mesh> try_from_columns(const std::string &path_utf8, const std::string &columns,
                                         const std::string &attributes,
                                         nm_format format = NM_FORMAT_AUTO) {
        nm_mesh *handle = nullptr;
        nm_status status = nm_mesh_create_from_columns(
            path_utf8.c_str(), format, columns.empty() ? nullptr : columns.c_str(),
            attributes.empty() ? nullptr : attributes.c_str(), &handle);
        return made(status, handle);
    }

    // Meshes the points. A second run replaces the first one's result.
    result<void> try_run(const options &wanted = {}) {
        detail::progress_call call{wanted.progress, nullptr};
        nm_options values = NM_OPTIONS_INIT;
        detail::copy(wanted, values);
        values.progress = wanted.progress ? &detail::progress_call::invoke : nullptr;
        values.user_data = &call;
        detail::size_call asked{wanted.size, nullptr};
        values.size = wanted.size ? &detail::size_call::invoke : nullptr;
        values.size_user_data = &asked;
        nm_status status = nm_run(handle_, &values);
        return detail::finished(status, call.thrown ? call.thrown : asked.thrown);
    }

    // Returns the options that the last run had, with every default filled in, NM_OUTPUT_AUTO and
    // NM_EXTENT_AUTO among them. Functions are empty.
    result<options> try_options_of_run() const {
        result<nm_options> found = filled<nm_options>(nm_mesh_options);
        if (!found) {
            return failure{found.status(), found.message()};
        }
        options values;
        detail::copy(*found, values);
        return values;
    }

    // Counts the edges, faces and cells that the points' file has and that were left out.
    result<nm_left_out> try_left_out() const { return filled<nm_left_out>(nm_mesh_left_out); }

    // Gives the inputs values under a name, components each, which files get at all vertices: as by
    // extend_values() where extended, else NaN at vertices that are no inputs. Empty values remove.
    result<void> try_set_attributes(const std::string &name, std::uint32_t components,
                                    span<const double> values, bool extended = true) {
        result<nm_counts> counted = try_counts();
        if (!counted) {
            return failure{counted.status(), counted.message()};
        }
        if (values.size() != counted->inputs * components && !values.empty()) {
            return detail::wrong_size("values", values.size(), "inputs x components",
                                      counted->inputs * components);
        }
        auto set = extended ? nm_mesh_set_attributes : nm_mesh_set_input_attributes;
        return detail::outcome(
            set(handle_, name.c_str(), values.empty() ? 0 : components, values.data()));
    }

    // Gives the inputs sizes for the runs that follow, one each; none removes them.
    result<void> try_set_sizes(span<const double> values) {
        return detail::outcome(nm_mesh_set_sizes(handle_, values.size(), values.data()));
    }

    // Gives sizes by those at the vertices of another mesh, or of this one's last result, for the
    // runs that follow.
    result<void> try_set_background(const mesh &background, span<const double> values) {
        return detail::outcome(nm_mesh_set_background(handle_, background.handle_, values.size(),
                                                      values.data()));
    }

    // Returns the size that the last run asked for at each vertex, infinite for none; the result is
    // empty if nothing told sizes.
    result<std::vector<double>> try_sizes() const { return array<double>(nm_mesh_get_sizes); }

    result<void> try_remove_background() {
        return detail::outcome(nm_mesh_set_background(handle_, nullptr, 0, nullptr));
    }

    // Returns the values of a name at all vertices, which files get: vertices x components.
    result<std::vector<double>> try_attributes(const std::string &name) const {
        return detail::fetched<double>(
            [this, &name](double *buf, std::uint64_t capacity, std::uint64_t *needed) {
                return nm_mesh_get_attributes(handle_, name.c_str(), buf, capacity, needed);
            });
    }

    result<nm_quality> try_quality() const { return filled<nm_quality>(nm_mesh_quality); }

    // Counts the values of a measure between edges, which ascend. Simplices at the hull count too
    // where at_hull.
    result<histogram> try_quality_histogram(nm_measure measure, span<const double> edges,
                                            bool at_hull = false) const {
        return detail::allocating("the counts", [&]() -> result<histogram> {
            histogram found;
            found.counts.resize(edges.size() + 1);
            double extremes[2] = {};
            nm_status status =
                nm_mesh_quality_histogram(handle_, measure, at_hull ? 1 : 0, edges.size(),
                                          edges.data(), found.counts.data(), extremes);
            if (status != NM_OK) {
                return detail::failed(status);
            }
            found.least = extremes[0];
            found.largest = extremes[1];
            return found;
        });
    }

    result<nm_stats> try_stats() const { return filled<nm_stats>(nm_mesh_stats); }

    // Checks the mesh independently of the code that built it: 1 topology, 2 geometry, 3 the
    // promises. The report says what was found; a broken mesh is not a failure of the call.
    result<nm_report> try_validate(std::uint32_t level = 3) const {
        nm_report report = detail::sized<nm_report>();
        nm_status status = nm_mesh_validate(handle_, level, &report);
        return status == NM_OK ? result<nm_report>(report) : detail::failed(status);
    }

#if NETMESH_EXCEPTIONS
    // Each function below does what the try_ function of its name does, and throws netmesh::error.
    mesh(std::uint32_t dim, const double *points, std::size_t n, std::size_t stride = 0)
        : mesh(try_create(dim, points, n, stride).value()) {}
    mesh(std::uint32_t dim, span<const double> points) : mesh(try_create(dim, points).value()) {}
    static mesh from_file(const std::string &path_utf8, nm_format format = NM_FORMAT_AUTO) {
        return try_from_file(path_utf8, format).value();
    }
    static mesh from_columns(const std::string &path_utf8, const std::string &columns,
                             const std::string &attributes, nm_format format = NM_FORMAT_AUTO) {
        return try_from_columns(path_utf8, columns, attributes, format).value();
    }
    void run(const options &wanted = {}) { try_run(wanted).value(); }
    options options_of_run() const { return try_options_of_run().value(); }
    nm_left_out left_out() const { return try_left_out().value(); }
    void set_attributes(const std::string &name, std::uint32_t components,
                        span<const double> values, bool extended = true) {
        try_set_attributes(name, components, values, extended).value();
    }
    void set_sizes(span<const double> values) { try_set_sizes(values).value(); }
    void set_background(const mesh &background, span<const double> values) {
        try_set_background(background, values).value();
    }
    void remove_background() { try_remove_background().value(); }
    std::vector<double> sizes() const { return try_sizes().value(); }
    std::vector<double> attributes(const std::string &name) const {
        return try_attributes(name).value();
    }
    nm_quality quality() const { return try_quality().value(); }
    histogram quality_histogram(nm_measure measure, span<const double> edges,
                                bool at_hull = false) const {
        return try_quality_histogram(measure, edges, at_hull).value();
    }
    nm_stats stats() const { return try_stats().value(); }
    nm_report validate(std::uint32_t level = 3) const { return try_validate(level).value(); }
#endif

private:
    static result<mesh> made(nm_status status, nm_mesh *handle) noexcept {
        return status == NM_OK ? result<mesh>(mesh(handle)) : detail::failed(status);
    }
};

}  // namespace netmesh

#endif  // NETMESH_HPP
