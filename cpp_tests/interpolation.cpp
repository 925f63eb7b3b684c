// Nearest vertices and interpolation through the C interface, each answer by brute force, and Sibson's
// weights by CGAL where that is there.

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include "check.hpp"
#include "mesh.hpp"
#include "plane.hpp"
#include "random.hpp"

#ifdef NETMESH_WITH_CGAL
#include <CGAL/Delaunay_triangulation_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/natural_neighbor_coordinates_2.h>

#include <iterator>
#include <map>
#include <utility>
#endif

namespace {

MeshHandle meshed(const PointSet& points) {
    MeshHandle mesh = create(points);
    REQUIRE_OK(nm_run(mesh.get(), nullptr));
    return mesh;
}

// Points in the box of the unit cube, a little more if `reach` says so.
std::vector<double> questions(unsigned dim, std::size_t count, double reach) {
    Random random(7);
    std::vector<double> points(count * dim);
    for (double& x : points) {
        x = 0.5 + (random.unit() - 0.5) * reach;
    }
    return points;
}

long double square(const double* a, const double* b, unsigned dim) {
    long double sum = 0;
    for (unsigned axis = 0; axis < dim; ++axis) {
        const long double step = static_cast<long double>(a[axis]) - b[axis];
        sum += step * step;
    }
    return sum;
}

// Each vertex and distance against all vertices of the first `count`; ties go to the least.
template <class Query>
void nearest_is_nearest(const ExportedMesh& mesh, std::size_t count, const std::vector<double>& points,
                        Query query) {
    const std::size_t asked = points.size() / mesh.dim;
    std::vector<std::uint32_t> vertices(asked);
    std::vector<double> distances(asked);
    REQUIRE_OK(query(asked, points.data(), vertices.data(), distances.data()));
    for (std::size_t i = 0; i < asked; ++i) {
        std::uint32_t best = 0;
        for (std::uint32_t vertex = 1; vertex < count; ++vertex) {
            const double* x = points.data() + i * mesh.dim;
            if (square(mesh.point(vertex), x, mesh.dim) < square(mesh.point(best), x, mesh.dim)) {
                best = vertex;
            }
        }
        CHECK_EQUAL(vertices[i], best);
        const auto distance =
            std::sqrt(square(mesh.point(best), points.data() + i * mesh.dim, mesh.dim));
        const long double most = std::ldexp(mesh.dim + 4.5L, -53) * distance;
        CHECK(std::abs(distances[i] - distance) <= most);
    }
}

void nearest_vertices(const PointSet& points, const std::vector<double>& asked) {
    const MeshHandle mesh = meshed(points);
    const ExportedMesh exported = export_mesh(mesh.get());
    REQUIRE(exported.vertex_count() > points.size());
    nearest_is_nearest(exported, exported.vertex_count(), asked,
                       [&](std::size_t count, const double* x, std::uint32_t* ids, double* distances) {
                           return nm_mesh_nearest(mesh.get(), count, x, 2, ids, distances);
                       });
    nearest_is_nearest(exported, points.size(), asked,
                       [&](std::size_t count, const double* x, std::uint32_t* ids, double* distances) {
                           return nm_mesh_nearest_input(mesh.get(), count, x, 1, ids, distances);
                       });
}

// A lattice whose nodes are asked for from the middles of its cells, where four are equally near.
void nearest_of_a_lattice() {
    PointSet lattice;
    lattice.dim = 2;
    std::vector<double> middles;
    for (int i = 0; i < 7; ++i) {
        for (int j = 6; j >= 0; --j) {
            lattice.coordinates.insert(lattice.coordinates.end(), {1.0 * j, 1.0 * i});
            middles.insert(middles.end(), {j + 0.5, i - 0.5});
        }
    }
    nearest_vertices(lattice, middles);
}

double wave(double x, double y) { return std::sin(3 * x) + y * y; }

// The values of two functions at all vertices, the second linear.
std::vector<double> waves(const ExportedMesh& mesh) {
    std::vector<double> values;
    for (std::uint32_t vertex = 0; vertex < mesh.vertex_count(); ++vertex) {
        const double *x = mesh.point(vertex);
        values.insert(values.end(), {wave(x[0], x[1]), 1 + 2 * x[0] - x[1]});
    }
    return values;
}

std::vector<double> interpolated(const nm_mesh* mesh, nm_interpolation method,
                                 const std::vector<double>& values, const std::vector<double>& points) {
    std::vector<double> out(points.size());
    REQUIRE_OK(nm_mesh_interpolate(mesh, method, 2, values.data(), points.size() / 2, points.data(), 2,
                                   out.data()));
    return out;
}

// Weights of vertices, which need not add up to one.
using Weights = std::vector<long double>;

long double mean(const Weights& weights, const std::vector<double>& values, std::size_t component) {
    long double sum = 0, all = 0;
    for (std::size_t vertex = 0; vertex < weights.size(); ++vertex) {
        sum += weights[vertex] * values[2 * vertex + component];
        all += weights[vertex];
    }
    return sum / all;
}

// The triangle that holds x gives barycentric weights.
Weights linear_weights(const ExportedMesh& mesh, const std::vector<Point2>& vertices, const Point2& x) {
    for (std::size_t s = 0; s < mesh.simplex_count(); ++s) {
        const std::uint32_t* ids = mesh.simplex(s);
        const Point2 &a = vertices[ids[0]], &b = vertices[ids[1]], &c = vertices[ids[2]];
        const long double shares[] = {turn(x, b, c), turn(a, x, c), turn(a, b, x)};
        if (*std::min_element(shares, shares + 3) >= 0) {
            Weights weights(vertices.size());
            for (int i = 0; i < 3; ++i) {
                weights[ids[i]] = shares[i];
            }
            return weights;
        }
    }
    REQUIRE(!"a triangle holds the point");
    return {};
}

// Sibson's weights: the volumes that a cell of x would take from the cell of each vertex.
Weights sibson_weights(const std::vector<Point2>& vertices, const Point2& x) {
    const Polygon2 cell = cell_among(x, vertices, 1000);
    Weights weights;
    for (const Point2& vertex : vertices) {
        Polygon2 part = cell;
        for (const Point2& other : vertices) {
            if (&other != &vertex && !part.empty()) {
                part = nearer(part, vertex, other);
            }
        }
        weights.push_back(area(part));
    }
    return weights;
}

// The length of the border of the cell of x towards each vertex, over the distance: Laplace's weights.
Weights laplace_weights(const std::vector<Point2>& vertices, const Point2& x) {
    Weights weights;
    for (const Point2& vertex : vertices) {
        const Point2 middle{(x.x + vertex.x) / 2, (x.y + vertex.y) / 2};
        const Point2 step{middle.x - (vertex.y - x.y), middle.y + (vertex.x - x.x)};
        long double from = -1e6L, to = 1e6L;
        for (const Point2& other : vertices) {
            // Linear along the border: `at` in the middle, `slope` more at each step.
            const long double at = advantage(middle, x, other), slope = advantage(step, x, other) - at;
            if (&other != &vertex && slope != 0) {
                (slope < 0 ? to : from) = slope < 0 ? std::min(to, -at / slope) : std::max(from, -at / slope);
            }
        }
        // A step is as long as the distance.
        weights.push_back(std::max(to - from, 0.0L));
    }
    return weights;
}

void methods_have_their_weights() {
    const PointSet points = generate("uniform", 2, 40);
    const MeshHandle mesh = meshed(points);
    const ExportedMesh exported = export_mesh(mesh.get());
    const std::vector<Point2> vertices = points_of(exported.points);
    const std::vector<double> values = waves(exported), asked = questions(2, 60, 1.5);
    const auto linear = interpolated(mesh.get(), NM_INTERPOLATION_LINEAR, values, asked);
    const auto sibson = interpolated(mesh.get(), NM_INTERPOLATION_SIBSON, values, asked);
    const auto laplace = interpolated(mesh.get(), NM_INTERPOLATION_LAPLACE, values, asked);
    const std::vector<Point2> places = points_of(asked);
    for (std::size_t i = 0; i < places.size(); ++i) {
        const Weights expected[] = {linear_weights(exported, vertices, places[i]),
                                    sibson_weights(vertices, places[i]), laplace_weights(vertices, places[i])};
        for (std::size_t component = 0; component < 2; ++component) {
            const std::size_t at = 2 * i + component;
            const double found[] = {linear[at], sibson[at], laplace[at]};
            for (int method = 0; method < 3; ++method) {
                check::context = "method " + std::to_string(method) + ", point " + std::to_string(i);
                CHECK_AT_MOST(std::abs(found[method] - mean(expected[method], values, component)), 1e-9L);
            }
        }
    }
    check::context.clear();
}

void beyond_the_hull_is_nothing_or_the_nearest() {
    const PointSet points = generate("uniform", 2, 40);
    const MeshHandle mesh = meshed(points);
    const ExportedMesh exported = export_mesh(mesh.get());
    const std::vector<double> values = waves(exported), far{90, 3, -70, -80, 0.5, 1e6};
    for (const nm_interpolation method :
         {NM_INTERPOLATION_LINEAR, NM_INTERPOLATION_SIBSON, NM_INTERPOLATION_LAPLACE}) {
        for (const double x : interpolated(mesh.get(), method, values, far)) {
            CHECK(std::isnan(x));
        }
    }
    const std::vector<Point2> vertices = points_of(exported.points), places = points_of(far);
    for (const nm_interpolation method : {NM_INTERPOLATION_LINEAR_OR_NEAREST, NM_INTERPOLATION_SIBSON_OR_NEAREST,
                                          NM_INTERPOLATION_LAPLACE_OR_NEAREST}) {
        const auto found = interpolated(mesh.get(), method, values, far);
        for (std::size_t i = 0; i < places.size(); ++i) {
            const std::uint32_t vertex = nearest_of(vertices, vertices.size(), places[i]);
            CHECK_EQUAL(found[2 * i], values[2 * vertex]);
            CHECK_EQUAL(found[2 * i + 1], values[2 * vertex + 1]);
        }
    }
    double out = 0;
    CHECK_STATUS(nm_mesh_interpolate(mesh.get(), NM_INTERPOLATION_LINEAR, 0, values.data(), 1, far.data(), 1, &out),
                 NM_INVALID_ARGUMENT);
    CHECK_STATUS(nm_mesh_interpolate(mesh.get(), NM_INTERPOLATION_LINEAR, 1, nullptr, 1, far.data(), 1, &out),
                 NM_NULL_ARGUMENT);
    CHECK(out == 0);
}

// Linear in the triangles of the inputs that all triples give; the nearest input's beyond them.
void values_extend_to_all_vertices() {
    const PointSet points = generate("uniform", 2, 30);
    const MeshHandle mesh = meshed(points);
    const ExportedMesh exported = export_mesh(mesh.get());
    std::vector<double> given;
    for (std::size_t i = 0; i < points.size(); ++i) {
        given.push_back(wave(points.point(i)[0], points.point(i)[1]));
    }
    std::vector<double> found(exported.vertex_count());
    REQUIRE_OK(nm_mesh_extend_values(mesh.get(), 1, given.data(), found.data()));
    const std::vector<Point2> vertices = points_of(exported.points), inputs = points_of(points.coordinates);
    const auto triangles = empty_triples(inputs);
    CHECK(triangles.size() > points.size());
    std::size_t within = 0;
    for (std::uint32_t vertex = 0; vertex < vertices.size(); ++vertex) {
        const Point2& x = vertices[vertex];
        long double expected = given[nearest_of(inputs, inputs.size(), x)];
        for (const auto& ids : triangles) {
            const Point2 &a = inputs[ids[0]], &b = inputs[ids[1]], &c = inputs[ids[2]];
            const long double shares[] = {turn(x, b, c), turn(a, x, c), turn(a, b, x)};
            if (vertex >= points.size() && *std::min_element(shares, shares + 3) >= 0) {
                expected = (shares[0] * given[ids[0]] + shares[1] * given[ids[1]] + shares[2] * given[ids[2]])
                           / turn(a, b, c);
                ++within;
            }
        }
        CHECK_AT_MOST(std::abs(found[vertex] - expected), vertex < points.size() ? 0 : 1e-9L);
    }
    CHECK(within > 0 && within < vertices.size() - points.size());
    CHECK_STATUS(nm_mesh_extend_values(mesh.get(), 1, nullptr, found.data()), NM_NULL_ARGUMENT);
}

#ifdef NETMESH_WITH_CGAL

void sibsons_weights_are_cgals() {
    using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
    using Delaunay = CGAL::Delaunay_triangulation_2<Kernel>;
    const MeshHandle mesh = meshed(generate("gaussian", 2, 500));
    const ExportedMesh exported = export_mesh(mesh.get());
    std::map<Kernel::Point_2, double> of_points;
    const std::vector<double> values = waves(exported), asked = questions(2, 400, 4);
    for (std::uint32_t vertex = 0; vertex < exported.vertex_count(); ++vertex) {
        of_points[{exported.point(vertex)[0], exported.point(vertex)[1]}] = values[2 * vertex];
    }
    Delaunay triangulation;
    for (const auto& one : of_points) {
        triangulation.insert(one.first);
    }
    const auto found = interpolated(mesh.get(), NM_INTERPOLATION_SIBSON, values, asked);
    for (std::size_t i = 0; i < asked.size(); i += 2) {
        std::vector<std::pair<Kernel::Point_2, double>> weights;
        const auto norm = CGAL::natural_neighbor_coordinates_2(
            triangulation, Kernel::Point_2(asked[i], asked[i + 1]), std::back_inserter(weights));
        REQUIRE(norm.third);
        double sum = 0;
        for (const auto& weight : weights) {
            sum += weight.second / norm.second * of_points.at(weight.first);
        }
        CHECK_AT_MOST(std::abs(found[i] - sum), 1e-7);
    }
}

#endif

}  // namespace

int main() {
    for (const unsigned dim : {2u, 3u, 5u}) {
        nearest_vertices(generate("uniform", dim, dim == 5 ? 10 : 60), questions(dim, 200, 3));
    }
    nearest_of_a_lattice();
    methods_have_their_weights();
    beyond_the_hull_is_nothing_or_the_nearest();
    values_extend_to_all_vertices();
#ifdef NETMESH_WITH_CGAL
    sibsons_weights_are_cgals();
#endif
    return check::result("interpolation");
}
