// One yardstick for both meshers' tetrahedra, in plain double arithmetic.
#ifndef NETMESH_TESTS_TETRAHEDRON_QUALITY_HPP
#define NETMESH_TESTS_TETRAHEDRON_QUALITY_HPP

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

struct TetrahedronQuality {
    double worst_radius_edge = 0.0;  // circumradius over shortest edge
    double mean_radius_edge = 0.0;
    double least_dihedral_degrees = 180.0;
};

namespace tetrahedra {

struct Vector {
    double x, y, z;
};

inline Vector operator-(Vector a, Vector b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
inline double dot(Vector a, Vector b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
inline double length(Vector a) { return std::sqrt(dot(a, a)); }
inline Vector cross(Vector a, Vector b) {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

inline double radius_edge(const Vector (&p)[4]) {
    double shortest = length(p[1] - p[0]);
    for (int i = 0; i < 4; ++i) {
        for (int j = i + 1; j < 4; ++j) shortest = std::min(shortest, length(p[j] - p[i]));
    }
    const Vector a = p[1] - p[0], b = p[2] - p[0], c = p[3] - p[0];
    const Vector bc = cross(b, c), ca = cross(c, a), ab = cross(a, b);
    const double aa = dot(a, a), bb = dot(b, b), cc = dot(c, c);
    const Vector sum = {aa * bc.x + bb * ca.x + cc * ab.x, aa * bc.y + bb * ca.y + cc * ab.y,
                        aa * bc.z + bb * ca.z + cc * ab.z};
    return length(sum) / (2.0 * std::fabs(dot(a, bc))) / shortest;
}

inline double least_dihedral(const Vector (&p)[4]) {
    double least = 180.0;
    for (int i = 0; i < 4; ++i) {
        for (int j = i + 1; j < 4; ++j) {
            const int k = i != 0 && j != 0 ? 0 : i != 1 && j != 1 ? 1 : 2;
            const int l = 6 - i - j - k;
            const Vector edge = p[j] - p[i];
            const Vector one = cross(edge, p[k] - p[i]), two = cross(edge, p[l] - p[i]);
            const double angle = std::atan2(length(cross(one, two)), dot(one, two));
            least = std::min(least, angle * 57.29577951308232);
        }
    }
    return least;
}

// keep(tetrahedron's four ids) chooses what is measured.
template <class Keep>
TetrahedronQuality measure(const std::vector<double>& points, const std::vector<std::uint32_t>& ids,
                           Keep keep) {
    TetrahedronQuality out;
    std::size_t measured = 0;
    for (std::size_t t = 0; t + 3 < ids.size(); t += 4) {
        if (!keep(&ids[t])) continue;
        Vector p[4];
        for (int i = 0; i < 4; ++i) {
            const double* x = points.data() + 3 * static_cast<std::size_t>(ids[t + static_cast<std::size_t>(i)]);
            p[i] = {x[0], x[1], x[2]};
        }
        const double ratio = radius_edge(p);
        out.worst_radius_edge = std::max(out.worst_radius_edge, ratio);
        out.mean_radius_edge += ratio;
        out.least_dihedral_degrees = std::min(out.least_dihedral_degrees, least_dihedral(p));
        ++measured;
    }
    if (measured > 0) out.mean_radius_edge /= static_cast<double>(measured);
    return out;
}

}  // namespace tetrahedra

#endif
