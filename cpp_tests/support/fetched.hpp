// Arrays of the C interface as vectors: asks for the size, then for the elements, as a caller would.
#ifndef NETMESH_TESTS_FETCHED_HPP
#define NETMESH_TESTS_FETCHED_HPP

#include <cstdint>
#include <vector>

#include "check.hpp"

// `call` takes a buffer, its capacity and where to write the size that is needed.
template <class Item, class Call>
std::vector<Item> fetched(Call call) {
    std::uint64_t needed = 0, again = 0;
    REQUIRE_OK(call(static_cast<Item*>(nullptr), 0, &needed));
    std::vector<Item> items(needed);
    if (needed > 0) {
        CHECK_STATUS(call(items.data(), needed - 1, &again), NM_CAPACITY);
        CHECK_EQUAL(again, needed);
    }
    REQUIRE_OK(call(items.data(), needed, &again));
    CHECK_EQUAL(again, needed);
    return items;
}

#endif
