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
// ADAPTERS. Points from other layouts: netmesh/strided.hpp. CGAL, TetGen and Eigen: netmesh/cgal.hpp,
// netmesh/tetgen.hpp, netmesh/eigen.hpp.

#ifndef NETMESH_HPP
#define NETMESH_HPP

#include <cstddef>
#include <cstdint>
#include <exception>
#include <functional>
#include <ostream>
#include <string>
#include <utility>
#include <vector>

#include "netmesh.h"
#include "netmesh/result.hpp"
#include "netmesh/table.hpp"

namespace netmesh {

// The version of the library that is linked, "major.minor.patch".
inline std::string version() { return nm_version(); }

// Sees a run's progress on the thread that called run(), about every 30 ms and where a round or a
// stage ends; false cancels the run, which then fails with NM_CANCELLED.
using progress_function = std::function<bool(const nm_progress &)>;

// Receives an export piece by piece; false stops it, and it fails with NM_IO.
using write_function = std::function<bool(const char *data, std::size_t size)>;

// What a run shall do. The fields are those of nm_options, 0 the default for the dimension.
struct options {
    nm_output output = NM_OUTPUT_HIERARCHICAL;
    nm_algorithm algorithm = NM_ALGORITHM_NETMESH;
    nm_ordering ordering = NM_ORDERING_SAMPLED_NET;
    nm_criterion criterion = NM_CRITERION_VORONOI_ASPECT;
    std::uint32_t threads = 1;  // 0: all cores
    double quality_bound = 0;
    double epsilon = 0;
    double delta = 0;
    double gamma = 0;
    double yield_radius = 0;
    double encroachment = 0;
    double cage_scale = 0;
    double root_scale = 0;
    std::uint64_t seed = 0;
    std::uint64_t max_vertices = 0;
    progress_function progress = {};  // empty: none
    bool instruments = false;
};

// Points, and after run() their mesh. Moves, does not copy; with a moved-from mesh everything but
// assignment and destruction fails with NM_NULL_ARGUMENT.
class mesh {
public:
    // Takes over a handle of the C interface, and frees it at the end.
    explicit mesh(nm_mesh *handle) noexcept : handle_(handle) {}

    mesh(mesh &&other) noexcept : handle_(other.release()) {}

    mesh &operator=(mesh &&other) noexcept {
        nm_mesh *taken = other.release();
        nm_mesh_free(handle_);
        handle_ = taken;
        return *this;
    }

    mesh(const mesh &) = delete;
    mesh &operator=(const mesh &) = delete;

    ~mesh() { nm_mesh_free(handle_); }

    // The handle, for the C interface; it stays this object's.
    nm_mesh *get() noexcept { return handle_; }
    const nm_mesh *get() const noexcept { return handle_; }

    // The handle, now the caller's to free.
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

    // Reads the points of a file; the path is UTF-8.
    static result<mesh> try_from_file(const std::string &path_utf8,
                                      nm_format format = NM_FORMAT_AUTO) {
        nm_mesh *handle = nullptr;
        nm_status status = nm_mesh_create_from_file(path_utf8.c_str(), format, &handle);
        return made(status, handle);
    }

    // Meshes the points. A second run replaces the first one's result.
    result<void> try_run(const options &wanted = {}) {
        progress_call call{wanted.progress, nullptr};
        nm_options values;
        if (nm_status status = nm_options_init(&values, sizeof values); status != NM_OK) {
            return detail::failed(status);
        }
        copy(wanted, values);
        values.progress = wanted.progress ? &progress_call::invoke : nullptr;
        values.user_data = &call;
        nm_status status = nm_run(handle_, &values);
        return finished(status, call.thrown);
    }

    result<nm_counts> try_counts() const { return filled<nm_counts>(nm_mesh_counts); }

    // vertices x dim coordinates; the distinct inputs first.
    result<table<double>> try_points() const { return rows<double>(nm_mesh_get_points, 0); }

    // simplices x (dim + 1) vertex ids, positively oriented.
    result<table<std::uint32_t>> try_simplices() const {
        return rows<std::uint32_t>(nm_mesh_get_simplices, 1);
    }

    // simplices x (dim + 1) simplex ids, the i-th opposite vertex i; NM_NONE on the hull.
    result<table<std::uint32_t>> try_neighbors() const {
        return rows<std::uint32_t>(nm_mesh_get_neighbors, 1);
    }

    // An nm_vertex_kind per vertex.
    result<std::vector<std::uint8_t>> try_vertex_kinds() const {
        return array<std::uint8_t>(nm_mesh_get_vertex_kinds);
    }

    // The innermost domain of each vertex; NM_NONE where there are no domains.
    result<std::vector<std::uint32_t>> try_vertex_domains() const {
        return array<std::uint32_t>(nm_mesh_get_vertex_domains);
    }

    // 1 per vertex whose cell doubles are too coarse for, else 0.
    result<std::vector<std::uint8_t>> try_precision_limited() const {
        return array<std::uint8_t>(nm_mesh_get_precision_limited);
    }

    // The vertex of each input.
    result<std::vector<std::uint32_t>> try_input_vertices() const {
        return array<std::uint32_t>(nm_mesh_get_input_vertices);
    }

    // The tree of domains, the root first, every parent before its children.
    result<std::vector<nm_domain>> try_domains() const {
        return array<nm_domain>(nm_mesh_get_domains);
    }

    result<nm_quality> try_quality() const { return filled<nm_quality>(nm_mesh_quality); }

    result<nm_stats> try_stats() const { return filled<nm_stats>(nm_mesh_stats); }

    // Checks the mesh independently of the code that built it: 1 topology, 2 geometry, 3 the
    // promises. The report says what was found; a broken mesh is not a failure of the call.
    result<nm_report> try_validate(std::uint32_t level = 3) const {
        nm_report report = detail::sized<nm_report>();
        nm_status status = nm_mesh_validate(handle_, level, &report);
        return status == NM_OK ? result<nm_report>(report) : detail::failed(status);
    }

    // Writes a file; the path is UTF-8.
    result<void> try_save(const std::string &path_utf8, nm_format format = NM_FORMAT_AUTO) const {
        return detail::outcome(nm_export(handle_, path_utf8.c_str(), format));
    }

    // Writes to a function, piece by piece.
    result<void> try_write(nm_format format, const write_function &sink) const {
        write_call call{sink, nullptr};
        nm_write_fn invoke = sink ? &write_call::invoke : nullptr;
        nm_status status = nm_export_write(handle_, format, invoke, &call);
        return finished(status, call.thrown);
    }

    // Writes to a stream, which must be binary; NM_IO where the stream fails.
    result<void> try_write(nm_format format, std::ostream &stream) const {
        return try_write(format, [&stream](const char *data, std::size_t size) {
            return stream.write(data, static_cast<std::streamsize>(size)).good();
        });
    }

    // What a file would hold; for NM_FORMAT_TETGEN_NODE the .node part, then the .ele part.
    result<std::string> try_to_string(nm_format format) const {
        return detail::allocating("the text", [&]() -> result<std::string> {
            std::string text;
            result<void> written = try_write(format, [&text](const char *data, std::size_t size) {
                text.append(data, size);
                return true;
            });
            if (!written) {
                return failure{written.status(), written.message()};
            }
            return text;
        });
    }

#if NETMESH_EXCEPTIONS
    // The same, throwing netmesh::error.
    mesh(std::uint32_t dim, const double *points, std::size_t n, std::size_t stride = 0)
        : mesh(try_create(dim, points, n, stride).value()) {}
    mesh(std::uint32_t dim, span<const double> points) : mesh(try_create(dim, points).value()) {}
    static mesh from_file(const std::string &path_utf8, nm_format format = NM_FORMAT_AUTO) {
        return try_from_file(path_utf8, format).value();
    }
    void run(const options &wanted = {}) { try_run(wanted).value(); }
    nm_counts counts() const { return try_counts().value(); }
    std::uint32_t dim() const { return counts().dim; }
    table<double> points() const { return try_points().value(); }
    table<std::uint32_t> simplices() const { return try_simplices().value(); }
    table<std::uint32_t> neighbors() const { return try_neighbors().value(); }
    std::vector<std::uint8_t> vertex_kinds() const { return try_vertex_kinds().value(); }
    std::vector<std::uint32_t> vertex_domains() const { return try_vertex_domains().value(); }
    std::vector<std::uint8_t> precision_limited() const { return try_precision_limited().value(); }
    std::vector<std::uint32_t> input_vertices() const { return try_input_vertices().value(); }
    std::vector<nm_domain> domains() const { return try_domains().value(); }
    nm_quality quality() const { return try_quality().value(); }
    nm_stats stats() const { return try_stats().value(); }
    nm_report validate(std::uint32_t level = 3) const { return try_validate(level).value(); }
    void save(const std::string &path_utf8, nm_format format = NM_FORMAT_AUTO) const {
        try_save(path_utf8, format).value();
    }
    void write(nm_format format, const write_function &sink) const {
        try_write(format, sink).value();
    }
    void write(nm_format format, std::ostream &stream) const { try_write(format, stream).value(); }
    std::string to_string(nm_format format) const { return try_to_string(format).value(); }
#endif

private:
    struct progress_call {
        const progress_function &function;
        std::exception_ptr thrown;

        static std::int32_t invoke(const nm_progress *progress, void *user_data) noexcept {
            auto &call = *static_cast<progress_call *>(user_data);
            return answered(call.thrown, [&] { return call.function(*progress); });
        }
    };

    struct write_call {
        const write_function &sink;
        std::exception_ptr thrown;

        static std::int32_t invoke(const void *data, std::size_t size, void *user_data) noexcept {
            auto &call = *static_cast<write_call *>(user_data);
            auto bytes = static_cast<const char *>(data);
            return answered(call.thrown, [&] { return call.sink(bytes, size); });
        }
    };

    // What a callback answers to C; an exception must not leave it, and waits in thrown.
    template <typename Body>
    static std::int32_t answered(std::exception_ptr &thrown, Body body) noexcept {
        return detail::guarded([&body]() -> std::int32_t { return body() ? 0 : 1; },
                               [&thrown]() -> std::int32_t {
                                   thrown = std::current_exception();
                                   return 1;
                               });
    }

    // The end of a call with a callback: what that threw goes first.
    static result<void> finished(nm_status status, const std::exception_ptr &thrown) {
        if (thrown) {
            std::rethrow_exception(thrown);
        }
        return detail::outcome(status);
    }

    static void copy(const options &from, nm_options &to) noexcept {
        to.output = from.output;
        to.algorithm = from.algorithm;
        to.ordering = from.ordering;
        to.criterion = from.criterion;
        to.threads = from.threads;
        to.quality_bound = from.quality_bound;
        to.epsilon = from.epsilon;
        to.delta = from.delta;
        to.gamma = from.gamma;
        to.yield_radius = from.yield_radius;
        to.encroachment = from.encroachment;
        to.cage_scale = from.cage_scale;
        to.root_scale = from.root_scale;
        to.seed = from.seed;
        to.max_vertices = from.max_vertices;
        to.instruments = from.instruments ? 1 : 0;
    }

    static result<mesh> made(nm_status status, nm_mesh *handle) noexcept {
        return status == NM_OK ? result<mesh>(mesh(handle)) : detail::failed(status);
    }

    template <typename Struct>
    result<Struct> filled(nm_status (*fill)(const nm_mesh *, Struct *)) const noexcept {
        Struct value = detail::sized<Struct>();
        nm_status status = fill(handle_, &value);
        return status == NM_OK ? result<Struct>(value) : detail::failed(status);
    }

    template <typename Element>
    using getter = nm_status (*)(const nm_mesh *, Element *, std::uint64_t, std::uint64_t *);

    template <typename Element>
    result<std::vector<Element>> array(getter<Element> fetch) const {
        return detail::allocating("the array", [&]() -> result<std::vector<Element>> {
            std::uint64_t needed = 0;
            nm_status status = fetch(handle_, nullptr, 0, &needed);
            std::vector<Element> elements(static_cast<std::size_t>(needed));
            if (status == NM_OK && needed != 0) {
                status = fetch(handle_, elements.data(), needed, nullptr);
            }
            if (status != NM_OK) {
                return detail::failed(status);
            }
            return elements;
        });
    }

    // An array in rows of dim + more elements.
    template <typename Element>
    result<table<Element>> rows(getter<Element> fetch, std::size_t more) const {
        result<nm_counts> counted = try_counts();
        if (!counted) {
            return failure{counted.status(), counted.message()};
        }
        result<std::vector<Element>> elements = array<Element>(fetch);
        if (!elements) {
            return failure{elements.status(), elements.message()};
        }
        return table<Element>(*std::move(elements), counted->dim + more);
    }

    nm_mesh *handle_ = nullptr;
};

}  // namespace netmesh

#endif  // NETMESH_HPP
