#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <numeric>
#include <utility>

#include "inputs.hpp"
#include "random.hpp"

namespace {

using Coordinates = std::vector<double>;

// A multiple of 2^-20 in [0, 1): small integer combinations of such numbers are exact in double,
// so that collinear and coplanar mean what they say.
double coarse_unit(Random& random) {
    return std::ldexp(static_cast<double>(random.below(1u << 20)), -20);
}

Coordinates uniform(Random& random, unsigned dim, std::size_t n) {
    Coordinates out(n * dim);
    for (double& x : out) x = random.unit();
    return out;
}

Coordinates gaussian(Random& random, unsigned dim, std::size_t n) {
    Coordinates out(n * dim);
    for (double& x : out) x = random.gaussian();
    return out;
}

Coordinates sphere(Random& random, unsigned dim, std::size_t n) {
    Coordinates out;
    for (std::size_t i = 0; i < n; ++i) {
        const auto direction = random.direction(dim);
        out.insert(out.end(), direction.begin(), direction.begin() + dim);
    }
    return out;
}

// The most cube-like lattice of exactly n points: factors of n, dealt largest first to the
// shortest side.
Coordinates grid(unsigned dim, std::size_t n) {
    std::vector<std::size_t> factors;
    std::size_t rest = n;
    for (std::size_t p = 2; rest > 1; ++p) {
        for (; rest % p == 0; rest /= p) factors.push_back(p);
    }
    std::array<std::size_t, 8> sides;
    sides.fill(1);
    for (auto factor = factors.rbegin(); factor != factors.rend(); ++factor) {
        *std::min_element(sides.begin(), sides.begin() + dim) *= *factor;
    }
    Coordinates out;
    for (std::size_t i = 0; i < n; ++i) {
        std::size_t index = i;
        for (unsigned k = 0; k < dim; ++k) {
            out.push_back(static_cast<double>(index % sides[k]));
            index /= sides[k];
        }
    }
    return out;
}

// On the line through the origin with direction (1, 2, 3, ...).
Coordinates collinear(Random& random, unsigned dim, std::size_t n) {
    Coordinates out;
    for (std::size_t i = 0; i < n; ++i) {
        const double t = coarse_unit(random) + std::ldexp(static_cast<double>(random.below(1024)), -30);
        for (unsigned k = 0; k < dim; ++k) out.push_back(t * (k + 1));
    }
    return out;
}

// On the plane z = x + 2y, w = x - y, ...: tilted against every axis.
Coordinates coplanar(Random& random, unsigned dim, std::size_t n) {
    Coordinates out;
    for (std::size_t i = 0; i < n; ++i) {
        const double x = coarse_unit(random);
        const double y = coarse_unit(random);
        out.push_back(x);
        out.push_back(y);
        for (unsigned k = 2; k < dim; ++k) out.push_back(k % 2 == 0 ? x + k * y : x - (k - 2) * y);
    }
    return out;
}

// n/2 points, each twice, shuffled.
Coordinates duplicates(Random& random, unsigned dim, std::size_t n) {
    const Coordinates half = uniform(random, dim, n / 2);
    std::vector<std::size_t> order(n);
    std::iota(order.begin(), order.end(), std::size_t{0});
    for (std::size_t i = n; i > 1; --i) std::swap(order[i - 1], order[random.below(i)]);
    Coordinates out;
    for (const std::size_t i : order) {
        const double* point = half.data() + i % (n / 2) * dim;
        out.insert(out.end(), point, point + dim);
    }
    return out;
}

// Half on a line along the first axis, half on one along the second, a unit apart along the
// third; in the plane the two lines cross.
Coordinates two_skew_lines(Random& random, unsigned dim, std::size_t n) {
    Coordinates out(n * dim, 0.0);
    for (std::size_t i = 0; i < n; ++i) {
        const unsigned line = i % 2;
        out[i * dim + line] = 2.0 * random.unit() - 1.0;
        if (dim > 2) out[i * dim + 2] = line;
    }
    return out;
}

}  // namespace

PointSet generate(const std::string& name, unsigned dim, std::size_t n, std::uint64_t seed) {
    Random random(seed);
    if (name == "uniform") return {dim, uniform(random, dim, n), true};
    if (name == "gaussian") return {dim, gaussian(random, dim, n), true};
    if (name == "sphere") return {dim, sphere(random, dim, n), false};
    if (name == "grid") return {dim, grid(dim, n), false};
    if (name == "collinear") return {dim, collinear(random, dim, n), false};
    if (name == "coplanar" && dim > 2) return {dim, coplanar(random, dim, n), false};
    if (name == "duplicates") return {dim, duplicates(random, dim, n), false};
    if (name == "two_skew_lines") return {dim, two_skew_lines(random, dim, n), false};
    std::fprintf(stderr, "no generator '%s' in dimension %u\n", name.c_str(), dim);
    std::exit(2);
}

PointSet nested_clusters(unsigned dim, int log_spread, std::uint64_t seed) {
    constexpr int clusters = 32;
    constexpr int points_per_cluster = 8;
    Random random(seed);
    PointSet points{dim, {}, false};
    for (int cluster = 0; cluster < clusters; ++cluster) {
        const double exponent = log_spread * (0.5 - static_cast<double>(cluster) / clusters);
        const double whole = std::floor(exponent);
        for (int i = 0; i < points_per_cluster; ++i) {
            const double mantissa = std::exp2(exponent - whole) * (1.0 + 0.5 * random.unit());
            const auto direction = random.direction(dim);
            for (unsigned k = 0; k < dim; ++k) {
                points.coordinates.push_back(
                    std::ldexp(mantissa * direction[k], static_cast<int>(whole)));
            }
        }
    }
    return points;
}
