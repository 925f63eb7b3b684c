// The inputs that kill mesh generators, each with the answer that netmesh owes.
#ifndef NETMESH_BREAKERS_CASES_HPP
#define NETMESH_BREAKERS_CASES_HPP

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "inputs.hpp"

enum class Expected {
    mesh,               // NM_OK; for a well-spaced mesh also NM_LIMIT
    mesh_without_limit, // a mesh, and doubles suffice: no precision-limited cell
    mesh_or_range,      // NM_OK, or NM_LIMIT because no cage around the points is made of doubles
    non_finite,         // NM_NON_FINITE, the message naming the point
    degenerate,         // NM_DEGENERATE_INPUT, the message saying how many points are distinct
};

struct Case {
    std::string name;
    unsigned dim = 0;
    Expected expected = Expected::mesh;
    std::function<PointSet()> points;
    std::string in_message;  // what the message of a refusal must contain
};

// Spread, close pairs, exponents from the subnormals to the largest double.
std::vector<Case> scale_cases(unsigned dim, std::uint64_t seed);
// Duplicates and positions that exact arithmetic alone can tell apart.
std::vector<Case> position_cases(unsigned dim, std::uint64_t seed);
// Not a number, infinite, all equal.
std::vector<Case> refused_cases(unsigned dim, std::uint64_t seed);
// Inputs that were once found to fail: the files NAME.points of a directory, in the order of their names.
std::vector<Case> found_cases(const std::string& directory);

// Number of points that the cases of a dimension have where nothing else fixes the number.
std::size_t usual_size(unsigned dim);

#endif
