// Ways to rid a mesh of slivers: netmesh's min_dihedral beside TetGen's optimisation and its bound on
// dihedral angles (the number after the slash of -q). The same points, the same radius-edge bound 2.
// Each run is in a child of its own, as in tetgen_ratio.cpp.
//
//   cmake --build <build> --target tetgen_slivers, then <build>/bench/
//   tetgen_slivers <n> <degrees> <turns> <uniform | gaussian | clusters | sphere | grid | ...>
//
// A row: vertices an input; tetrahedra below the angle and the least angle, those at the hull
// included; facets whose opposite vertex is inside a circumball by more than a part of 1e-9 of its
// squared radius, of all inner facets; seconds (the median of the turns), as in tetgen_ratio.cpp.
#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "clusters.hpp"
#include "in_child.hpp"
#include "netmesh.h"
#include "ratio.hpp"
#include "tetgen_box.hpp"

namespace {

constexpr unsigned most_seconds = 300;  // of one turn of either
constexpr double bound = 2.0;
constexpr double pi = 3.14159265358979323846;

using Vector = std::array<double, 3>;

struct Row {
    double seconds, least_angle;
    std::uint64_t vertices, below, tetrahedra, not_delaunay, facets;
};

Vector minus(const Vector& a, const Vector& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
double dot(const Vector& a, const Vector& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
Vector cross(const Vector& a, const Vector& b) {
    return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

struct Mesh {
    std::vector<double> points;
    std::vector<std::uint32_t> tetrahedra;

    Vector point(std::uint32_t vertex) const {
        return {points[3 * vertex], points[3 * vertex + 1], points[3 * vertex + 2]};
    }
};

// The least dihedral angle in degrees, by the heights over each edge.
double least_dihedral(const Mesh& mesh, const std::uint32_t* corners) {
    double least = 180.0;
    for (int i = 0; i < 4; ++i) {
        for (int j = 0; j < i; ++j) {
            const Vector origin = mesh.point(corners[i]);
            const Vector edge = minus(mesh.point(corners[j]), origin);
            std::array<Vector, 2> heights;
            int count = 0;
            for (int k = 0; k < 4; ++k) {
                if (k == i || k == j) continue;
                const Vector to = minus(mesh.point(corners[k]), origin);
                const double along = dot(to, edge) / dot(edge, edge);
                heights[count++] = {to[0] - along * edge[0], to[1] - along * edge[1], to[2] - along * edge[2]};
            }
            const Vector normal = cross(heights[0], heights[1]);
            least = std::min(least, std::atan2(std::sqrt(dot(normal, normal)), dot(heights[0], heights[1])) * 180.0 / pi);
        }
    }
    return least;
}

// Returns the depth of `x` in the circumball, relative to the squared radius; below 0 outside.
double depth(const Mesh& mesh, const std::uint32_t* corners, std::uint32_t x) {
    const Vector origin = mesh.point(corners[0]);
    const Vector a = minus(mesh.point(corners[1]), origin), b = minus(mesh.point(corners[2]), origin),
                 c = minus(mesh.point(corners[3]), origin);
    const Vector bc = cross(b, c), ca = cross(c, a), ab = cross(a, b);
    const double volume = 2.0 * dot(a, bc);
    Vector center;
    for (int k = 0; k < 3; ++k) center[k] = (dot(a, a) * bc[k] + dot(b, b) * ca[k] + dot(c, c) * ab[k]) / volume;
    const Vector to = minus(minus(mesh.point(x), origin), center);
    return 1.0 - dot(to, to) / dot(center, center);
}

void measure(const Mesh& mesh, double degrees, Row& row) {
    row.vertices = mesh.points.size() / 3;
    row.tetrahedra = mesh.tetrahedra.size() / 4;
    row.least_angle = 180.0;
    row.below = row.not_delaunay = row.facets = 0;
    std::map<std::array<std::uint32_t, 3>, std::pair<std::uint32_t, std::uint32_t>> open;
    for (std::uint32_t t = 0; t < row.tetrahedra; ++t) {
        const std::uint32_t* corners = &mesh.tetrahedra[4 * t];
        const double least = least_dihedral(mesh, corners);
        row.least_angle = std::min(row.least_angle, least);
        row.below += least < degrees;
        for (int i = 0; i < 4; ++i) {
            std::array<std::uint32_t, 3> facet{corners[(i + 1) % 4], corners[(i + 2) % 4], corners[(i + 3) % 4]};
            std::sort(facet.begin(), facet.end());
            const auto [other, is_new] = open.try_emplace(facet, t, corners[i]);
            if (is_new) continue;
            const std::uint32_t* beyond = &mesh.tetrahedra[4 * other->second.first];
            const double in_own = depth(mesh, corners, other->second.second);
            const double in_other = depth(mesh, beyond, corners[i]);
            row.not_delaunay += std::max(in_own, in_other) > 1e-9;
            ++row.facets;
            open.erase(other);
        }
    }
}

int run_netmesh(const PointSet& input, double asked, double degrees, Row& row) {
    const auto start = std::chrono::steady_clock::now();
    nm_mesh* mesh = nullptr;
    require(nm_mesh_create(3, input.size(), input.coordinates.data(), 0, &mesh), "nm_mesh_create");
    nm_options options;
    require(nm_options_init(&options, sizeof options), "nm_options_init");
    options.output = NM_OUTPUT_WELL_SPACED;
    options.criterion = NM_CRITERION_RADIUS_EDGE;
    options.quality_bound = bound;
    options.min_dihedral = asked;
    require(nm_run(mesh, &options), "nm_run");
    const Mesh made{get<double>(mesh, nm_mesh_get_points, "nm_mesh_get_points"),
                    get<std::uint32_t>(mesh, nm_mesh_get_simplices, "nm_mesh_get_simplices")};
    nm_mesh_free(mesh);
    row.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    measure(made, degrees, row);
    return made.tetrahedra.empty() ? 1 : 0;
}

int run_tetgen(const PointSet& input, const std::string& switches, double degrees, Row& row) {
    TetgenResult result = tetgen_in_box(input, switches);
    row.seconds = result.seconds;
    if (result.error != 0) return 1;
    measure(Mesh{std::move(result.points), std::move(result.tetrahedra)}, degrees, row);
    return 0;
}

// The row of the turn with the median time.
void repeat(const char* name, std::size_t n, int turns, const std::function<int(Row&)>& work) {
    static Row& row = shared<Row>();
    std::vector<double> seconds;
    for (int turn = 0; turn < turns; ++turn) {
        const std::string trouble = in_child(most_seconds, [&] { return work(row); });
        if (!trouble.empty()) {
            std::printf("%-28s %s\n", name, trouble.c_str());
            return;
        }
        seconds.push_back(row.seconds);
    }
    std::printf("%-28s %8.3f %8zu %8.3f %8zu of %8zu %9.3f\n", name,
                static_cast<double>(row.vertices) / static_cast<double>(n), static_cast<std::size_t>(row.below),
                row.least_angle, static_cast<std::size_t>(row.not_delaunay), static_cast<std::size_t>(row.facets),
                median(seconds));
    std::fflush(stdout);
}

}  // namespace

int main(int count, char** arguments) {
    const long n = count > 1 ? std::atol(arguments[1]) : 0;
    const double degrees = count > 2 ? std::atof(arguments[2]) : 0.0;
    const int turns = count > 3 ? std::atoi(arguments[3]) : 0;
    if (count != 5 || n < 4 || !(degrees > 0.0) || turns < 1) {
        std::fprintf(stderr, "usage: tetgen_slivers <n> <degrees> <turns> <distribution>\n");
        return 2;
    }
    const PointSet input = ratio_input(arguments[4], 3, static_cast<std::size_t>(n));
    const std::size_t size = input.size();
    std::printf("%s %zu, %g degrees\n%-28s %8s %8s %8s %20s %9s\n", arguments[4], size, degrees, "", "m/n", "below",
                "least", "facets not Delaunay", "seconds");
    repeat("netmesh", size, turns, [&](Row& row) { return run_netmesh(input, 0.0, degrees, row); });
    repeat("netmesh, min_dihedral", size, turns, [&](Row& row) { return run_netmesh(input, degrees, degrees, row); });
    const std::string ratio = std::to_string(bound), angle = std::to_string(degrees);
    const std::vector<std::pair<const char*, std::string>> variants = {
        {"TetGen, not optimised", "pq" + ratio + "/0O0/0Q"},
        {"TetGen, optimised", "pq" + ratio + "/0Q"},
        {"TetGen, the angle", "pq" + ratio + "/" + angle + "O0/0Q"},

    };
    for (const auto& [name, switches] : variants) {
        const std::string& chosen = switches;
        repeat(name, size, turns, [&](Row& row) { return run_tetgen(input, chosen, degrees, row); });
    }
    return 0;
}
