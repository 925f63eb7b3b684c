// netmesh/strided.hpp - meshes of points that lie in memory in some other way than one double after
// the other: with gaps, by coordinate instead of by point, as floats, as an mdspan, as a vector of
// std::array. License: MIT OR Apache-2.0.
//
//     std::vector<std::array<float, 3>> points = ...;
//     netmesh::mesh mesh = netmesh::make_mesh(netmesh::strided(points));
//
//     struct Particle { double mass; double position[3]; };
//     std::vector<Particle> particles = ...;              // every sizeof(Particle) / 8 doubles a point
//     netmesh::mesh mesh = netmesh::make_mesh(netmesh::strided_points<double>{
//         &particles[0].position[0], particles.size(), 3, sizeof(Particle) / sizeof(double), 1});
//
//     std::vector<double> xyz = ...;                      // all x, then all y, then all z
//     netmesh::mesh mesh = netmesh::make_mesh(netmesh::strided_points<double>{xyz.data(), n, 3, 1, n});
//
// Doubles whose coordinates lie side by side are handed to the library where they are. All else is
// copied once into an array of n x dim doubles, which is freed before make_mesh returns. Every
// number is converted exactly: types that hold numbers which doubles do not are refused by the
// compiler. O(n dim).

#ifndef NETMESH_STRIDED_HPP
#define NETMESH_STRIDED_HPP

#include <array>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <limits>
#include <string>
#include <type_traits>
#include <vector>

#include "../netmesh.hpp"

namespace netmesh {

// Coordinate k of point i is data[i * point_stride + k * coordinate_stride]. Strides count Numbers
// and may be negative or zero. The Numbers belong to the caller.
template <typename Number>
struct strided_points {
    static_assert(std::numeric_limits<Number>::is_specialized && !std::is_same_v<Number, bool> &&
                      std::numeric_limits<Number>::radix == 2 &&
                      std::numeric_limits<Number>::digits <= 53,
                  "coordinates are double, float, or integers of at most 53 bits");

    const Number *data;
    std::size_t count;
    std::size_t dim;
    std::ptrdiff_t point_stride;
    std::ptrdiff_t coordinate_stride;

    // Returns true if the library reads the points where they are.
    bool direct() const noexcept {
        return std::is_same_v<Number, double> && coordinate_stride == 1 && point_stride > 0 &&
               static_cast<std::size_t>(point_stride) >= dim;
    }

    double at(std::size_t point, std::size_t coordinate) const noexcept {
        return static_cast<double>(data[static_cast<std::ptrdiff_t>(point) * point_stride +
                                        static_cast<std::ptrdiff_t>(coordinate) * coordinate_stride]);
    }
};

// Describes a vector, array or span of points of a fixed size: std::array<Number, dim> or
// Number[dim].
template <typename Points, typename Point = std::remove_cv_t<std::remove_pointer_t<
                               decltype(std::data(std::declval<const Points &>()))>>,
          typename Number = std::decay_t<decltype(std::declval<const Point &>()[0])>>
strided_points<Number> strided(const Points &points) noexcept {
    constexpr std::size_t dim = sizeof(Point) / sizeof(Number);
    static_assert(std::is_same_v<Point, std::array<Number, dim>> || std::is_array_v<Point>,
                  "the points are std::array<Number, dim> or Number[dim]");
    const Point *first = std::data(points);
    return {first == nullptr ? nullptr : &(*first)[0], std::size(points), dim,
            static_cast<std::ptrdiff_t>(dim), 1};
}

// Describes a std::mdspan, or what has its members, of n points by dim coordinates, with any
// strided layout. Its accessor must be that of an array, such as std::default_accessor.
template <typename View>
auto strided_mdspan(const View &view) -> strided_points<std::remove_cv_t<typename View::element_type>> {
    static_assert(View::rank() == 2, "n points by dim coordinates");
    static_assert(std::is_convertible_v<decltype(view.data_handle()),
                                        const typename View::element_type *>,
                  "the elements lie in an array");
    return {view.data_handle(), static_cast<std::size_t>(view.extent(0)),
            static_cast<std::size_t>(view.extent(1)), static_cast<std::ptrdiff_t>(view.stride(0)),
            static_cast<std::ptrdiff_t>(view.stride(1))};
}

namespace detail {

// Makes a mesh of count points of dim coordinates, which coordinate(i, k) tells.
template <typename Coordinate>
result<mesh> pack(std::size_t count, std::size_t dim, Coordinate coordinate) {
    if (dim < NM_MIN_DIM || dim > NM_MAX_DIM) {
        return failure{NM_DIMENSION, "dim = " + std::to_string(dim) + " is not in " +
                                         std::to_string(NM_MIN_DIM) + ".." +
                                         std::to_string(NM_MAX_DIM)};
    }
    if (count >= NM_NONE) {
        return failure{NM_CAPACITY, "n = " + std::to_string(count) + " is more than 2^32 - 2"};
    }
    result<std::vector<double>> coordinates =
        allocating("the coordinates", [&]() -> result<std::vector<double>> {
            return std::vector<double>(count * dim);
        });
    if (!coordinates) {
        return failure{coordinates.status(), coordinates.message()};
    }
    double *next = coordinates->data();
    for (std::size_t i = 0; i < count; ++i) {
        for (std::size_t k = 0; k < dim; ++k) {
            *next++ = coordinate(i, k);
        }
    }
    return mesh::try_create(static_cast<std::uint32_t>(dim), *coordinates);
}

}  // namespace detail

// Makes a mesh of points. Fails where mesh() does, with NM_NULL_ARGUMENT where points.data is null,
// and with NM_OUT_OF_MEMORY where there is none for a copy.
template <typename Number>
result<mesh> try_make_mesh(const strided_points<Number> &points) {
    if constexpr (std::is_same_v<Number, double>) {
        if (points.direct() && points.dim <= NM_MAX_DIM) {
            return mesh::try_create(static_cast<std::uint32_t>(points.dim), points.data,
                                    points.count, static_cast<std::size_t>(points.point_stride));
        }
    }
    if (points.data == nullptr && points.count > 0) {
        return failure{NM_NULL_ARGUMENT, "points.data is null while points.count = " +
                                             std::to_string(points.count)};
    }
    return detail::pack(points.count, points.dim,
                        [&points](std::size_t i, std::size_t k) { return points.at(i, k); });
}

#if NETMESH_EXCEPTIONS
// Makes a mesh of points, and throws netmesh::error where it fails.
template <typename Number>
mesh make_mesh(const strided_points<Number> &points) {
    return try_make_mesh(points).value();
}
#endif

}  // namespace netmesh

#endif  // NETMESH_STRIDED_HPP
