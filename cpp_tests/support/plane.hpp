// The plane by brute force, in long doubles: what tests hold answers of the library against.
#ifndef NETMESH_TESTS_PLANE_HPP
#define NETMESH_TESTS_PLANE_HPP

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

struct Point2 {
    long double x = 0, y = 0;
};

using Polygon2 = std::vector<Point2>;

inline std::vector<Point2> points_of(const std::vector<double>& coordinates) {
    std::vector<Point2> points;
    for (std::size_t i = 0; i + 1 < coordinates.size(); i += 2) {
        points.push_back({coordinates[i], coordinates[i + 1]});
    }
    return points;
}

inline long double square_distance(const Point2& a, const Point2& b) {
    return (a.x - b.x) * (a.x - b.x) + (a.y - b.y) * (a.y - b.y);
}

// Twice the area of a triangle, positive if counterclockwise.
inline long double turn(const Point2& a, const Point2& b, const Point2& c) {
    return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

inline long double area(const Polygon2& polygon) {
    long double sum = 0;
    for (std::size_t i = 2; i < polygon.size(); ++i) {
        sum += turn(polygon[0], polygon[i - 1], polygon[i]);
    }
    return sum / 2;
}

inline Point2 circumcenter(const Point2& a, const Point2& b, const Point2& c) {
    const long double bx = b.x - a.x, by = b.y - a.y, cx = c.x - a.x, cy = c.y - a.y;
    const long double bb = bx * bx + by * by, cc = cx * cx + cy * cy, twice = 2 * (bx * cy - by * cx);
    return {a.x + (cy * bb - by * cc) / twice, a.y + (bx * cc - cx * bb) / twice};
}

// Difference of the squared distances of x to b and to a: linear in x, positive on a's side.
inline long double advantage(const Point2& x, const Point2& a, const Point2& b) {
    return square_distance(x, b) - square_distance(x, a);
}

// The part of a convex polygon that is nearer to a than to b.
inline Polygon2 nearer(const Polygon2& polygon, const Point2& a, const Point2& b) {
    Polygon2 part;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const Point2 &from = polygon[i], &to = polygon[(i + 1) % polygon.size()];
        const long double first = advantage(from, a, b), second = advantage(to, a, b);
        if (first >= 0) {
            part.push_back(from);
        }
        if ((first > 0 && second < 0) || (first < 0 && second > 0)) {
            const long double share = first / (first - second);
            part.push_back({from.x + share * (to.x - from.x), from.y + share * (to.y - from.y)});
        }
    }
    return part;
}

// The part of a large square that is nearer to a point than to each of the others.
inline Polygon2 cell_among(const Point2& point, const std::vector<Point2>& others, long double reach) {
    Polygon2 cell{{-reach, -reach}, {reach, -reach}, {reach, reach}, {-reach, reach}};
    for (const Point2& other : others) {
        if (square_distance(point, other) > 0) {
            cell = nearer(cell, point, other);
        }
    }
    return cell;
}

// The least of the points nearest to x, of the first `count`.
inline std::uint32_t nearest_of(const std::vector<Point2>& points, std::size_t count, const Point2& x) {
    std::uint32_t best = 0;
    for (std::uint32_t id = 1; id < count; ++id) {
        if (square_distance(points[id], x) < square_distance(points[best], x)) {
            best = id;
        }
    }
    return best;
}

// All triples of points, counterclockwise, whose circumcircle has no point inside: the Delaunay
// triangulation of points in general position.
inline std::vector<std::vector<std::uint32_t>> empty_triples(const std::vector<Point2>& points) {
    std::vector<std::vector<std::uint32_t>> found;
    const auto count = static_cast<std::uint32_t>(points.size());
    for (std::uint32_t a = 0; a < count; ++a) {
        for (std::uint32_t b = a + 1; b < count; ++b) {
            for (std::uint32_t c = b + 1; c < count; ++c) {
                const Point2 center = circumcenter(points[a], points[b], points[c]);
                const long double square = square_distance(center, points[a]);
                bool is_empty = true;
                for (std::uint32_t d = 0; d < count && is_empty; ++d) {
                    is_empty = d == a || d == b || d == c || square_distance(center, points[d]) > square;
                }
                if (is_empty) {
                    const bool is_left = turn(points[a], points[b], points[c]) > 0;
                    found.push_back(is_left ? std::vector<std::uint32_t>{a, b, c}
                                            : std::vector<std::uint32_t>{a, c, b});
                }
            }
        }
    }
    return found;
}

#endif
