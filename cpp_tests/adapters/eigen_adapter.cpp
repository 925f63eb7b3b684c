// netmesh/eigen.hpp against Eigen: every storage order and stride, in and out.
#include <netmesh/eigen.hpp>

#include <Eigen/Core>

#include <cstdint>
#include <limits>
#include <string>
#include <type_traits>
#include <vector>

#include "check.hpp"
#include "expect_error.hpp"
#include "point_sets.hpp"

namespace {

namespace adapter = netmesh::eigen;
using Eigen::Dynamic;
template <class Number, int Order>
using Matrix = Eigen::Matrix<Number, Dynamic, Dynamic, Order>;
using Rows = Matrix<double, Eigen::RowMajor>;
using Columns = Eigen::MatrixXd;

Rows rows_of(const PointSet& set) {
    Rows rows(static_cast<Eigen::Index>(set.size()), static_cast<Eigen::Index>(set.dim));
    for (std::size_t i = 0; i < set.size(); ++i) {
        for (std::size_t k = 0; k < set.dim; ++k) {
            rows(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(k)) = set.point(i)[k];
        }
    }
    return rows;
}

template <class Expression>
bool reads_rows_directly(const Expression& points) {
    return adapter::detail::view(points, true).direct();
}

template <class Expression>
bool reads_columns_directly(const Expression& points) {
    return adapter::detail::view(points, false).direct();
}

void check_points(const netmesh::mesh& mesh, const PointSet& set, int line) {
    check::that(mesh.dim() == set.dim, __FILE__, line, "dimension");
    check::that(mesh.counts().inputs == set.size(), __FILE__, line, "inputs");
    const auto vertices = mesh.input_vertices();
    const auto points = mesh.points();
    bool equal = vertices.size() == set.size();
    for (std::size_t i = 0; equal && i < set.size(); ++i) {
        for (std::size_t k = 0; k < set.dim; ++k) equal &= points[vertices[i]][k] == set.point(i)[k];
    }
    check::that(equal, __FILE__, line, "coordinates");
}

// Takes its arguments in the way of a library with Eigen::Ref.
netmesh::mesh through_ref(const Eigen::Ref<const Rows, 0, Eigen::OuterStride<>>& rows, bool& direct) {
    direct = reads_rows_directly(rows);
    return adapter::mesh_of_rows(rows);
}

void every_layout(const PointSet& set) {
    const Rows rows = rows_of(set);
    const Columns row_by_columns = rows;            // n x dim, column-major
    const Columns columns = rows.transpose();       // dim x n, column-major
    const Rows columns_by_rows = rows.transpose();  // dim x n, row-major
    CHECK(reads_rows_directly(rows) && reads_columns_directly(columns));
    CHECK(!reads_rows_directly(row_by_columns) && !reads_columns_directly(columns_by_rows));
    check_points(adapter::mesh_of_rows(rows), set, __LINE__);
    check_points(adapter::mesh_of_rows(row_by_columns), set, __LINE__);
    check_points(adapter::mesh_of_columns(columns), set, __LINE__);
    check_points(adapter::mesh_of_columns(columns_by_rows), set, __LINE__);
    check_points(adapter::mesh_of_columns(rows.transpose()), set, __LINE__);
    CHECK(reads_columns_directly(rows.transpose()));

    // Outer strides: a block of a wider matrix, whose other elements are no numbers.
    const auto n = rows.rows(), dim = rows.cols();
    Rows wide = Rows::Constant(n, dim + 4, std::numeric_limits<double>::quiet_NaN());
    wide.middleCols(2, dim) = rows;
    CHECK(reads_rows_directly(wide.middleCols(2, dim)));
    check_points(adapter::mesh_of_rows(wide.middleCols(2, dim)), set, __LINE__);
    bool direct = false;
    check_points(through_ref(wide.middleCols(2, dim), direct), set, __LINE__);
    CHECK(direct);
    using Outer = Eigen::Map<const Rows, 0, Eigen::OuterStride<>>;
    const Outer outer(wide.data() + 2, n, dim, Eigen::OuterStride<>(dim + 4));
    CHECK(reads_rows_directly(outer));
    check_points(adapter::mesh_of_rows(outer), set, __LINE__);
    // Every second element: copied.
    Rows spaced = Rows::Constant(n, 2 * dim, std::numeric_limits<double>::quiet_NaN());
    for (Eigen::Index k = 0; k < dim; ++k) spaced.col(2 * k) = rows.col(k);
    using Inner = Eigen::Map<const Rows, 0, Eigen::Stride<Dynamic, Dynamic>>;
    const Inner inner(spaced.data(), n, dim, Eigen::Stride<Dynamic, Dynamic>(2 * dim, 2));
    CHECK(!reads_rows_directly(inner));
    check_points(adapter::mesh_of_rows(inner), set, __LINE__);
    // An expression, which is in no memory, is evaluated.
    check_points(adapter::mesh_of_rows((rows * 0.5) * 2), set, __LINE__);
    check_points(adapter::mesh_of_columns(columns.array() + 0), set, __LINE__);
}

void sizes_and_numbers() {
    const PointSet grid = generate("grid", 3, 27);
    const Rows rows = rows_of(grid);
    const Eigen::Matrix<double, 3, Dynamic> fixed_columns = rows.transpose();
    const Eigen::Matrix<double, 27, 3, Eigen::RowMajor> fixed = rows;
    CHECK(reads_columns_directly(fixed_columns) && reads_rows_directly(fixed));
    check_points(adapter::mesh_of_columns(fixed_columns), grid, __LINE__);
    check_points(adapter::mesh_of_rows(fixed), grid, __LINE__);
    check_points(adapter::mesh_of_rows(Eigen::MatrixXf(rows.cast<float>())), grid, __LINE__);
    check_points(adapter::mesh_of_rows(rows.cast<int>()), grid, __LINE__);
    expect_error(__LINE__, NM_DIMENSION, "27", [&] { adapter::mesh_of_columns(rows); });
    expect_error(__LINE__, NM_DEGENERATE_INPUT, "two", [&] { adapter::mesh_of_rows(Rows(0, 3)); });
    Rows broken = rows;
    broken(5, 1) = std::numeric_limits<double>::infinity();
    expect_error(__LINE__, NM_NON_FINITE, "5", [&] { adapter::mesh_of_rows(broken); });
}

template <class Index>
void check_ids(const netmesh::mesh& mesh) {
    const auto simplices = mesh.simplices(), neighbors = mesh.neighbors();
    const auto in_rows = adapter::simplices_in_rows<Index>(mesh), beside = adapter::neighbors_in_rows<Index>(mesh);
    const auto in_columns = adapter::simplices_in_columns<Index>(mesh);
    CHECK(in_rows == in_columns.transpose());
    CHECK(beside == adapter::neighbors_in_columns<Index>(mesh).transpose());
    REQUIRE(in_rows.rows() == static_cast<Eigen::Index>(simplices.size()) && in_rows.cols() == 4);
    REQUIRE(beside.rows() == in_rows.rows() && beside.cols() == 4);
    for (std::size_t s = 0; s < simplices.size(); ++s) {
        for (std::size_t i = 0; i < 4; ++i) {
            const auto row = static_cast<Eigen::Index>(s), column = static_cast<Eigen::Index>(i);
            CHECK(in_rows(row, column) == static_cast<Index>(simplices[s][i]));
            const bool hull = neighbors[s][i] == NM_NONE;
            const auto none = std::is_signed_v<Index> ? static_cast<Index>(-1) : static_cast<Index>(NM_NONE);
            CHECK(beside(row, column) == (hull ? none : static_cast<Index>(neighbors[s][i])));
        }
    }
}

void out() {
    const PointSet set = generate("uniform", 3, 100);
    netmesh::mesh mesh = adapter::mesh_of_rows(rows_of(set));
    expect_error(__LINE__, NM_STATE, "run", [&] { adapter::simplices_in_rows(mesh); });
    mesh.run();
    const auto points = mesh.points();
    const Rows rows = adapter::points_in_rows(mesh);
    const Columns columns = adapter::points_in_columns(mesh), by_columns = adapter::points_in_rows(mesh);
    REQUIRE(rows.rows() == static_cast<Eigen::Index>(points.size()) && rows.cols() == 3);
    CHECK(columns.cols() == rows.rows() && columns.rows() == 3);
    CHECK(rows == columns.transpose() && rows == by_columns);
    for (std::size_t v = 0; v < points.size(); ++v) {
        for (std::size_t k = 0; k < 3; ++k) {
            CHECK(rows(static_cast<Eigen::Index>(v), static_cast<Eigen::Index>(k)) == points[v][k]);
        }
    }
    check_ids<std::uint32_t>(mesh);
    check_ids<int>(mesh);
    check_ids<std::int64_t>(mesh);
    check_ids<std::uint64_t>(mesh);
    REQUIRE(mesh.counts().vertices > 128);
    expect_error(__LINE__, NM_CAPACITY, "more than Index", [&] { adapter::simplices_in_rows<signed char>(mesh); });
    // Without a sign NM_NONE stays what it is, where it fits.
    expect_error(__LINE__, NM_CAPACITY, "4294967295", [&] { adapter::neighbors_in_rows<unsigned short>(mesh); });
}

}  // namespace

int main() {
    for (const unsigned dim : {2u, 3u}) {
        for (const NamedPoints& input : adapter_inputs(dim)) {
            check::context = input.name;
            every_layout(input.points);
        }
    }
    check::context.clear();
    sizes_and_numbers();
    out();
    return check::result("eigen_adapter");
}
