#include <algorithm>
#include <cmath>

#include "cases.hpp"
#include "random.hpp"

namespace {

// Every point twice, and all but one equal.
PointSet all_but_one_equal(unsigned dim) {
    PointSet points{dim, std::vector<double>(usual_size(dim) * dim, 0.1), false};
    points.coordinates.back() = 0.7;
    return points;
}

PointSet on_an_axis(unsigned dim, std::uint64_t seed) {
    Random random(seed);
    PointSet points{dim, std::vector<double>(usual_size(dim) * dim, 0.0), false};
    for (std::size_t i = 0; i < usual_size(dim); ++i) points.coordinates[i * dim] = random.unit();
    return points;
}

// All signed permutations of (1, 2, ..., dim): integers, so exactly on one sphere.
PointSet exactly_cospherical(unsigned dim) {
    PointSet points{dim, {}, false};
    std::vector<double> magnitudes(dim);
    for (unsigned k = 0; k < dim; ++k) magnitudes[k] = k + 1.0;
    do {
        for (unsigned signs = 0; signs < 1u << dim; ++signs) {
            for (unsigned k = 0; k < dim; ++k) {
                points.coordinates.push_back(signs >> k & 1 ? -magnitudes[k] : magnitudes[k]);
            }
        }
    } while (std::next_permutation(magnitudes.begin(), magnitudes.end()));
    return points;
}

// A square lattice of the given rank in a tilted flat. The columns of |v|^2 I - 2 v v^T with
// v = (1, 2, ..., dim) are integer, orthogonal and of one length; times unit they may be rounded.
PointSet tilted_lattice(unsigned dim, unsigned rank, double unit) {
    double square = 0.0;
    for (unsigned k = 1; k <= dim; ++k) square += k * k;
    const auto entry = [=](unsigned row, unsigned column) {
        return (row == column ? square : 0.0) - 2.0 * (row + 1.0) * (column + 1.0);
    };
    std::size_t side = 2;
    while (std::pow(side + 1.0, rank) <= static_cast<double>(usual_size(dim)) / 2) ++side;
    std::size_t count = 1;
    for (unsigned k = 0; k < rank; ++k) count *= side;
    PointSet points{dim, {}, false};
    for (std::size_t i = 0; i < count; ++i) {
        for (unsigned row = 0; row < dim; ++row) {
            double x = 0.0;
            std::size_t index = i;
            for (unsigned column = 0; column < rank; ++column, index /= side) {
                x += static_cast<double>(index % side) * entry(row, column);
            }
            points.coordinates.push_back(x * unit);
        }
    }
    return points;
}

}  // namespace

std::vector<Case> position_cases(unsigned dim, std::uint64_t seed) {
    std::vector<Case> cases;
    const auto add = [&](const std::string& name, std::function<PointSet()> points) {
        cases.push_back({name, dim, Expected::mesh, std::move(points), ""});
    };
    const std::size_t n = usual_size(dim);
    add("every point twice", [=] { return generate("duplicates", dim, n, seed); });
    add("all but one equal", [=] { return all_but_one_equal(dim); });
    add("collinear, tilted", [=] { return generate("collinear", dim, n / 2, seed); });
    add("collinear, on an axis", [=] { return on_an_axis(dim, seed); });
    if (dim > 2) add("coplanar, tilted", [=] { return generate("coplanar", dim, n / 2, seed); });
    if (dim > 2) add("two skew lines", [=] { return generate("two_skew_lines", dim, n / 2, seed); });
    add("cospherical to rounding", [=] { return generate("sphere", dim, n, seed); });
    add("cospherical exactly", [=] { return exactly_cospherical(dim); });
    add("lattice", [=] { return generate("grid", dim, n, seed); });
    for (unsigned rank = 1; rank <= dim; ++rank) {
        const std::string name = "tilted lattice of rank " + std::to_string(rank);
        add(name, [=] { return tilted_lattice(dim, rank, 1.0); });
        if (rank > 1) add(name + ", rounded", [=] { return tilted_lattice(dim, rank, 0.1); });
    }
    return cases;
}
