// netmesh/result.hpp - how netmesh.hpp tells of failures: netmesh::error is thrown, netmesh::result
// is returned. Included by netmesh.hpp. License: MIT OR Apache-2.0.

#ifndef NETMESH_RESULT_HPP
#define NETMESH_RESULT_HPP

#include <cstddef>
#include <cstdint>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>

#include "../netmesh.h"

// 1 where the compiler has exceptions; with -fno-exceptions only the functions are there that answer
// with a result, and those of the C interface.
#if defined(__cpp_exceptions) || defined(_CPPUNWIND)
#define NETMESH_EXCEPTIONS 1
#else
#define NETMESH_EXCEPTIONS 0
#endif

namespace netmesh {

// Error of a call that did not answer NM_OK. what() is the library's sentence.
class error : public std::runtime_error {
public:
    error(nm_status status, const std::string &message)
        : std::runtime_error(message), status_(status) {}

    nm_status status() const noexcept { return status_; }

    // Returns the status' name, such as "NM_CAPACITY".
    const char *status_name() const noexcept { return nm_status_name(status_); }

private:
    nm_status status_;
};

// Status, never NM_OK, and the library's sentence ("" where memory for it ran out).
struct failure {
    nm_status status;
    std::string message;
};

// Value, or the failure in its place. status() is NM_OK and message() "" where there is a value.
template <typename Value>
class [[nodiscard]] result {
public:
    result(Value value) : value_(std::move(value)) {}
    result(failure why) noexcept : failure_(std::move(why)) {}

    bool has_value() const noexcept { return value_.has_value(); }
    explicit operator bool() const noexcept { return has_value(); }

    nm_status status() const noexcept { return failure_.status; }
    const char *status_name() const noexcept { return nm_status_name(failure_.status); }
    const std::string &message() const noexcept { return failure_.message; }

    // Returns the value, which must be there.
    Value &operator*() & noexcept { return *value_; }
    const Value &operator*() const & noexcept { return *value_; }
    Value &&operator*() && noexcept { return std::move(*value_); }
    Value *operator->() noexcept { return &*value_; }
    const Value *operator->() const noexcept { return &*value_; }

#if NETMESH_EXCEPTIONS
    // Returns the value, or throws an error.
    Value value() && {
        require();
        return std::move(*value_);
    }
    const Value &value() const & {
        require();
        return *value_;
    }

private:
    void require() const {
        if (!has_value()) {
            throw error(failure_.status, failure_.message);
        }
    }
#endif

private:
    std::optional<Value> value_;
    failure failure_{NM_OK, {}};
};

// Success or failure of a call without a value.
template <>
class [[nodiscard]] result<void> {
public:
    result() noexcept = default;
    result(failure why) noexcept : failure_(std::move(why)) {}

    bool has_value() const noexcept { return failure_.status == NM_OK; }
    explicit operator bool() const noexcept { return has_value(); }

    nm_status status() const noexcept { return failure_.status; }
    const char *status_name() const noexcept { return nm_status_name(failure_.status); }
    const std::string &message() const noexcept { return failure_.message; }

#if NETMESH_EXCEPTIONS
    // Throws an error where there is a failure.
    void value() const {
        if (!has_value()) {
            throw error(failure_.status, failure_.message);
        }
    }
#endif

private:
    failure failure_{NM_OK, {}};
};

namespace detail {

// Returns body(), or rescue() where that throws.
template <typename Body, typename Rescue>
auto guarded(Body body, [[maybe_unused]] Rescue rescue) -> decltype(body()) {
#if NETMESH_EXCEPTIONS
    try {
        return body();
    } catch (...) {
        return rescue();
    }
#else
    return body();
#endif
}

// Returns the failure of an array that holds more or fewer numbers than it must.
inline failure wrong_size(const char *name, std::uint64_t size, const char *rule, std::uint64_t wanted) {
    return failure{NM_INVALID_ARGUMENT, std::string(name) + " holds " + std::to_string(size) +
                                            " numbers; it must be " + rule + " = " +
                                            std::to_string(wanted)};
}

// Returns a failure of that status, with this thread's message.
inline failure failed(nm_status status) noexcept {
    return guarded(
        [status] {
            std::string message(nm_last_error(nullptr, 0), '\0');
            nm_last_error(&message[0], message.size());
            message.pop_back();  // the NUL
            return failure{status, std::move(message)};
        },
        [status] { return failure{status, {}}; });
}

inline result<void> outcome(nm_status status) noexcept {
    return status == NM_OK ? result<void>() : result<void>(failed(status));
}

// Returns make(), which allocates; a failed allocation becomes NM_OUT_OF_MEMORY.
template <typename Make>
auto allocating(const char *what, Make make) -> decltype(make()) {
    return guarded(make, [what]() -> decltype(make()) {
        return guarded(
            [what] { return failure{NM_OUT_OF_MEMORY, std::string("no memory for ") + what}; },
            [] { return failure{NM_OUT_OF_MEMORY, {}}; });
    });
}

// Returns a struct for the library to fill, with its struct_size set.
template <typename Struct>
Struct sized() noexcept {
    Struct value{};
    value.struct_size = static_cast<std::uint32_t>(sizeof value);
    return value;
}

}  // namespace detail
}  // namespace netmesh

#endif  // NETMESH_RESULT_HPP
