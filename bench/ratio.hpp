// Functions that the programs of ratios share: calls that must not fail, and medians.
#ifndef NETMESH_BENCH_RATIO_HPP
#define NETMESH_BENCH_RATIO_HPP

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <vector>

#include "netmesh.h"

// Ends the program with the library's message where a call failed.
inline void require(nm_status status, const char* call) {
    if (status == NM_OK) return;
    char message[512];
    nm_last_error(message, sizeof message);
    std::fprintf(stderr, "%s: %s: %s\n", call, nm_status_name(status), message);
    std::exit(1);
}

// All that a getter has.
template <class Item, class Getter>
std::vector<Item> get(const nm_mesh* mesh, Getter getter, const char* call) {
    std::uint64_t needed = 0;
    require(getter(mesh, nullptr, 0, &needed), call);
    std::vector<Item> items(needed);
    require(getter(mesh, items.data(), needed, nullptr), call);
    return items;
}

// NaN of nothing.
inline double median(std::vector<double> values) {
    if (values.empty()) return std::nan("");
    std::sort(values.begin(), values.end());
    const std::size_t half = values.size() / 2;
    return values.size() % 2 == 1 ? values[half] : (values[half - 1] + values[half]) / 2;
}

#endif
