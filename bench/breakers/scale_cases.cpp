#include <cmath>
#include <cstring>
#include <limits>

#include "cases.hpp"
#include "random.hpp"

namespace {

PointSet scaled(PointSet points, double factor) {
    for (double& x : points.coordinates) x *= factor;
    return points;
}

// Pairs at distance about 2^-shift around points of [1, 2]^dim.
PointSet close_pairs(unsigned dim, int shift, std::uint64_t seed) {
    Random random(seed);
    PointSet points{dim, {}, false};
    for (std::size_t pair = 0; pair < usual_size(dim) / 4; ++pair) {
        std::vector<double> first(dim);
        for (double& x : first) x = 1.0 + random.unit();
        const auto direction = random.direction(dim);
        points.coordinates.insert(points.coordinates.end(), first.begin(), first.end());
        for (unsigned k = 0; k < dim; ++k) {
            points.coordinates.push_back(first[k] + std::ldexp(direction[k], -shift));
        }
    }
    return points;
}

// Pairs that differ by one unit in the last place of one coordinate.
PointSet neighboring_doubles(unsigned dim, std::uint64_t seed) {
    Random random(seed);
    PointSet points{dim, {}, false};
    for (std::size_t pair = 0; pair < usual_size(dim) / 4; ++pair) {
        std::vector<double> point(dim);
        for (double& x : point) x = 1.0 + random.unit();
        points.coordinates.insert(points.coordinates.end(), point.begin(), point.end());
        double& moved = point[random.below(dim)];
        moved = std::nextafter(moved, 3.0);
        points.coordinates.insert(points.coordinates.end(), point.begin(), point.end());
    }
    return points;
}

// Multiples of unit in [0, side * unit), from corner on: every double there is taken, or many are.
PointSet crumbs(unsigned dim, double corner, double unit, std::uint64_t side, std::uint64_t seed) {
    Random random(seed);
    PointSet points{dim, {}, false};
    for (std::size_t i = 0; i < usual_size(dim) * dim; ++i) {
        points.coordinates.push_back(corner + unit * static_cast<double>(random.below(side)));
    }
    return points;
}

// Uniform points, and one pair with nothing between its halves: 1 and 1 + 2^-52 beside each other,
// or 2^-60 apart where only one coordinate has doubles that fine.
PointSet one_tight_pair(unsigned dim, bool along_first_axis, std::uint64_t seed) {
    PointSet points = generate("uniform", dim, usual_size(dim) / 4, seed);
    for (double& x : points.coordinates) x = 4.0 * x - 2.0;
    for (int twin = 0; twin < 2; ++twin) {
        points.coordinates.push_back(along_first_axis && twin == 1 ? 1.0 + 0x1p-52 : 1.0);
        points.coordinates.push_back(along_first_axis ? 1.0 : twin * 0x1p-60);
        for (unsigned k = 2; k < dim; ++k) points.coordinates.push_back(0.0);
    }
    return points;
}

// Random bits as doubles: any sign, any mantissa, exponents up to the given one.
PointSet raw_bits(unsigned dim, unsigned exponents, std::uint64_t seed) {
    Random random(seed);
    PointSet points{dim, {}, false};
    for (std::size_t i = 0; i < usual_size(dim) / 2 * dim; ++i) {
        const std::uint64_t sign_and_mantissa = random.bits() & 0x800FFFFFFFFFFFFFu;
        const std::uint64_t bits = sign_and_mantissa | random.below(exponents) << 52;
        double x;
        std::memcpy(&x, &bits, sizeof x);
        points.coordinates.push_back(x);
    }
    return points;
}

// Every point is of one size in all coordinates, sizes from 2^-1000 to 2^1000.
PointSet mixed_sizes(unsigned dim, std::uint64_t seed) {
    Random random(seed);
    PointSet points{dim, {}, false};
    for (std::size_t i = 0; i < usual_size(dim) / 2; ++i) {
        const int exponent = static_cast<int>(random.below(2001)) - 1000;
        for (const double x : std::vector<double>(dim, 2.0)) {
            points.coordinates.push_back(std::ldexp(x * random.unit() - 1.0, exponent));
        }
    }
    return points;
}

// Uniform points and as many subnormal ones.
PointSet subnormals_among_others(unsigned dim, std::uint64_t seed) {
    PointSet points = generate("uniform", dim, usual_size(dim) / 2, seed);
    const PointSet tiny = crumbs(dim, 0.0, std::numeric_limits<double>::denorm_min(), 1u << 20, seed);
    points.coordinates.insert(points.coordinates.end(), tiny.coordinates.begin(),
                              tiny.coordinates.begin() + static_cast<std::ptrdiff_t>(points.coordinates.size()));
    return points;
}

}  // namespace

std::vector<Case> scale_cases(unsigned dim, std::uint64_t seed) {
    std::vector<Case> cases;
    const auto add = [&](const std::string& name, Expected expected, std::function<PointSet()> points) {
        cases.push_back({name, dim, expected, std::move(points), ""});
    };
    for (const int log_spread : {10, 30, 100, 300, 900, 1800}) {
        add("nested clusters, spread 2^" + std::to_string(log_spread), Expected::mesh_without_limit,
            [=] { return nested_clusters(dim, log_spread, seed); });
    }
    for (const int shift : {10, 20, 30, 40, 50}) {
        add("pairs at 2^-" + std::to_string(shift) + " in [1, 2]", Expected::mesh,
            [=] { return close_pairs(dim, shift, seed); });
    }
    add("1-ulp pairs in [1, 2]", Expected::mesh, [=] { return neighboring_doubles(dim, seed); });
    add("one 1-ulp pair, others uniform", Expected::mesh, [=] { return one_tight_pair(dim, true, seed); });
    add("one pair (1, 0), (1, 2^-60), others uniform", Expected::mesh,
        [=] { return one_tight_pair(dim, false, seed); });
    add("crumbs: multiples of 1 ulp beside 1", Expected::mesh,
        [=] { return crumbs(dim, 1.0, 0x1p-52, dim == 2 ? 40 : 10, seed); });
    add("crumbs: multiples of 2^-44 beside 1", Expected::mesh,
        [=] { return crumbs(dim, 1.0, 0x1p-44, 64, seed); });
    const auto uniform = [=] { return generate("uniform", dim, usual_size(dim), seed); };
    for (const char* factor : {"1e200", "1e-200", "1e300", "1e-300"}) {
        add(std::string("uniform times ") + factor, Expected::mesh_without_limit,
            [=] { return scaled(uniform(), std::atof(factor)); });
    }
    add("uniform times 1e308", Expected::mesh_or_range, [=] { return scaled(uniform(), 1e308); });
    add("subnormals below 2^-1022", Expected::mesh,
        [=] { return crumbs(dim, 0.0, std::numeric_limits<double>::denorm_min(), std::uint64_t{1} << 52, seed); });
    add("the smallest subnormals", Expected::mesh,
        [=] { return crumbs(dim, 0.0, std::numeric_limits<double>::denorm_min(), dim == 2 ? 40 : 10, seed); });
    add("subnormals among uniform points", Expected::mesh, [=] { return subnormals_among_others(dim, seed); });
    add("raw finite bit patterns", Expected::mesh_or_range, [=] { return raw_bits(dim, 2047, seed); });
    add("raw bit patterns below 2^1000", Expected::mesh, [=] { return raw_bits(dim, 2023, seed); });
    add("points of mixed exponents", Expected::mesh, [=] { return mixed_sizes(dim, seed); });
    return cases;
}
