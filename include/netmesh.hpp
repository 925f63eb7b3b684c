// netmesh.hpp - netmesh for C++17: handles that free themselves, errors as exceptions, arrays as
// vectors. Header-only, over netmesh.h, which is the manual for everything that is only named here:
// shapes, units, ranges, costs. License: MIT OR Apache-2.0.
//
//     std::vector<double> points = ...;                        // n x 3
//     netmesh::mesh mesh(3, points);
//     mesh.run(netmesh::options().quality_bound(4).threads(0));
//     std::vector<std::uint32_t> tetrahedra = mesh.simplices();    // m x 4
//     mesh.save("mesh.vtu");
//
// Every function that answers other than NM_OK in C throws netmesh::error here, and the mesh is then
// as it was before the call. Const member functions of one mesh may run at the same time in several
// threads; run() needs the mesh for itself and throws error(NM_STATE) where it does not have it.

#ifndef NETMESH_HPP
#define NETMESH_HPP

#include <cstddef>
#include <cstdint>
#include <exception>
#include <functional>
#include <ostream>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "netmesh.h"

namespace netmesh {

// A call that did not answer NM_OK. what() is the library's sentence.
class error : public std::runtime_error {
public:
    error(nm_status status, const std::string &message)
        : std::runtime_error(message), status_(status) {}

    nm_status status() const noexcept { return status_; }

    // "NM_CAPACITY" and the like.
    const char *status_name() const noexcept { return nm_status_name(status_); }

private:
    nm_status status_;
};

namespace detail {

inline std::string last_message() {
    std::string message(nm_last_error(nullptr, 0), '\0');
    nm_last_error(&message[0], message.size());
    message.pop_back();  // the NUL
    return message;
}

inline void check(nm_status status) {
    if (status != NM_OK) {
        throw error(status, last_message());
    }
}

// Runs what a callback does; an exception must not leave it through C.
template <typename Body>
std::int32_t guarded(std::exception_ptr &thrown, Body body) noexcept {
    try {
        return body() ? 0 : 1;
    } catch (...) {
        thrown = std::current_exception();
        return 1;
    }
}

// As check, but what a callback threw goes first.
inline void check(nm_status status, const std::exception_ptr &thrown) {
    if (thrown) {
        std::rethrow_exception(thrown);
    }
    check(status);
}

// A struct that the library fills, with its struct_size set.
template <typename Struct>
Struct sized() noexcept {
    Struct value{};
    value.struct_size = static_cast<std::uint32_t>(sizeof value);
    return value;
}

}  // namespace detail

// The version of the library that is linked, "major.minor.patch".
inline std::string version() { return nm_version(); }

// Sees a run's progress on the thread that called run(), about 20 times a second and where a round
// or a stage ends; false cancels the run, which then throws error(NM_CANCELLED). An exception cancels
// it too and leaves run() itself.
using progress_function = std::function<bool(const nm_progress &)>;

// What a run shall do: nm_options and a progress function. Each setter answers *this.
struct options {
    nm_options values;
    progress_function on_progress;  // empty: none. values.progress and values.user_data are ignored

    options() { detail::check(nm_options_init(&values, sizeof values)); }

    options &output(nm_output value) { values.output = value; return *this; }
    options &algorithm(nm_algorithm value) { values.algorithm = value; return *this; }
    options &ordering(nm_ordering value) { values.ordering = value; return *this; }
    options &criterion(nm_criterion value) { values.criterion = value; return *this; }
    options &threads(std::uint32_t value) { values.threads = value; return *this; }
    options &quality_bound(double value) { values.quality_bound = value; return *this; }
    options &epsilon(double value) { values.epsilon = value; return *this; }
    options &delta(double value) { values.delta = value; return *this; }
    options &gamma(double value) { values.gamma = value; return *this; }
    options &yield_radius(double value) { values.yield_radius = value; return *this; }
    options &encroachment(double value) { values.encroachment = value; return *this; }
    options &cage_scale(double value) { values.cage_scale = value; return *this; }
    options &root_scale(double value) { values.root_scale = value; return *this; }
    options &seed(std::uint64_t value) { values.seed = value; return *this; }
    options &max_vertices(std::uint64_t value) { values.max_vertices = value; return *this; }
    options &instruments(bool value) { values.instruments = value ? 1 : 0; return *this; }
    options &progress(progress_function value) {
        on_progress = std::move(value);
        return *this;
    }
};

// Points, and after run() their mesh. Moves, does not copy; a moved-from mesh throws
// error(NM_NULL_ARGUMENT) from everything but assignment and destruction.
class mesh {
public:
    // Copies n points: coordinate k of point i is points[i * stride + k]; stride 0 means dim.
    mesh(std::uint32_t dim, const double *points, std::size_t n, std::size_t stride = 0) {
        detail::check(nm_mesh_create(dim, n, points, stride, &handle_));
    }

    // Copies points, dim coordinates each.
    mesh(std::uint32_t dim, const std::vector<double> &points)
        : mesh(dim, points.data(), whole_points(dim, points.size())) {}

    // Reads the points of a file; the path is UTF-8.
    static mesh from_file(const std::string &path_utf8, nm_format format = NM_FORMAT_AUTO) {
        nm_mesh *handle = nullptr;
        detail::check(nm_mesh_create_from_file(path_utf8.c_str(), format, &handle));
        return mesh(handle);
    }

    // Takes over a handle of the C interface.
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

    // Meshes the points with the default options.
    void run() { detail::check(nm_run(handle_, nullptr)); }

    // Meshes the points, or leaves everything as it was and throws.
    void run(const options &wanted) {
        progress_call call{wanted.on_progress, nullptr};
        nm_options values = wanted.values;
        values.progress = wanted.on_progress ? &progress_call::invoke : nullptr;
        values.user_data = &call;
        detail::check(nm_run(handle_, &values), call.thrown);
    }

    nm_counts counts() const { return filled<nm_counts>(nm_mesh_counts); }

    std::uint32_t dim() const { return counts().dim; }

    // vertices x dim; the distinct inputs first.
    std::vector<double> points() const { return array<double>(nm_mesh_get_points); }

    // simplices x (dim + 1) vertex ids, positively oriented.
    std::vector<std::uint32_t> simplices() const {
        return array<std::uint32_t>(nm_mesh_get_simplices);
    }

    // simplices x (dim + 1) simplex ids, the i-th opposite corner i; NM_NONE on the hull.
    std::vector<std::uint32_t> neighbors() const {
        return array<std::uint32_t>(nm_mesh_get_neighbors);
    }

    // An nm_vertex_kind per vertex.
    std::vector<std::uint8_t> vertex_kinds() const {
        return array<std::uint8_t>(nm_mesh_get_vertex_kinds);
    }

    // The innermost domain of each vertex.
    std::vector<std::uint32_t> vertex_domains() const {
        return array<std::uint32_t>(nm_mesh_get_vertex_domains);
    }

    // 1 per vertex whose cell doubles are too coarse for, else 0.
    std::vector<std::uint8_t> precision_limited() const {
        return array<std::uint8_t>(nm_mesh_get_precision_limited);
    }

    // The vertex of each input.
    std::vector<std::uint32_t> input_vertices() const {
        return array<std::uint32_t>(nm_mesh_get_input_vertices);
    }

    // The tree of domains, the root first.
    std::vector<nm_domain> domains() const { return array<nm_domain>(nm_mesh_get_domains); }

    nm_quality quality() const { return filled<nm_quality>(nm_mesh_quality); }

    nm_stats stats() const { return filled<nm_stats>(nm_mesh_stats); }

    // Checks the mesh independently of the code that built it: 1 topology, 2 geometry, 3 the
    // promises. The result says what was found; a broken mesh does not throw.
    nm_report validate(std::uint32_t level = 3) const {
        nm_report report = detail::sized<nm_report>();
        detail::check(nm_mesh_validate(handle_, level, &report));
        return report;
    }

    // Writes a file; the path is UTF-8.
    void save(const std::string &path_utf8, nm_format format = NM_FORMAT_AUTO) const {
        detail::check(nm_export(handle_, path_utf8.c_str(), format));
    }

    // Writes to a function, piece by piece; false stops with error(NM_IO), an exception stops and
    // leaves write() itself.
    void write(nm_format format,
               const std::function<bool(const char *data, std::size_t size)> &sink) const {
        write_call call{sink, nullptr};
        nm_write_fn invoke = sink ? &write_call::invoke : nullptr;
        detail::check(nm_export_write(handle_, format, invoke, &call), call.thrown);
    }

    // Writes to a stream, which must be binary; a stream that fails throws error(NM_IO).
    void write(nm_format format, std::ostream &stream) const {
        write(format, [&stream](const char *data, std::size_t size) {
            return stream.write(data, static_cast<std::streamsize>(size)).good();
        });
    }

private:
    struct progress_call {
        const progress_function &function;
        std::exception_ptr thrown;

        static std::int32_t invoke(const nm_progress *progress, void *user_data) noexcept {
            auto &call = *static_cast<progress_call *>(user_data);
            return detail::guarded(call.thrown, [&] { return call.function(*progress); });
        }
    };

    struct write_call {
        const std::function<bool(const char *, std::size_t)> &sink;
        std::exception_ptr thrown;

        static std::int32_t invoke(const void *data, std::size_t size, void *user_data) noexcept {
            auto &call = *static_cast<write_call *>(user_data);
            auto bytes = static_cast<const char *>(data);
            return detail::guarded(call.thrown, [&] { return call.sink(bytes, size); });
        }
    };

    static std::size_t whole_points(std::uint32_t dim, std::size_t coordinates) {
        if (dim != 0 && coordinates % dim != 0) {
            throw error(NM_INVALID_ARGUMENT, "points holds " + std::to_string(coordinates) +
                                                 " coordinates, not a multiple of dim = " +
                                                 std::to_string(dim));
        }
        return dim == 0 ? 0 : coordinates / dim;
    }

    template <typename Struct>
    Struct filled(nm_status (*fill)(const nm_mesh *, Struct *)) const {
        Struct value = detail::sized<Struct>();
        detail::check(fill(handle_, &value));
        return value;
    }

    template <typename Element>
    std::vector<Element> array(nm_status (*fetch)(const nm_mesh *, Element *, std::uint64_t,
                                                  std::uint64_t *)) const {
        std::uint64_t needed = 0;
        detail::check(fetch(handle_, nullptr, 0, &needed));
        std::vector<Element> values(static_cast<std::size_t>(needed));
        if (needed != 0) {
            detail::check(fetch(handle_, values.data(), needed, nullptr));
        }
        return values;
    }

    nm_mesh *handle_ = nullptr;
};

}  // namespace netmesh

#endif  // NETMESH_HPP
