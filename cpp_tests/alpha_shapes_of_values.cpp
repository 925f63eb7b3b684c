// Alpha shapes through the C interface, each figure from the definitions and alpha values that are found by
// brute force, and in the plane CGAL's shapes beside where CGAL is there.
//
//   alpha_shapes_of_values <directory for its files>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <fstream>
#include <limits>
#include <numeric>
#include <set>
#include <string>
#include <vector>

#include "alpha_values.hpp"
#include "check.hpp"
#include "fetched.hpp"
#include "mesh.hpp"

#ifdef NETMESH_WITH_CGAL
#include <CGAL/Alpha_shape_2.h>
#include <CGAL/Alpha_shape_face_base_2.h>
#include <CGAL/Alpha_shape_vertex_base_2.h>
#include <CGAL/Delaunay_triangulation_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#endif

namespace {

// Sets with numbers, as union and find has them.
class Groups {
public:
    explicit Groups(std::size_t count) : parents_(count) { std::iota(parents_.begin(), parents_.end(), 0u); }

    std::size_t find(std::size_t item) {
        while (parents_[item] != item) {
            item = parents_[item] = parents_[parents_[item]];
        }
        return item;
    }

    void join(std::size_t a, std::size_t b) { parents_[find(a)] = find(b); }

    // Number of groups that the items have for which `counts` holds.
    template <class Counts>
    std::size_t count(Counts counts) {
        std::set<std::size_t> found;
        for (std::size_t item = 0; item < parents_.size(); ++item) {
            if (counts(item)) {
                found.insert(find(item));
            }
        }
        return found.size();
    }

private:
    std::vector<std::size_t> parents_;
};

// A triangulation with its faces and values.
struct Complex {
    explicit Complex(const PointSet& points)
        : handle(delaunay_of(points)), mesh(export_mesh(handle.get())), faces(faces_of(mesh)),
          values(alpha_values(mesh, faces)) {
        for (std::size_t s = 0; s < mesh.simplex_count(); ++s) {
            Face all(mesh.simplex(s), mesh.simplex(s) + mesh.dim + 1);
            std::sort(all.begin(), all.end());
            of_simplices.push_back(values[mesh.dim][faces[mesh.dim].at(all)]);
        }
    }

    std::uint32_t dim() const { return mesh.dim; }

    MeshHandle handle;
    ExportedMesh mesh;
    Faces faces;
    std::vector<std::vector<long double>> values;
    // Values by the numbers of simplices.
    std::vector<long double> of_simplices;
};

// Values between those of faces, so that no rounding decides what is in the shape.
std::vector<double> alphas(const Complex& complex) {
    std::vector<long double> all = complex.of_simplices;
    std::sort(all.begin(), all.end());
    std::vector<double> found{0.0, std::numeric_limits<double>::infinity()};
    for (const double share : {0.05, 0.3, 0.6, 0.9}) {
        const auto at = static_cast<std::size_t>(share * static_cast<double>(all.size() - 1));
        found.push_back(static_cast<double>((all[at] + all[at + 1]) / 2));
    }
    return found;
}

long double volume(const ExportedMesh& mesh, std::size_t s) {
    std::array<std::array<long double, 3>, 3> edges{};
    for (unsigned i = 0; i < mesh.dim; ++i) {
        for (unsigned axis = 0; axis < mesh.dim; ++axis) {
            edges[i][axis] = static_cast<long double>(mesh.point(mesh.simplex(s)[i + 1])[axis])
                             - mesh.point(mesh.simplex(s)[0])[axis];
        }
    }
    if (mesh.dim == 2) {
        return (edges[0][0] * edges[1][1] - edges[0][1] * edges[1][0]) / 2;
    }
    long double sum = 0;
    for (unsigned k = 0; k < 3; ++k) {
        const unsigned l = (k + 1) % 3, m = (k + 2) % 3;
        sum += edges[0][k] * (edges[1][l] * edges[2][m] - edges[1][m] * edges[2][l]);
    }
    return sum / 6;
}

// Components of the shape's graph; bounded components of what is outside, across facets outside.
void measures_are_counts(const Complex& complex, double alpha) {
    auto shape = sized<nm_alpha_shape>();
    REQUIRE_OK(nm_mesh_alpha_shape(complex.handle.get(), alpha, &shape));
    const std::uint32_t dim = complex.dim();
    std::int64_t euler = 0;
    for (std::uint32_t k = 0; k <= dim; ++k) {
        const auto count = std::count_if(complex.values[k].begin(), complex.values[k].end(),
                                         [&](long double value) { return value <= alpha; });
        CHECK_EQUAL(shape.face_counts[k], static_cast<std::uint64_t>(count));
        euler += k % 2 == 0 ? count : -count;
    }
    CHECK_EQUAL(shape.euler_characteristic, euler);
    Groups vertices(complex.mesh.vertex_count());
    for (const auto& [edge, number] : complex.faces[1]) {
        if (complex.values[1][number] <= alpha) {
            vertices.join(edge[0], edge[1]);
        }
    }
    const std::size_t components = vertices.count([](std::size_t) { return true; });
    // All that is beyond the hull is one more simplex.
    const std::size_t beyond = complex.mesh.simplex_count();
    Groups outside(beyond + 1);
    long double sum = 0;
    for (std::size_t s = 0; s < beyond; ++s) {
        if (complex.of_simplices[s] <= alpha) {
            sum += volume(complex.mesh, s);
            continue;
        }
        Face all(complex.mesh.simplex(s), complex.mesh.simplex(s) + dim + 1);
        for (std::uint32_t i = 0; i <= dim; ++i) {
            Face facet = without(all, i);
            std::sort(facet.begin(), facet.end());
            const std::uint32_t other = complex.mesh.neighbors_of(s)[i];
            if (complex.values[dim - 1][complex.faces[dim - 1].at(facet)] > alpha) {
                outside.join(s, other == NM_NONE ? beyond : other);
            }
        }
    }
    const std::size_t voids = outside.count([&](std::size_t s) {
        return s < beyond && complex.of_simplices[s] > alpha && outside.find(s) != outside.find(beyond);
    });
    CHECK_EQUAL(shape.components, components);
    CHECK_EQUAL(shape.voids, voids);
    CHECK_AT_MOST(std::abs(shape.volume - sum), 1e-11L * sum);
    // The alternating sum of the Betti numbers is that of the faces.
    CHECK_EQUAL(shape.betti_count, dim);
    CHECK_EQUAL(shape.betti[0], components);
    CHECK_EQUAL(shape.betti[dim - 1], voids);
    const auto signed_components = static_cast<std::int64_t>(components);
    if (dim == 2) {
        CHECK_EQUAL(signed_components - static_cast<std::int64_t>(shape.betti[1]), euler);
    } else {
        CHECK_EQUAL(signed_components + static_cast<std::int64_t>(voids)
                        - static_cast<std::int64_t>(shape.betti[1]), euler);
    }
}

std::vector<std::uint8_t> classes(const Complex& complex, double alpha, std::uint32_t k) {
    return fetched<std::uint8_t>([&](std::uint8_t* buf, std::uint64_t capacity, std::uint64_t* needed) {
        return nm_mesh_get_alpha_shape_classes(complex.handle.get(), alpha, k, buf, capacity, needed);
    });
}

// A face on the hull is never interior; for another all simplices that have it tell.
void classes_are_their_definition(const Complex& complex, double alpha) {
    const std::uint32_t dim = complex.dim();
    std::vector<std::vector<bool>> is_interior(dim + 1), is_in_larger(dim + 1);
    for (std::uint32_t k = 0; k <= dim; ++k) {
        is_interior[k].assign(complex.faces[k].size(), true);
        is_in_larger[k].assign(complex.faces[k].size(), false);
    }
    const auto clear = [&](const Face& face) { is_interior[face.size() - 1][complex.faces[face.size() - 1].at(face)] = false; };
    const auto each_part = [](const Face& face, auto call) {
        for (unsigned chosen = 1; chosen < 1u << face.size(); ++chosen) {
            Face part;
            for (std::size_t i = 0; i < face.size(); ++i) {
                if (chosen >> i & 1) {
                    part.push_back(face[i]);
                }
            }
            call(part);
        }
    };
    for (std::size_t s = 0; s < complex.mesh.simplex_count(); ++s) {
        const Face given(complex.mesh.simplex(s), complex.mesh.simplex(s) + dim + 1);
        for (std::uint32_t i = 0; i <= dim; ++i) {
            if (complex.mesh.neighbors_of(s)[i] == NM_NONE) {
                Face facet = without(given, i);
                std::sort(facet.begin(), facet.end());
                each_part(facet, clear);
            }
        }
        if (complex.of_simplices[s] > alpha) {
            Face all = given;
            std::sort(all.begin(), all.end());
            each_part(all, clear);
        }
    }
    for (std::uint32_t k = 1; k <= dim; ++k) {
        for (const auto& [face, number] : complex.faces[k]) {
            for (std::size_t i = 0; complex.values[k][number] <= alpha && i < face.size(); ++i) {
                is_in_larger[k - 1][complex.faces[k - 1].at(without(face, i))] = true;
            }
        }
    }
    for (std::uint32_t k = 0; k <= dim; ++k) {
        const auto found = classes(complex, alpha, k);
        REQUIRE(found.size() == complex.faces[k].size());
        for (std::size_t face = 0; face < found.size(); ++face) {
            const nm_face_class expected = complex.values[k][face] > alpha ? NM_FACE_CLASS_EXTERIOR
                                           : k == dim || is_interior[k][face] ? NM_FACE_CLASS_INTERIOR
                                           : is_in_larger[k][face]            ? NM_FACE_CLASS_REGULAR
                                                                              : NM_FACE_CLASS_SINGULAR;
            CHECK_EQUAL(int{found[face]}, int{expected});
        }
    }
}

// A facet with its orientation: even permutations of its vertices are one.
Face turned(Face facet) {
    std::rotate(facet.begin(), std::min_element(facet.begin(), facet.end()), facet.end());
    return facet;
}

// The facets of the shape's simplices that lead out of it, as seen from outside.
std::multiset<Face> boundary_of(const Complex& complex, double alpha) {
    std::multiset<Face> expected;
    const std::uint32_t dim = complex.dim();
    for (std::size_t s = 0; s < complex.mesh.simplex_count(); ++s) {
        for (std::uint32_t i = 0; complex.of_simplices[s] <= alpha && i <= dim; ++i) {
            const std::uint32_t other = complex.mesh.neighbors_of(s)[i];
            if (other != NM_NONE && complex.of_simplices[other] <= alpha) {
                continue;
            }
            Face facet = without({complex.mesh.simplex(s), complex.mesh.simplex(s) + dim + 1}, i);
            // A simplex is positive with the vertex before its facet; the vertex comes there by i
            // exchanges.
            if (i % 2 == 1) {
                std::swap(facet[0], facet[1]);
            }
            // In 2D an edge is no cycle: its order is what there is.
            expected.insert(dim == 2 ? facet : turned(facet));
        }
    }
    return expected;
}

void boundaries_are_what_leads_out(const Complex& complex, double alpha, const std::string& directory) {
    const std::uint32_t dim = complex.dim();
    const auto flat = fetched<std::uint32_t>([&](std::uint32_t* buf, std::uint64_t capacity, std::uint64_t* needed) {
        return nm_mesh_get_alpha_shape_boundary(complex.handle.get(), alpha, buf, capacity, needed);
    });
    std::multiset<Face> found;
    for (std::size_t i = 0; i < flat.size(); i += dim) {
        const Face facet(flat.begin() + static_cast<std::ptrdiff_t>(i), flat.begin() + static_cast<std::ptrdiff_t>(i + dim));
        found.insert(dim == 2 ? facet : turned(facet));
    }
    CHECK(found == boundary_of(complex, alpha));
    const std::string path = directory + "/alpha_shapes_of_values.off";
    REQUIRE_OK(nm_export_alpha_shape(complex.handle.get(), alpha, path.c_str()));
    std::ifstream file(path);
    std::string word;
    std::size_t vertices = 0, facets = 0, others = 0;
    file >> word >> vertices >> facets >> others;
    CHECK_EQUAL(word, "OFF");
    CHECK_EQUAL(vertices, (std::set<std::uint32_t>(flat.begin(), flat.end()).size()));
    CHECK_EQUAL(facets, found.size());
    std::vector<std::array<double, 3>> points(vertices);
    for (auto& point : points) {
        file >> point[0] >> point[1] >> point[2];
    }
    // Facets are compared by the places of their vertices.
    std::multiset<std::vector<double>> written, expected;
    for (std::size_t i = 0; i < facets; ++i) {
        std::vector<double> places;
        std::size_t size = 0;
        file >> size;
        CHECK_EQUAL(size, std::size_t{dim});
        for (std::uint32_t corner = 0; corner < dim; ++corner) {
            std::size_t id = vertices;
            file >> id;
            REQUIRE(file && id < vertices);
            places.insert(places.end(), points[id].begin(), points[id].begin() + dim);
        }
        written.insert(places);
    }
    for (std::size_t i = 0; i < flat.size(); i += dim) {
        std::vector<double> places;
        for (std::uint32_t corner = 0; corner < dim; ++corner) {
            const double* point = complex.mesh.point(flat[i + corner]);
            places.insert(places.end(), point, point + dim);
        }
        expected.insert(places);
    }
    CHECK(written == expected);
    CHECK(std::remove(path.c_str()) == 0);
}

// A quarter of the square of the longest edge that a minimum spanning tree needs.
long double connecting(const ExportedMesh& mesh) {
    const std::size_t count = mesh.vertex_count();
    std::vector<long double> nearest(count, std::numeric_limits<long double>::infinity());
    std::vector<bool> is_in_tree(count);
    long double longest = 0;
    nearest[0] = 0;
    for (std::size_t step = 0; step < count; ++step) {
        std::uint32_t next = 0;
        while (is_in_tree[next]) {
            ++next;
        }
        for (std::uint32_t vertex = next; vertex < count; ++vertex) {
            if (!is_in_tree[vertex] && nearest[vertex] < nearest[next]) {
                next = vertex;
            }
        }
        is_in_tree[next] = true;
        longest = std::max(longest, nearest[next]);
        for (std::uint32_t vertex = 0; vertex < count; ++vertex) {
            long double square = 0;
            for (unsigned axis = 0; axis < mesh.dim; ++axis) {
                square += std::pow(static_cast<long double>(mesh.point(vertex)[axis]) - mesh.point(next)[axis], 2.0L);
            }
            nearest[vertex] = std::min(nearest[vertex], square);
        }
    }
    return longest / 4;
}

// The least value of a simplex with which all vertices are covered by few enough pieces.
long double optimal(const Complex& complex, std::size_t most) {
    std::vector<long double> all = complex.of_simplices;
    std::sort(all.begin(), all.end());
    for (const long double alpha : all) {
        std::set<std::uint32_t> covered;
        Groups pieces(complex.mesh.simplex_count());
        const auto is_in = [&](std::size_t s) { return complex.of_simplices[s] <= alpha; };
        for (std::size_t s = 0; s < complex.mesh.simplex_count(); ++s) {
            for (std::uint32_t i = 0; is_in(s) && i <= complex.dim(); ++i) {
                covered.insert(complex.mesh.simplex(s)[i]);
                const std::uint32_t other = complex.mesh.neighbors_of(s)[i];
                if (other != NM_NONE && is_in(other)) {
                    pieces.join(s, other);
                }
            }
        }
        if (covered.size() == complex.mesh.vertex_count() && pieces.count(is_in) <= most) {
            return alpha;
        }
    }
    return std::numeric_limits<long double>::infinity();
}

void values_are_the_least(const Complex& complex) {
    double alpha = -1;
    REQUIRE_OK(nm_mesh_connecting_alpha(complex.handle.get(), &alpha));
    const long double tree = connecting(complex.mesh);
    CHECK_AT_MOST(std::abs(alpha - tree), 1e-15L * tree);
    for (const std::size_t most : {1u, 2u, 5u}) {
        REQUIRE_OK(nm_mesh_optimal_alpha(complex.handle.get(), most, &alpha));
        const long double expected = optimal(complex, most);
        CHECK_AT_MOST(std::abs(alpha - expected), 1e-12L * expected);
    }
    alpha = -1;
    CHECK_STATUS(nm_mesh_optimal_alpha(complex.handle.get(), 0, &alpha), NM_INVALID_ARGUMENT);
    CHECK_STATUS(nm_mesh_connecting_alpha(nullptr, &alpha), NM_NULL_ARGUMENT);
    auto shape = sized<nm_alpha_shape>();
    CHECK_STATUS(nm_mesh_alpha_shape(complex.handle.get(), -1, &shape), NM_INVALID_ARGUMENT);
    CHECK(alpha == -1 && shape.components == 0);
    CHECK_STATUS(nm_export_alpha_shape(complex.handle.get(), 1, "shape.vtu"), NM_INVALID_ARGUMENT);
}

// Points in two clusters, which one piece needs a far larger value for than two.
PointSet two_clusters(unsigned dim) {
    PointSet points = generate("uniform", dim, 40);
    for (std::size_t i = 0; i < points.coordinates.size() / 2; ++i) {
        points.coordinates[i] += 3;
    }
    return points;
}

#ifdef NETMESH_WITH_CGAL

// CGAL's shapes of the plane, counted by class.
void counts_are_cgals() {
    using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
    using Vertices = CGAL::Alpha_shape_vertex_base_2<Kernel>;
    using Triangles = CGAL::Alpha_shape_face_base_2<Kernel>;
    using Delaunay = CGAL::Delaunay_triangulation_2<Kernel, CGAL::Triangulation_data_structure_2<Vertices, Triangles>>;
    using Alpha = CGAL::Alpha_shape_2<Delaunay>;
    const PointSet points = generate("gaussian", 2, 300);
    const Complex complex(points);
    std::vector<Kernel::Point_2> others;
    for (std::size_t i = 0; i < points.size(); ++i) {
        others.emplace_back(points.point(i)[0], points.point(i)[1]);
    }
    Alpha cgal(others.begin(), others.end(), 0, Alpha::GENERAL);
    for (const double alpha : alphas(complex)) {
        if (alpha == 0 || std::isinf(alpha)) {
            continue;
        }
        cgal.set_alpha(alpha);
        std::array<std::array<long, 4>, 3> found{}, expected{};
        // CGAL's names in the order of its values.
        const auto place = [](Alpha::Classification_type type) {
            return type == Alpha::EXTERIOR   ? NM_FACE_CLASS_EXTERIOR
                   : type == Alpha::SINGULAR ? NM_FACE_CLASS_SINGULAR
                   : type == Alpha::REGULAR  ? NM_FACE_CLASS_REGULAR
                                             : NM_FACE_CLASS_INTERIOR;
        };
        for (auto edge = cgal.finite_edges_begin(); edge != cgal.finite_edges_end(); ++edge) {
            ++expected[1][place(cgal.classify(*edge))];
        }
        for (auto face = cgal.finite_faces_begin(); face != cgal.finite_faces_end(); ++face) {
            ++expected[2][place(cgal.classify(Alpha::Face_handle(face)))];
        }
        for (std::uint32_t k = 1; k <= 2; ++k) {
            for (const std::uint8_t each : classes(complex, alpha, k)) {
                ++found[k][each];
            }
            CHECK(found[k] == expected[k]);
        }
        auto shape = sized<nm_alpha_shape>();
        REQUIRE_OK(nm_mesh_alpha_shape(complex.handle.get(), alpha, &shape));
        CHECK(shape.face_counts[2] == static_cast<std::uint64_t>(expected[2][NM_FACE_CLASS_INTERIOR]));
    }
    double alpha = 0;
    REQUIRE_OK(nm_mesh_optimal_alpha(complex.handle.get(), 1, &alpha));
    CHECK(*cgal.find_optimal_alpha(1) >= alpha * (1 - 1e-9));
    CHECK(cgal.number_of_solid_components(alpha * (1 + 1e-9)) == 1);
}

#endif

}  // namespace

int main(int argc, char** argv) {
    if (argc != 2) {
        return 2;
    }
    for (const unsigned dim : {2u, 3u}) {
        const Complex complex(generate("gaussian", dim, 45));
        for (const double alpha : alphas(complex)) {
            check::context = std::to_string(dim) + "D, alpha " + std::to_string(alpha);
            measures_are_counts(complex, alpha);
            classes_are_their_definition(complex, alpha);
            boundaries_are_what_leads_out(complex, alpha, argv[1]);
        }
        check::context.clear();
        values_are_the_least(complex);
        const Complex clusters(two_clusters(dim));
        CHECK(optimal(clusters, 1) > 2 * optimal(clusters, 2));
        values_are_the_least(clusters);
    }
#ifdef NETMESH_WITH_CGAL
    counts_are_cgals();
#endif
    return check::result("alpha_shapes_of_values");
}
