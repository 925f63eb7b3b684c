// Inputs that the adapters are tried on: some that are easy, and those that are hard on triangulations.
#ifndef NETMESH_TESTS_POINT_SETS_HPP
#define NETMESH_TESTS_POINT_SETS_HPP

#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "inputs.hpp"

struct NamedPoints {
    std::string name;
    PointSet points;
    bool full_rank = true;  // has a plain Delaunay triangulation
};

// Pairs one unit in the last place apart, in general position otherwise.
inline PointSet ulp_pairs(unsigned dim, std::size_t pairs) {
    PointSet points = generate("uniform", dim, pairs, 5);
    for (std::size_t i = 0; i < pairs; ++i) {
        for (unsigned k = 0; k < dim; ++k) {
            const double x = points.point(i)[k];
            points.coordinates.push_back(k == i % dim ? std::nextafter(x, 2.0) : x);
        }
    }
    return points;
}

// In 2D or 3D, a few hundred points each.
inline std::vector<NamedPoints> adapter_inputs(unsigned dim) {
    std::vector<NamedPoints> all;
    for (const char* name : {"uniform", "gaussian", "sphere", "grid", "duplicates"}) {
        all.push_back({name, generate(name, dim, 343)});  // the grid is 7 x 7 x 7, or 49 x 7
    }
    all.push_back({"ulp_pairs", ulp_pairs(dim, 60)});
    all.push_back({"clusters", nested_clusters(dim, 200, 3)});
    all.push_back({"collinear", generate("collinear", dim, 40), false});
    if (dim == 3) {
        all.push_back({"coplanar", generate("coplanar", dim, 100), false});
        all.push_back({"two_skew_lines", generate("two_skew_lines", dim, 40)});
    }
    return all;
}

#endif
