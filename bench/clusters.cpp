#include "clusters.hpp"

#include <cmath>
#include <cstdint>

#include "random.hpp"

PointSet clusters(unsigned dim, std::size_t n) {
    constexpr std::size_t points_per_cluster = 100;
    constexpr std::uint64_t seed = 1;
    const std::size_t count = (n + points_per_cluster - 1) / points_per_cluster;
    const double deviation = std::ldexp(std::pow(static_cast<double>(count), -1.0 / dim), -6);
    Random random(seed);
    const PointSet centers = generate("uniform", dim, count, seed + 1);
    PointSet points{dim, {}, true};
    points.coordinates.reserve(n * dim);
    for (std::size_t i = 0; i < n; ++i) {
        for (unsigned k = 0; k < dim; ++k) {
            points.coordinates.push_back(centers.point(i % count)[k] + random.gaussian() * deviation);
        }
    }
    return points;
}

PointSet ratio_input(const std::string& name, unsigned dim, std::size_t n) {
    return name == "clusters" ? clusters(dim, n) : generate(name, dim, n);
}
