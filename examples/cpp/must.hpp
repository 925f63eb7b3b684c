// Check that the small examples share: a result that is wrong leaves main() as an exception, with a reason.
#ifndef NETMESH_EXAMPLES_MUST_HPP
#define NETMESH_EXAMPLES_MUST_HPP

#include <cstddef>
#include <iostream>
#include <random>
#include <stdexcept>
#include <vector>

#include "netmesh.hpp"

inline void expect(bool holds, const char *what) {
    if (!holds) {
        throw std::logic_error(what);
    }
}

// count * dim numbers in [0, 1), always the same ones.
inline std::vector<double> uniform_points(std::size_t count, std::size_t dim) {
    std::mt19937 random(42);
    std::vector<double> points(count * dim);
    for (double &x : points) {
        x = static_cast<double>(random()) / 4294967296.0;
    }
    return points;
}

// Runs an example; answers what main() answers.
template <typename Example>
int run_example(Example example) {
    // [catch]
    try {
        example();
    } catch (const netmesh::error &error) {
        std::cerr << error.status_name() << ": " << error.what() << '\n';
        return 1;
    }
    // [end]
    catch (const std::exception &error) {
        std::cerr << "this does not hold: " << error.what() << '\n';
        return 1;
    }
    return 0;
}

#endif
