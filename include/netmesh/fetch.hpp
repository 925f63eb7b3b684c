// netmesh/fetch.hpp - arrays of the C interface, as netmesh.hpp gets them. Included by it.
// License: MIT OR Apache-2.0.

#ifndef NETMESH_FETCH_HPP
#define NETMESH_FETCH_HPP

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "../netmesh.h"
#include "result.hpp"
#include "table.hpp"

namespace netmesh {
namespace detail {

// Gets an array by a function with the last three arguments of a getter: first the length, then it.
template <typename Element, typename Fetch>
result<std::vector<Element>> fetched(Fetch fetch) {
    return allocating("the array", [&]() -> result<std::vector<Element>> {
        std::uint64_t needed = 0;
        nm_status status = fetch(nullptr, 0, &needed);
        std::vector<Element> elements(static_cast<std::size_t>(needed));
        if (status == NM_OK && needed != 0) {
            status = fetch(elements.data(), needed, nullptr);
        }
        if (status != NM_OK) {
            return failed(status);
        }
        return elements;
    });
}

// Gets an array in rows of so many elements.
template <typename Element>
result<table<Element>> in_rows(result<std::vector<Element>> elements, std::size_t width) {
    if (!elements) {
        return failure{elements.status(), elements.message()};
    }
    return table<Element>(*std::move(elements), width);
}

}  // namespace detail
}  // namespace netmesh

#endif  // NETMESH_FETCH_HPP
