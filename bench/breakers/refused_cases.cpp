#include <limits>

#include "cases.hpp"

std::vector<Case> refused_cases(unsigned dim, std::uint64_t seed) {
    const auto with = [=](double value) {
        return [=] {
            PointSet points = generate("uniform", dim, usual_size(dim), seed);
            points.coordinates[17 * dim + 1] = value;
            return points;
        };
    };
    const auto all_equal = [=] {
        return PointSet{dim, std::vector<double>(usual_size(dim) * dim, 0.1), false};
    };
    const std::string place = "points[17]";
    return {
        {"one NaN", dim, Expected::non_finite, with(std::numeric_limits<double>::quiet_NaN()), place},
        {"one infinity", dim, Expected::non_finite, with(std::numeric_limits<double>::infinity()), place},
        {"one negative infinity", dim, Expected::non_finite, with(-std::numeric_limits<double>::infinity()), place},
        {"all equal", dim, Expected::degenerate, all_equal, "1 of them distinct"},
    };
}
