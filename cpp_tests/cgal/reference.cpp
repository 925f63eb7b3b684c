#include "reference.hpp"

#include <algorithm>
#include <cmath>

std::unique_ptr<Reference> make_reference(unsigned dim, const double* points, std::size_t n) {
    switch (dim) {
        case 2: return make_reference_2(points, n);
        case 3: return make_reference_3(points, n);
        case 4: return make_reference_4(points, n);
        default: return nullptr;
    }
}

bool within_exact_range(const std::vector<double>& points) {
    return std::all_of(points.begin(), points.end(), [](double x) {
        const double size = std::fabs(x);
        return size == 0.0 || (size > 1e-58 && size < 1e61);
    });
}
