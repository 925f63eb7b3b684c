// netmesh/strided.hpp, and the spans of netmesh.hpp beside those of the standard library.
#include <netmesh/strided.hpp>

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <utility>
#include <vector>
#if defined(__cpp_lib_span)
#include <algorithm>
#include <ranges>
#include <span>
#endif

#include "check.hpp"
#include "expect_error.hpp"
#include "point_sets.hpp"

namespace {

using netmesh::make_mesh;
using netmesh::strided;
using netmesh::strided_points;

template <class Number>
strided_points<Number> view(const std::vector<Number>& numbers, std::size_t count, std::size_t dim,
                            std::ptrdiff_t point_stride, std::ptrdiff_t coordinate_stride) {
    return {numbers.data(), count, dim, point_stride, coordinate_stride};
}

// The vertices of a mesh of points are the points, bit for bit: there are no duplicates here.
void check_points(const netmesh::mesh& mesh, const PointSet& expected, int line) {
    const auto points = mesh.points();
    check::that(points.size() == expected.size() && points.width() == expected.dim, __FILE__, line, "shape");
    check::that(points.flat() == expected.coordinates, __FILE__, line, "coordinates");
}

void layouts(unsigned dim) {
    const PointSet set = ulp_pairs(dim, 40);
    const std::size_t n = set.size();
    const auto step = static_cast<std::ptrdiff_t>(dim);
    const auto all = static_cast<std::ptrdiff_t>(n);
    const auto dense = view(set.coordinates, n, dim, step, 1);
    CHECK(dense.direct());
    check_points(make_mesh(dense), set, __LINE__);

    // With gaps, which hold what must not be read.
    std::vector<double> gaps(n * (dim + 3), std::nan(""));
    // Points by coordinate; and backwards.
    std::vector<double> by_coordinate(n * dim), backwards(n * dim);
    for (std::size_t i = 0; i < n; ++i) {
        for (std::size_t k = 0; k < dim; ++k) {
            gaps[i * (dim + 3) + k] = set.point(i)[k];
            by_coordinate[k * n + i] = set.point(i)[k];
            backwards[n * dim - 1 - (i * dim + k)] = set.point(i)[k];
        }
    }
    const auto with_gaps = view(gaps, n, dim, step + 3, 1);
    CHECK(with_gaps.direct());
    check_points(make_mesh(with_gaps), set, __LINE__);
    const auto columns = view(by_coordinate, n, dim, 1, all);
    CHECK(!columns.direct());
    check_points(make_mesh(columns), set, __LINE__);
    // Every other number.
    std::vector<double> spaced(2 * n * dim, std::nan(""));
    for (std::size_t x = 0; x < n * dim; ++x) spaced[2 * x] = set.coordinates[x];
    const auto with_spaces = view(spaced, n, dim, 2 * step, 2);
    CHECK(!with_spaces.direct());
    check_points(make_mesh(with_spaces), set, __LINE__);
    const strided_points<double> reversed{&backwards.back(), n, dim, -step, -1};
    CHECK(!reversed.direct());
    check_points(make_mesh(reversed), set, __LINE__);
    // A stride of zero repeats a point, overlapping points are points too.
    CHECK(!view(set.coordinates, n, dim, 0, 1).direct() && !view(set.coordinates, n, dim, 1, 1).direct());
    expect_error(__LINE__, NM_DEGENERATE_INPUT, "distinct", [&] { make_mesh(view(set.coordinates, n, dim, 0, 1)); });
    CHECK_EQUAL(make_mesh(view(set.coordinates, n, dim, 1, 1)).counts().inputs, n);
}

template <class Number>
void exact_numbers(Number smallest, Number largest) {
    const std::vector<Number> numbers{0, 0, 1, 0, 0, 1, smallest, largest};
    const auto points = make_mesh(view(numbers, 4, 2, 2, 1)).points();
    for (std::size_t i = 0; i < numbers.size(); ++i) {
        CHECK(static_cast<Number>(points.data()[i]) == numbers[i]);
        CHECK(points.data()[i] == static_cast<double>(numbers[i]));
    }
}

void number_types() {
    exact_numbers<float>(std::numeric_limits<float>::denorm_min(), std::numeric_limits<float>::max());
    exact_numbers<float>(-0.1f, 16777217.0f);
    exact_numbers<std::int32_t>(INT32_MIN, INT32_MAX);
    exact_numbers<std::uint32_t>(7, UINT32_MAX);
    exact_numbers<std::int8_t>(-128, 127);
    exact_numbers<unsigned short>(9, 65535);
    std::vector<float> broken{0, 0, 1, 0, 0, std::numeric_limits<float>::quiet_NaN()};
    expect_error(__LINE__, NM_NON_FINITE, "2", [&] { make_mesh(view(broken, 3, 2, 2, 1)); });
}

struct Particle {
    double mass;
    double position[3];
};

void structs_and_arrays() {
    const PointSet set = generate("gaussian", 3, 50);
    std::vector<std::array<double, 3>> arrays(set.size());
    std::vector<std::array<float, 3>> floats(set.size());
    std::vector<Particle> particles(set.size());
    PointSet rounded = set;
    double raw[50][3];
    for (std::size_t i = 0; i < set.size(); ++i) {
        for (std::size_t k = 0; k < 3; ++k) {
            const double x = set.point(i)[k];
            arrays[i][k] = particles[i].position[k] = raw[i][k] = x;
            floats[i][k] = static_cast<float>(x);
            rounded.coordinates[3 * i + k] = static_cast<double>(floats[i][k]);
        }
    }
    CHECK(strided(arrays).direct() && strided(raw).direct() && !strided(floats).direct());
    check_points(make_mesh(strided(arrays)), set, __LINE__);
    check_points(make_mesh(strided(raw)), set, __LINE__);
    check_points(make_mesh(strided(netmesh::span<const std::array<double, 3>>(arrays))), set, __LINE__);
    check_points(make_mesh(strided(floats)), rounded, __LINE__);
    const strided_points<double> positions{&particles[0].position[0], particles.size(), 3,
                                           sizeof(Particle) / sizeof(double), 1};
    CHECK(positions.direct());
    check_points(make_mesh(positions), set, __LINE__);
    const std::vector<std::array<double, 3>> none;
    expect_error(__LINE__, NM_DEGENERATE_INPUT, "two", [&] { make_mesh(strided(none)); });
}

// The interface of std::mdspan, in a language that has none yet.
template <class Number>
struct View {
    using element_type = Number;
    Number* data;
    std::array<std::size_t, 2> extents, strides;

    static constexpr std::size_t rank() { return 2; }
    Number* data_handle() const { return data; }
    std::size_t extent(std::size_t k) const { return extents[k]; }
    std::size_t stride(std::size_t k) const { return strides[k]; }
};

void mdspans() {
    const PointSet set = generate("uniform", 2, 30);
    std::vector<double> left(60);
    for (std::size_t i = 0; i < 30; ++i) {
        for (std::size_t k = 0; k < 2; ++k) left[k * 30 + i] = set.point(i)[k];
    }
    const View<const double> layout_right{set.coordinates.data(), {30, 2}, {2, 1}};
    const View<double> layout_left{left.data(), {30, 2}, {1, 30}};
    CHECK(netmesh::strided_mdspan(layout_right).direct() && !netmesh::strided_mdspan(layout_left).direct());
    check_points(make_mesh(netmesh::strided_mdspan(layout_right)), set, __LINE__);
    check_points(make_mesh(netmesh::strided_mdspan(layout_left)), set, __LINE__);
}

void errors() {
    const std::vector<double> numbers(100, 1.0);
    const std::vector<float> floats(100, 1.0f);
    expect_error(__LINE__, NM_DIMENSION, "9", [&] { make_mesh(view(numbers, 3, 9, 9, 1)); });
    expect_error(__LINE__, NM_DIMENSION, "1", [&] { make_mesh(view(numbers, 3, 1, 1, 1)); });
    expect_error(__LINE__, NM_DIMENSION, "9", [&] { make_mesh(view(floats, 3, 9, 9, 1)); });
    expect_error(__LINE__, NM_CAPACITY, "4294967295", [&] { make_mesh(view(floats, 0xFFFFFFFFu, 3, 0, 0)); });
    expect_error(__LINE__, NM_CAPACITY, "n", [&] { make_mesh(view(floats, SIZE_MAX, 8, 0, 0)); });
    expect_error(__LINE__, NM_NULL_ARGUMENT, "points",
                 [&] { make_mesh(strided_points<double>{nullptr, 4, 2, 2, 1}); });
    expect_error(__LINE__, NM_NULL_ARGUMENT, "points.data",
                 [&] { make_mesh(strided_points<float>{nullptr, 4, 2, 2, 1}); });
    const auto answer = netmesh::try_make_mesh(view(floats, 3, 2, 2, 1));
    CHECK(!answer && answer.status() == NM_DEGENERATE_INPUT);
}

#if defined(__cpp_lib_span)
static_assert(std::random_access_iterator<netmesh::table<double>::iterator>);
static_assert(std::ranges::random_access_range<const netmesh::table<double>>);
static_assert(std::ranges::contiguous_range<netmesh::span<double>> && std::ranges::view<netmesh::span<int>>);
static_assert(std::ranges::borrowed_range<netmesh::span<const double>>);

void standard_spans() {
    const PointSet set = generate("uniform", 3, 60);
    const std::span<const double> standard(set.coordinates);
    netmesh::mesh mesh(3, standard);
    check_points(mesh, set, __LINE__);
    mesh.run();
    const auto points = mesh.points();
    const std::span<const double> row = points[7];
    CHECK(row.size() == 3 && std::ranges::equal(row, standard.subspan(21, 3)));
    const auto simplices = mesh.simplices();
    const auto with_vertex_0 =
        std::ranges::count_if(simplices, [](std::span<const std::uint32_t> vertices) {
            return std::ranges::find(vertices, 0u) != vertices.end();
        });
    CHECK_EQUAL(static_cast<std::ptrdiff_t>(std::ranges::count(simplices.flat(), 0u)), with_vertex_0);
    const netmesh::options options{.output = NM_OUTPUT_WELL_SPACED, .seed = 3};
    mesh.run(options);
    CHECK_EQUAL(mesh.counts().domains, 1u);
}
#else
void standard_spans() {}
#endif

}  // namespace

int main() {
    for (const unsigned dim : {2u, 3u, 5u}) layouts(dim);
    number_types();
    structs_and_arrays();
    mdspans();
    errors();
    standard_spans();
    return check::result("strided_adapter");
}
