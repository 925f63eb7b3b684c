// netmesh/writers.hpp - a mesh in files, streams and strings. A base of the class
// netmesh::mesh, for netmesh.hpp, which includes it. License: MIT OR Apache-2.0.

#ifndef NETMESH_WRITERS_HPP
#define NETMESH_WRITERS_HPP

#include <cstddef>
#include <ostream>
#include <string>

#include "../netmesh.h"
#include "boundary.hpp"
#include "callbacks.hpp"
#include "options.hpp"
#include "result.hpp"

namespace netmesh {
namespace detail {

// Functions that write a mesh.
class writers : public boundary {
public:
    // Writes a file; the path is UTF-8.
    result<void> try_save(const std::string &path_utf8, nm_format format = NM_FORMAT_AUTO) const {
        return outcome(nm_export(handle_, path_utf8.c_str(), format));
    }

    // Writes a file of a selection; the path is UTF-8.
    result<void> try_save(const std::string &path_utf8, const selection &wanted,
                          nm_format format = NM_FORMAT_AUTO) const {
        nm_selection which = raw(wanted);
        return outcome(nm_export_selected(handle_, &which, path_utf8.c_str(), format));
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

    // Returns the bytes that a file would hold; for NM_FORMAT_TETGEN_NODE the .node part, then the
    // .ele part.
    result<std::string> try_to_string(nm_format format) const {
        return allocating("the text", [&]() -> result<std::string> {
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
    // Each function below does what the try_ function of its name does, and throws netmesh::error.
    void save(const std::string &path_utf8, nm_format format = NM_FORMAT_AUTO) const {
        try_save(path_utf8, format).value();
    }
    void save(const std::string &path_utf8, const selection &wanted,
              nm_format format = NM_FORMAT_AUTO) const {
        try_save(path_utf8, wanted, format).value();
    }
    void write(nm_format format, const write_function &sink) const {
        try_write(format, sink).value();
    }
    void write(nm_format format, std::ostream &stream) const { try_write(format, stream).value(); }
    std::string to_string(nm_format format) const { return try_to_string(format).value(); }
#endif

protected:
    explicit writers(nm_mesh *handle) noexcept : boundary(handle) {}
};

}  // namespace detail
}  // namespace netmesh

#endif  // NETMESH_WRITERS_HPP
