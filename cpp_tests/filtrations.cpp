// Faces and filtrations through the C interface, each against what the definitions of docs/topology.md
// give by brute force.
//
//   filtrations <directory for its files>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <map>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "alpha_values.hpp"
#include "check.hpp"
#include "fetched.hpp"
#include "mesh.hpp"
#include "plane.hpp"

namespace {

template <class Item, class Getter>
std::vector<Item> of_faces(const nm_mesh* mesh, Getter getter, std::uint32_t k) {
    return fetched<Item>([&](Item* buf, std::uint64_t capacity, std::uint64_t* needed) {
        return getter(mesh, k, buf, capacity, needed);
    });
}

std::vector<double> filtration(const nm_mesh* mesh, nm_filtration which, std::uint32_t k) {
    return fetched<double>([&](double* buf, std::uint64_t capacity, std::uint64_t* needed) {
        return nm_mesh_filtration(mesh, which, k, buf, capacity, needed);
    });
}

double factor(const nm_mesh* mesh, nm_filtration which) {
    double found = 0;
    REQUIRE_OK(nm_mesh_filtration_factor(mesh, which, &found));
    return found;
}

void faces_are_all_faces(const MeshHandle& mesh) {
    const ExportedMesh exported = export_mesh(mesh.get());
    const Faces faces = faces_of(exported);
    for (std::uint32_t k = 0; k <= exported.dim; ++k) {
        std::vector<std::uint32_t> vertices, facets;
        std::vector<std::vector<std::uint32_t>> cofaces(k == 0 ? 0 : faces[k - 1].size());
        for (const auto& [face, number] : faces[k]) {
            vertices.insert(vertices.end(), face.begin(), face.end());
            for (std::size_t i = 0; k > 0 && i < face.size(); ++i) {
                const std::size_t facet = faces[k - 1].at(without(face, i));
                facets.push_back(static_cast<std::uint32_t>(facet));
                cofaces[facet].push_back(static_cast<std::uint32_t>(number));
            }
        }
        CHECK(of_faces<std::uint32_t>(mesh.get(), nm_mesh_get_faces, k) == vertices);
        if (k == 0) {
            continue;
        }
        CHECK(of_faces<std::uint32_t>(mesh.get(), nm_mesh_get_face_facets, k) == facets);
        std::vector<std::uint32_t> lists;
        std::vector<std::uint64_t> starts{0};
        for (const auto& list : cofaces) {
            lists.insert(lists.end(), list.begin(), list.end());
            starts.push_back(lists.size());
        }
        CHECK(of_faces<std::uint32_t>(mesh.get(), nm_mesh_get_cofaces, k - 1) == lists);
        CHECK(of_faces<std::uint64_t>(mesh.get(), nm_mesh_get_coface_starts, k - 1) == starts);
    }
    std::uint64_t needed = 0;
    CHECK_STATUS(nm_mesh_get_faces(mesh.get(), exported.dim + 1, nullptr, 0, &needed), NM_INVALID_ARGUMENT);
    CHECK_STATUS(nm_mesh_get_face_facets(mesh.get(), 0, nullptr, 0, &needed), NM_INVALID_ARGUMENT);
    CHECK_STATUS(nm_mesh_get_cofaces(mesh.get(), exported.dim, nullptr, 0, &needed), NM_INVALID_ARGUMENT);
}

// The roots of the alpha values are what the other filtration has for a mesh of the inputs alone.
void alpha_values_are_their_definition(unsigned dim, std::size_t count) {
    const MeshHandle mesh = delaunay_of(generate("gaussian", dim, count));
    REQUIRE_OK(nm_mesh_make_filtration(mesh.get(), NM_FILTRATION_ALPHA, 2));
    const ExportedMesh exported = export_mesh(mesh.get());
    const auto expected = alpha_values(exported, faces_of(exported));
    for (std::uint32_t k = 0; k <= dim; ++k) {
        const auto alpha = filtration(mesh.get(), NM_FILTRATION_ALPHA, k);
        const auto radii = filtration(mesh.get(), NM_FILTRATION_MESH, k);
        REQUIRE(alpha.size() == expected[k].size() && radii.size() == alpha.size());
        for (std::size_t face = 0; face < alpha.size(); ++face) {
            const long double value = expected[k][face];
            CHECK_AT_MOST(std::abs(alpha[face] - value), 1e-12L * value);
            CHECK_AT_MOST(std::abs(radii[face] - std::sqrt(value)), 1e-12L * std::sqrt(value));
        }
    }
    CHECK_EQUAL(factor(mesh.get(), NM_FILTRATION_ALPHA), 1.0);
    CHECK_EQUAL(factor(mesh.get(), NM_FILTRATION_MESH), 1.0);
}

long double distance(const Point2& a, const Point2& b) { return std::sqrt(square_distance(a, b)); }

long double distance_to_segment(const Point2& x, const Point2& a, const Point2& b) {
    const long double along = (x.x - a.x) * (b.x - a.x) + (x.y - a.y) * (b.y - a.y);
    const long double square = square_distance(a, b);
    const long double share = square == 0 ? 0 : std::clamp(along / square, 0.0L, 1.0L);
    return distance(x, {a.x + share * (b.x - a.x), a.y + share * (b.y - a.y)});
}

// A mesh of the plane with Steiner vertices, and what the definitions say of its cells.
struct Cells {
    ExportedMesh mesh;
    std::size_t inputs;
    std::vector<Point2> vertices, centers;
    std::vector<std::vector<std::size_t>> stars;
    std::vector<bool> is_bounded;
    // The input of a vertex' group, or the number of inputs.
    std::vector<std::size_t> groups;
    std::vector<long double> low, high;

    Cells(const nm_mesh* handle, std::size_t input_count)
        : mesh(export_mesh(handle)), inputs(input_count), vertices(points_of(mesh.points)),
          stars(vertices.size()), is_bounded(vertices.size(), true), groups(vertices.size(), input_count),
          low(vertices.size()), high(vertices.size()) {
        for (std::size_t s = 0; s < mesh.simplex_count(); ++s) {
            const std::uint32_t* ids = mesh.simplex(s);
            centers.push_back(circumcenter(vertices[ids[0]], vertices[ids[1]], vertices[ids[2]]));
            for (int i = 0; i < 3; ++i) {
                stars[ids[i]].push_back(s);
                if (mesh.neighbors_of(s)[i] == NM_NONE) {
                    is_bounded[ids[(i + 1) % 3]] = is_bounded[ids[(i + 2) % 3]] = false;
                }
            }
        }
        for (std::size_t vertex = 0; vertex < vertices.size(); ++vertex) {
            measure(vertex);
        }
    }

    void measure(std::size_t vertex) {
        const Point2& x = vertices[vertex];
        const std::size_t input = nearest_of(vertices, inputs, x);
        const long double f = distance(x, vertices[input]);
        long double reach = 0;
        bool is_in_group = is_bounded[vertex];
        for (const std::size_t s : stars[vertex]) {
            reach = std::max(reach, distance(x, centers[s]));
            const Point2& nearest = vertices[nearest_of(vertices, inputs, centers[s])];
            const long double rounding = 1 + 1e-12L;
            is_in_group &= distance(centers[s], vertices[input]) <= rounding * distance(centers[s], nearest);
        }
        if (is_in_group || vertex < inputs) {
            groups[vertex] = input;
        }
        low[vertex] = is_bounded[vertex] ? std::max(f - reach, f / 2) : f / 2;
        high[vertex] = f + reach;
    }

    bool is_in_group(std::size_t vertex) const { return groups[vertex] != inputs; }

    // When the cell of a vertex in no group is there, if not at the end.
    long double time(std::size_t vertex, long double end) const {
        return is_bounded[vertex] ? std::min(end, std::sqrt(low[vertex] * high[vertex])) : end;
    }

    // The least distance from an input to the points that the cells of a face have in common.
    long double reach(const Face& face, std::size_t input) const {
        const Point2& p = vertices[input];
        if (face.size() == 1) {
            if (face[0] == input) {
                return 0;
            }
            long double least = INFINITY;
            for (std::uint32_t other = 0; other < vertices.size(); ++other) {
                const Face edge{std::min(face[0], other), std::max(face[0], other)};
                if (other != face[0] && corners(edge).size() == 2) {
                    least = std::min(least, reach(edge, input));
                }
            }
            return least;
        }
        const auto found = corners(face);
        return distance_to_segment(p, centers[found.front()], centers[found.back()]);
    }

    // The triangles that have all vertices of a face.
    std::vector<std::size_t> corners(const Face& face) const {
        std::vector<std::size_t> found;
        for (const std::size_t s : stars[face[0]]) {
            const std::set<std::uint32_t> ids(mesh.simplex(s), mesh.simplex(s) + 3);
            if (std::all_of(face.begin(), face.end(), [&](std::uint32_t id) { return ids.count(id) == 1; })) {
                found.push_back(s);
            }
        }
        return found;
    }

    long double value(const Face& face, long double end) const {
        long double value = 0;
        for (const std::uint32_t vertex : face) {
            value = std::max(value, is_in_group(vertex) ? reach(face, groups[vertex]) : time(vertex, end));
        }
        return std::min(value, end);
    }
};

void values_of_a_mesh_are_their_definition() {
    const PointSet points = generate("uniform", 2, 25);
    const MeshHandle mesh = create(points);
    nm_options options = default_options();
    options.output = NM_OUTPUT_WELL_SPACED;
    REQUIRE_OK(nm_run(mesh.get(), &options));
    REQUIRE_OK(nm_mesh_make_filtration(mesh.get(), NM_FILTRATION_MESH, 0));
    const Cells cells(mesh.get(), points.size());
    const Faces faces = faces_of(cells.mesh);
    // At the end all balls have a point in common: vertices of unbounded cells, in no group, tell when.
    const auto of_vertices = filtration(mesh.get(), NM_FILTRATION_MESH, 0);
    const double end = *std::max_element(of_vertices.begin(), of_vertices.end());
    long double least = INFINITY;
    for (const Point2& x : cells.centers) {
        long double farthest = 0;
        for (std::size_t input = 0; input < points.size(); ++input) {
            farthest = std::max(farthest, distance(x, cells.vertices[input]));
        }
        least = std::min(least, farthest);
    }
    CHECK(end <= 2 * least);
    bool meet = false;
    for (std::size_t i = 0; i <= 400 && !meet; ++i) {
        const Point2 x{i % 21 / 20.0L, i / 21 / 20.0L};
        meet = std::all_of(cells.vertices.begin(), cells.vertices.begin() + 25,
                           [&](const Point2& input) { return distance(x, input) <= end; });
    }
    CHECK(meet);
    std::size_t grouped = 0;
    for (std::uint32_t k = 0; k <= 2; ++k) {
        const auto found = filtration(mesh.get(), NM_FILTRATION_MESH, k);
        for (const auto& [face, number] : faces[k]) {
            check::context = "dimension " + std::to_string(k) + ", face " + std::to_string(number);
            const long double expected = cells.value(face, end);
            CHECK_AT_MOST(std::abs(found[number] - expected), 1e-5L * expected);
            grouped += k == 0 && face[0] >= points.size() && cells.is_in_group(face[0]);
        }
    }
    check::context.clear();
    // Some Steiner vertices are in groups, and some are not.
    CHECK(grouped > 0 && grouped < cells.vertices.size() - points.size());
    long double largest = 1;
    for (std::size_t vertex = 0; vertex < cells.vertices.size(); ++vertex) {
        if (!cells.is_in_group(vertex)) {
            const bool is_early = cells.time(vertex, end) < end;
            const long double ratio = cells.high[vertex] / cells.low[vertex];
            largest = std::max(largest, is_early ? std::sqrt(ratio) : end / cells.low[vertex]);
        }
    }
    CHECK_AT_MOST(std::abs(factor(mesh.get(), NM_FILTRATION_MESH) / largest - 1), 1e-5L);
    double unwritten = -1;
    CHECK_STATUS(nm_mesh_filtration_factor(mesh.get(), NM_FILTRATION_ALPHA, &unwritten), NM_INVALID_ARGUMENT);
    CHECK_STATUS(nm_mesh_make_filtration(mesh.get(), NM_FILTRATION_ALPHA, 1), NM_INVALID_ARGUMENT);
    CHECK(unwritten == -1);
}

// All faces of all dimensions, in one sequence.
std::map<Face, double> values_of(const nm_mesh* mesh, const Faces& faces) {
    std::map<Face, double> values;
    for (std::uint32_t k = 0; k < faces.size(); ++k) {
        const auto of_dimension = filtration(mesh, NM_FILTRATION_ALPHA, k);
        for (const auto& [face, number] : faces[k]) {
            values[face] = of_dimension[number];
        }
    }
    return values;
}

void text_has_all_faces(const std::string& path, const std::map<Face, double>& expected) {
    std::ifstream file(path);
    std::map<Face, double> found;
    double last = 0;
    for (std::string line; std::getline(file, line);) {
        std::istringstream words(line);
        std::size_t k = 0;
        REQUIRE(words >> k);
        Face face(k + 1);
        for (std::uint32_t& vertex : face) {
            words >> vertex;
        }
        // GUDHI's order.
        CHECK(std::is_sorted(face.rbegin(), face.rend()));
        std::reverse(face.begin(), face.end());
        std::string number;
        words >> number;
        const double value = std::strtod(number.c_str(), nullptr);
        CHECK(value >= last);
        last = value;
        for (std::size_t i = 0; k > 0 && i < face.size(); ++i) {
            CHECK(found.count(without(face, i)) == 1);
        }
        CHECK(found.emplace(face, value).second);
    }
    CHECK(found == expected);
}

// DIPHA's weighted boundary matrix: eight bytes a number, dimensions and values of all cells, where
// the lists of facets begin, and these.
void matrix_has_all_faces(const std::string& path, const Faces& faces, const std::map<Face, double>& values) {
    std::ifstream file(path, std::ios::binary);
    const auto number = [&file] {
        std::int64_t value = -1;
        file.read(reinterpret_cast<char*>(&value), sizeof value);
        return value;
    };
    const auto expect = [&number](std::int64_t expected) {
        const std::int64_t found = number();
        CHECK_EQUAL(found, expected);
    };
    expect(8067171840);
    expect(0);
    expect(0);
    expect(static_cast<std::int64_t>(values.size()));
    expect(static_cast<std::int64_t>(faces.size()) - 1);
    // Cells by dimension, and by their numbers there.
    std::vector<Face> cells;
    std::map<Face, std::int64_t> places;
    for (const auto& of_dimension : faces) {
        for (const auto& face : of_dimension) {
            places[face.first] = static_cast<std::int64_t>(cells.size());
            cells.push_back(face.first);
        }
    }
    for (const Face& cell : cells) {
        expect(static_cast<std::int64_t>(cell.size()) - 1);
    }
    for (const Face& cell : cells) {
        double value = -1;
        file.read(reinterpret_cast<char*>(&value), sizeof value);
        CHECK_EQUAL(value, values.at(cell));
    }
    std::int64_t start = 0;
    for (const Face& cell : cells) {
        expect(start);
        start += cell.size() > 1 ? static_cast<std::int64_t>(cell.size()) : 0;
    }
    expect(start);
    for (const Face& cell : cells) {
        std::multiset<std::int64_t> expected, found;
        for (std::size_t i = 0; cell.size() > 1 && i < cell.size(); ++i) {
            expected.insert(places.at(without(cell, i)));
            found.insert(number());
        }
        CHECK(found == expected);
    }
    CHECK(file.good() && file.get() == std::ifstream::traits_type::eof());
}

void files_have_all_faces(const std::string& directory) {
    const MeshHandle mesh = delaunay_of(generate("uniform", 3, 20));
    const Faces faces = faces_of(export_mesh(mesh.get()));
    const auto values = values_of(mesh.get(), faces);
    const std::string text = directory + "/filtrations.filtration", matrix = directory + "/filtrations.dipha";
    REQUIRE_OK(nm_export_filtration(mesh.get(), NM_FILTRATION_ALPHA, text.c_str()));
    text_has_all_faces(text, values);
    REQUIRE_OK(nm_export_filtration(mesh.get(), NM_FILTRATION_ALPHA, matrix.c_str()));
    matrix_has_all_faces(matrix, faces, values);
    CHECK(std::remove(text.c_str()) == 0 && std::remove(matrix.c_str()) == 0);
    CHECK_STATUS(nm_export_filtration(mesh.get(), NM_FILTRATION_ALPHA, (directory + "/a.vtu").c_str()),
                 NM_INVALID_ARGUMENT);
    CHECK_STATUS(nm_export_filtration(mesh.get(), NM_FILTRATION_ALPHA, nullptr), NM_NULL_ARGUMENT);
}

}  // namespace

int main(int argc, char** argv) {
    if (argc != 2) {
        return 2;
    }
    for (const unsigned dim : {2u, 3u, 4u}) {
        const MeshHandle mesh = create(generate("uniform", dim, dim == 4 ? 5 : 30));
        REQUIRE_OK(nm_run(mesh.get(), nullptr));
        faces_are_all_faces(mesh);
        alpha_values_are_their_definition(dim, 40);
    }
    values_of_a_mesh_are_their_definition();
    files_have_all_faces(argv[1]);
    return check::result("filtrations");
}
