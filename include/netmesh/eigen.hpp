// netmesh/eigen.hpp - points, simplices and neighbours as matrices of Eigen (3.3 or later, MPL2).
// License: MIT OR Apache-2.0.
//
//     Eigen::MatrixXd points = ...;                                            // n x dim
//     netmesh::mesh mesh = netmesh::eigen::mesh_of_rows(points);
//     mesh.run();
//     Eigen::MatrixXd vertices = netmesh::eigen::points_in_rows(mesh);         // vertices x dim
//     Eigen::MatrixXi tetrahedra = netmesh::eigen::simplices_in_rows<int>(mesh);  // simplices x 4
//
// Each function is there for points in rows (n x dim, as libigl has them) and in columns (dim x n).
//
// IN. Any dense expression of doubles, floats or integers up to 53 bits; conversions are exact. A
// matrix, Map, Ref or block of doubles in which the coordinates of a point lie side by side, rows of
// a row-major or columns of a column-major matrix, is read where it is, whatever its outer stride.
// Others are copied once, and an expression that is not in memory is evaluated.
//
// OUT. Matrices in the order of the library: rows are row-major, columns column-major. The
// library writes into their memory; Eigen converts on assignment to a matrix of another order. Ids
// are std::uint32_t as in netmesh.h, or converted to another Index; NM_NONE is then -1 where Index
// has a sign, and an id that Index does not hold is an error (NM_CAPACITY).
//
// Errors are thrown as netmesh::error, as by the member functions of netmesh::mesh. O(n dim).

#ifndef NETMESH_EIGEN_HPP
#define NETMESH_EIGEN_HPP

#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <type_traits>

#include <Eigen/Core>

#include "strided.hpp"

#if !NETMESH_EXCEPTIONS
#error "netmesh/eigen.hpp needs exceptions"
#endif

namespace netmesh {
namespace eigen {

template <typename Number>
using rows = Eigen::Matrix<Number, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
template <typename Number>
using columns = Eigen::Matrix<Number, Eigen::Dynamic, Eigen::Dynamic, Eigen::ColMajor>;

namespace detail {

template <typename Derived>
constexpr bool in_memory = (Eigen::internal::traits<Derived>::Flags & Eigen::DirectAccessBit) != 0;

// Describes the points of a matrix in memory as they lie there.
template <typename Derived>
strided_points<typename Derived::Scalar> view(const Derived &matrix, bool points_in_rows) {
    const auto row = static_cast<std::ptrdiff_t>(matrix.rowStride());
    const auto column = static_cast<std::ptrdiff_t>(matrix.colStride());
    const auto height = static_cast<std::size_t>(matrix.rows());
    const auto width = static_cast<std::size_t>(matrix.cols());
    if (points_in_rows) {
        return {matrix.data(), height, width, row, column};
    }
    return {matrix.data(), width, height, column, row};
}

template <typename Derived>
mesh mesh_of(const Eigen::DenseBase<Derived> &points, bool points_in_rows) {
    if constexpr (in_memory<Derived>) {
        return make_mesh(view(points.derived(), points_in_rows));
    } else {
        const typename Derived::PlainObject evaluated = points;
        return make_mesh(view(evaluated, points_in_rows));
    }
}

// Gets rows x width elements of the library into a matrix, each row beside the next.
template <typename Matrix, typename Getter>
Matrix fetched(const mesh &mesh, Getter getter, std::size_t more, bool in_rows) {
    const std::size_t width = mesh.dim() + more;
    std::uint64_t needed = 0;
    netmesh::detail::outcome(getter(mesh.get(), nullptr, 0, &needed)).value();
    const auto height = static_cast<Eigen::Index>(needed / width);
    const auto across = static_cast<Eigen::Index>(width);
    Matrix matrix(in_rows ? height : across, in_rows ? across : height);
    if (needed != 0) {
        netmesh::detail::outcome(getter(mesh.get(), matrix.data(), needed, nullptr)).value();
    }
    return matrix;
}

template <typename Index>
Index converted(std::uint32_t id) {
    if (std::is_signed_v<Index> && id == NM_NONE) {
        return static_cast<Index>(-1);
    }
    using wide = std::uint64_t;
    if constexpr (std::is_integral_v<Index>) {
        if (wide{id} > static_cast<wide>(std::numeric_limits<Index>::max())) {
            throw error(NM_CAPACITY, "id " + std::to_string(id) + " is more than Index holds");
        }
    }
    return static_cast<Index>(id);
}

template <typename Matrix, typename Ids>
Matrix converted_matrix(const Ids &ids) {
    using Index = typename Matrix::Scalar;
    static_assert(std::is_integral_v<Index> && !std::is_same_v<Index, bool>, "ids are integers");
    if constexpr (std::is_same_v<Index, std::uint32_t>) {
        return ids;
    } else {
        return ids.unaryExpr([](std::uint32_t id) { return converted<Index>(id); });
    }
}

}  // namespace detail

// Makes a mesh of points, one in each row: n x dim.
template <typename Derived>
mesh mesh_of_rows(const Eigen::DenseBase<Derived> &points) {
    return detail::mesh_of(points, true);
}

// Makes a mesh of points, one in each column: dim x n.
template <typename Derived>
mesh mesh_of_columns(const Eigen::DenseBase<Derived> &points) {
    return detail::mesh_of(points, false);
}

// Return the coordinates of the vertices: vertices x dim, and dim x vertices.
inline rows<double> points_in_rows(const mesh &mesh) {
    return detail::fetched<rows<double>>(mesh, nm_mesh_get_points, 0, true);
}
inline columns<double> points_in_columns(const mesh &mesh) {
    return detail::fetched<columns<double>>(mesh, nm_mesh_get_points, 0, false);
}

// Return the vertices of the simplices: simplices x (dim + 1), and (dim + 1) x simplices.
template <typename Index = std::uint32_t>
rows<Index> simplices_in_rows(const mesh &mesh) {
    return detail::converted_matrix<rows<Index>>(
        detail::fetched<rows<std::uint32_t>>(mesh, nm_mesh_get_simplices, 1, true));
}
template <typename Index = std::uint32_t>
columns<Index> simplices_in_columns(const mesh &mesh) {
    return detail::converted_matrix<columns<Index>>(
        detail::fetched<columns<std::uint32_t>>(mesh, nm_mesh_get_simplices, 1, false));
}

// Return the neighbours of the simplices, the i-th opposite vertex i: shaped like the simplices.
template <typename Index = std::uint32_t>
rows<Index> neighbors_in_rows(const mesh &mesh) {
    return detail::converted_matrix<rows<Index>>(
        detail::fetched<rows<std::uint32_t>>(mesh, nm_mesh_get_neighbors, 1, true));
}
template <typename Index = std::uint32_t>
columns<Index> neighbors_in_columns(const mesh &mesh) {
    return detail::converted_matrix<columns<Index>>(
        detail::fetched<columns<std::uint32_t>>(mesh, nm_mesh_get_neighbors, 1, false));
}

}  // namespace eigen
}  // namespace netmesh

#endif  // NETMESH_EIGEN_HPP
