// netmesh/callbacks.hpp - C functions that call what C++ has given: progress, sizes, pieces of an export. For
// netmesh.hpp, which includes it. License: MIT OR Apache-2.0.

#ifndef NETMESH_CALLBACKS_HPP
#define NETMESH_CALLBACKS_HPP

#include <cstddef>
#include <cstdint>
#include <exception>
#include <limits>

#include "../netmesh.h"
#include "options.hpp"
#include "result.hpp"

namespace netmesh {
namespace detail {

// Calls a callback and returns its answer to C. An exception must not leave it, and waits in
// thrown.
template <typename Body>
std::int32_t answered(std::exception_ptr &thrown, Body body) noexcept {
    return guarded([&body]() -> std::int32_t { return body() ? 0 : 1; },
                   [&thrown]() -> std::int32_t {
                       thrown = std::current_exception();
                       return 1;
                   });
}

struct progress_call {
    const progress_function &function;
    std::exception_ptr thrown;

    static std::int32_t invoke(const nm_progress *progress, void *user_data) noexcept {
        auto &call = *static_cast<progress_call *>(user_data);
        return answered(call.thrown, [&] { return call.function(*progress); });
    }
};

// An exception ends the run: no size is NaN.
struct size_call {
    const size_function &function;
    std::exception_ptr thrown;

    static double invoke(const double *x, void *user_data) noexcept {
        auto &call = *static_cast<size_call *>(user_data);
        return guarded([&]() -> double { return call.function(x); },
                       [&]() -> double {
                           call.thrown = std::current_exception();
                           return std::numeric_limits<double>::quiet_NaN();
                       });
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

// Ends a call with a callback: an exception of the callback's is thrown first.
inline result<void> finished(nm_status status, const std::exception_ptr &thrown) {
    if (thrown) {
        std::rethrow_exception(thrown);
    }
    return outcome(status);
}

}  // namespace detail
}  // namespace netmesh

#endif  // NETMESH_CALLBACKS_HPP
