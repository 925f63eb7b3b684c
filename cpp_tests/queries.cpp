// Queries, arrays ready to use, selections and filtrations, through netmesh.hpp: each answer against what the
// mesh's own arrays say.
#include <netmesh/alpha_shape.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <fstream>
#include <iterator>
#include <limits>
#include <numeric>
#include <set>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "check.hpp"
#include "inputs.hpp"

namespace {

using Ids = netmesh::span<const std::uint32_t>;

netmesh::mesh meshed(std::uint32_t dim, std::size_t count) {
    netmesh::mesh mesh(dim, generate("uniform", dim, count).coordinates);
    mesh.run();
    return mesh;
}

// The middle of each simplex.
std::vector<double> middles(const netmesh::mesh& mesh) {
    const auto points = mesh.points();
    std::vector<double> found;
    for (Ids simplex : mesh.simplices()) {
        for (std::size_t axis = 0; axis < points.width(); ++axis) {
            double sum = 0;
            for (std::uint32_t vertex : simplex) {
                sum += points[vertex][axis];
            }
            found.push_back(sum / static_cast<double>(simplex.size()));
        }
    }
    return found;
}

void middles_are_in_their_simplices(std::uint32_t dim) {
    const netmesh::mesh mesh = meshed(dim, dim == 4 ? 12 : 200);
    const std::vector<double> points = middles(mesh);
    const std::vector<std::uint32_t> found = mesh.locate(points, 2);
    std::vector<std::uint32_t> expected(found.size());
    std::iota(expected.begin(), expected.end(), 0u);
    CHECK(found == expected);
    CHECK(mesh.index() > 0);
    const std::vector<double> far(dim, 1e6);
    CHECK(mesh.locate(far)[0] == NM_NONE);
    const auto near = mesh.nearest(mesh.points().flat());
    for (std::size_t vertex = 0; vertex < near.vertices.size(); ++vertex) {
        CHECK(near.vertices[vertex] == vertex && near.distances[vertex] == 0);
    }
    const auto input = mesh.nearest_input(far);
    CHECK(input.inputs[0] < mesh.counts().inputs);

    // A linear function goes through unchanged.
    const auto vertices = mesh.points();
    std::vector<double> values;
    for (netmesh::span<const double> point : vertices) {
        values.push_back(std::accumulate(point.begin(), point.end(), 1.0));
    }
    for (nm_interpolation method : {NM_INTERPOLATION_LINEAR, NM_INTERPOLATION_SIBSON,
                                    NM_INTERPOLATION_LAPLACE_OR_NEAREST}) {
        const auto out = mesh.interpolate(method, 1, values, points);
        for (std::size_t i = 0; i < out.size(); ++i) {
            const double* point = points.data() + i * dim;
            CHECK(std::abs(out[i][0] - std::accumulate(point, point + dim, 1.0)) < 1e-9);
        }
    }
    CHECK(std::isnan(mesh.interpolate(NM_INTERPOLATION_LINEAR, 1, values, far)[0][0]));
    CHECK(!std::isnan(mesh.interpolate(NM_INTERPOLATION_LINEAR_OR_NEAREST, 1, values, far)[0][0]));
    const std::size_t inputs = mesh.counts().inputs;
    const auto extended = mesh.extend_values(1, {values.data(), inputs});
    CHECK(extended.size() == values.size());
    CHECK(std::equal(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(inputs),
                     extended.flat().begin()));
}

void arrays_fit_together(std::uint32_t dim) {
    const netmesh::mesh mesh = meshed(dim, dim == 4 ? 12 : 200);
    const auto simplices = mesh.simplices();
    const auto stars = mesh.vertex_simplices();
    const auto neighbors = mesh.vertex_neighbors();
    CHECK(stars.size() == mesh.points().size() && neighbors.size() == stars.size());
    std::size_t vertex = 0;
    for (Ids star : stars) {
        for (std::uint32_t simplex : star) {
            const Ids ids = simplices[simplex];
            CHECK(std::find(ids.begin(), ids.end(), vertex) != ids.end());
        }
        ++vertex;
    }
    CHECK(stars.flat().size() == simplices.flat().size());
    const auto edges = mesh.edges();
    CHECK(2 * edges.size() == neighbors.flat().size());
    for (Ids edge : edges) {
        const Ids others = neighbors[edge[0]];
        CHECK(edge[0] < edge[1] && std::find(others.begin(), others.end(), edge[1]) != others.end());
    }
    const auto facets = mesh.facets();
    const auto hull = mesh.hull();
    CHECK(2 * facets.vertices.size() == simplices.flat().size() + hull.vertices.size());
    CHECK(facets.simplices.width() == 2 && hull.simplices.width() == 1);
    CHECK(hull.vertices.width() == dim);
    const auto volumes = mesh.volumes();
    const auto shares = mesh.region_shares();
    const double volume = std::accumulate(volumes.begin(), volumes.end(), 0.0);
    CHECK(std::abs(std::accumulate(shares.begin(), shares.end(), 0.0) / volume - 1) < 1e-9);
    std::set<std::uint32_t> on_hull(hull.vertices.flat().begin(), hull.vertices.flat().end());
    const auto cells = mesh.region_volumes();
    for (std::uint32_t id = 0; id < cells.size(); ++id) {
        CHECK(std::isinf(cells[id]) == (on_hull.count(id) == 1));
    }
    CHECK(mesh.regions().size() == cells.size() && mesh.ridge_corners().size() == edges.size());
    CHECK(mesh.ridge_bounded().size() == edges.size());
    const auto centers = mesh.circumcenters();
    const auto radii = mesh.circumradii();
    const auto points = mesh.points();
    for (std::size_t i = 0; i < simplices.size(); ++i) {
        double square = 0;
        for (std::size_t axis = 0; axis < dim; ++axis) {
            square += std::pow(centers[i][axis] - points[simplices[i][0]][axis], 2);
        }
        CHECK(std::abs(std::sqrt(square) / radii[i] - 1) < 1e-9);
    }
}

void selections_are_parts(const std::string& directory) {
    const netmesh::mesh mesh = meshed(3, 300);
    netmesh::selection hull;
    hull.extent = NM_EXTENT_HULL;
    netmesh::selection touched = hull;
    touched.across = true;
    const auto placements = mesh.placements(NM_EXTENT_HULL);
    const auto count = [&placements](int placement) {
        return static_cast<std::size_t>(std::count(placements.begin(), placements.end(), placement));
    };
    const std::size_t inside = count(NM_PLACEMENT_INSIDE);
    CHECK(mesh.selected(hull).size() == inside && mesh.volumes(hull).size() == inside);
    CHECK(mesh.selected(touched).size() == inside + count(NM_PLACEMENT_ACROSS));
    CHECK(inside > 0 && count(NM_PLACEMENT_OUTSIDE) > 0);
    CHECK(mesh.edges(hull).size() < mesh.edges().size());
    const std::string path = directory + "/inside_the_hull.off";
    mesh.save(path, hull);
    const netmesh::mesh back = netmesh::mesh::from_file(path);
    CHECK(back.counts().inputs < mesh.counts().vertices && back.counts().inputs >= 300);
}

void attributes_reach_all_vertices(const std::string &directory) {
    netmesh::mesh mesh = meshed(2, 100);
    std::vector<double> heat(100, 2.5);
    mesh.set_attributes("heat", 1, heat);
    mesh.set_attributes("given", 1, heat, false);
    const auto vertices = static_cast<std::size_t>(mesh.counts().vertices);
    const auto found = mesh.attributes("heat");
    CHECK(found.size() == vertices);
    CHECK(std::all_of(found.begin(), found.end(), [](double x) { return std::abs(x - 2.5) < 1e-12; }));
    const auto given = mesh.attributes("given");
    CHECK(given.size() == vertices && given[99] == 2.5 && std::isnan(given.back()));
    CHECK(mesh.to_string(NM_FORMAT_VTU).find("Name=\"heat\"") != std::string::npos);
    const std::string path = directory + "/heat.csv";
    mesh.save(path);
    const netmesh::mesh back = netmesh::mesh::from_columns(path, "x0,x1", "warmth=heat");
    CHECK(back.attributes("warmth") == found);
    CHECK(netmesh::mesh::try_from_columns(path, "", "cold").status() == NM_INVALID_ARGUMENT);
    mesh.set_attributes("heat", 1, {});
    CHECK(mesh.try_attributes("heat").status() == NM_INVALID_ARGUMENT);
    CHECK(mesh.try_set_attributes("heat", 2, heat).status() == NM_INVALID_ARGUMENT);
}

void segments_become_edges() {
    const std::vector<double> points{0, 0, 1, 0, 1, 1, 0, 1};
    netmesh::mesh mesh(2, points);
    const std::vector<std::uint32_t> ends{0, 1, 1, 2, 2, 3, 3, 0, 0, 2};
    const std::vector<std::int32_t> markers{1, 2, 3, 4, 5};
    mesh.set_segments(ends, markers);
    nm_region region = NM_REGION_INIT;
    region.label = 7;
    region.seed[0] = 0.75;
    region.seed[1] = 0.25;
    mesh.set_regions(std::vector<nm_region>{region});
    CHECK(mesh.try_segments().status() == NM_STATE);
    mesh.run();
    const auto edges = mesh.segments();
    const auto parents = mesh.segment_parents();
    CHECK(edges.width() == 2 && edges.size() == parents.size() && parents.size() >= 5);
    CHECK(edges[0][0] == 0 && parents.front() == 0 && parents.back() == 4);
    const auto regions = mesh.simplex_regions();
    CHECK(regions.size() == mesh.counts().simplices);
    CHECK(std::count(regions.begin(), regions.end(), 7) > 0);
    CHECK(mesh.try_set_segments(std::vector<std::uint32_t>{0, 1, 2}).status() == NM_INVALID_ARGUMENT);
    CHECK(mesh.try_set_segments(std::vector<std::uint32_t>{0, 9}).status() == NM_INVALID_ARGUMENT);
    region.is_hole = 2;
    CHECK(mesh.try_set_regions(std::vector<nm_region>{region}).status() == NM_INVALID_ARGUMENT);
}

// Many threads ask a mesh that has no index yet.
void threads_share_an_index() {
    const netmesh::mesh mesh = meshed(3, 500);
    const std::vector<double> points = middles(mesh);
    std::vector<std::vector<std::uint32_t>> found(4);
    std::vector<std::thread> threads;
    for (auto& ids : found) {
        threads.emplace_back([&mesh, &points, &ids] { ids = mesh.locate(points); });
    }
    for (std::thread& thread : threads) {
        thread.join();
    }
    for (const auto& ids : found) {
        CHECK(ids == found[0] && ids.size() == mesh.simplices().size());
    }
}

// Faces, and the values of a plain triangulation, whose whole is a ball.
void filtrations_have_values(const std::string& directory) {
    netmesh::mesh mesh(3, generate("uniform", 3, 200).coordinates);
    netmesh::options plain;
    plain.algorithm = NM_ALGORITHM_DELAUNAY;
    mesh.run(plain);
    mesh.make_filtration(NM_FILTRATION_ALPHA, 2);
    CHECK(mesh.filtration_factor(NM_FILTRATION_ALPHA) == 1);
    long euler = 0;
    for (std::uint32_t k = 0; k <= 3; ++k) {
        const auto faces = mesh.faces(k);
        const auto values = mesh.filtration(NM_FILTRATION_ALPHA, k);
        CHECK(faces.width() == k + 1 && values.size() == faces.size());
        euler += (k % 2 == 0 ? 1 : -1) * static_cast<long>(faces.size());
        if (k == 0) {
            continue;
        }
        const auto below = mesh.filtration(NM_FILTRATION_ALPHA, k - 1);
        const auto facets = mesh.face_facets(k);
        const auto cofaces = mesh.cofaces(k - 1);
        for (std::size_t face = 0; face < faces.size(); ++face) {
            for (std::uint32_t facet : facets[face]) {
                CHECK(below[facet] <= values[face]);
                const auto above = cofaces[facet];
                CHECK(std::find(above.begin(), above.end(), face) != above.end());
            }
        }
    }
    CHECK(euler == 1);
    const std::string path = directory + "/queries.filtration";
    mesh.save_filtration(path, NM_FILTRATION_ALPHA);
    std::ifstream file(path);
    const std::istreambuf_iterator<char> first(file), last;
    // A line for each face.
    std::size_t count = 0;
    for (std::uint32_t k = 0; k <= 3; ++k) {
        count += mesh.faces(k).size();
    }
    CHECK(static_cast<std::size_t>(std::count(first, last, '\n')) == count);
    CHECK(std::remove(path.c_str()) == 0);
    const auto nowhere = mesh.try_save_filtration("/no/such/directory/a.dipha", NM_FILTRATION_ALPHA);
    CHECK(!nowhere && nowhere.status() == NM_IO);
    mesh.run();
    CHECK(mesh.filtration(NM_FILTRATION_MESH, 3).size() == mesh.simplices().size());
    const auto refused = mesh.try_filtration(NM_FILTRATION_ALPHA, 1);
    CHECK(!refused && refused.message().find("NM_ALGORITHM_DELAUNAY") != std::string::npos);
}

// With points given twice, inputs and vertices have different numbers: what speaks of inputs has those
// of the caller.
void inputs_have_the_callers_numbers(const std::string& scratch) {
    const std::vector<double> once = generate("uniform", 3, 60).coordinates;
    std::vector<double> points;
    for (std::size_t i = 0; i < once.size(); i += 3) {
        // Every third point is given twice in a row, and the first one again and again.
        const std::size_t copies = i % 9 == 0 ? 2 : 1;
        for (std::size_t copy = 0; copy < copies; ++copy) {
            points.insert(points.end(), once.begin() + i, once.begin() + i + 3);
        }
        points.insert(points.end(), once.begin(), once.begin() + 3);
    }
    netmesh::mesh mesh(3, points);
    netmesh::options plain;
    plain.algorithm = NM_ALGORITHM_DELAUNAY;
    for (const bool is_plain : {true, false}) {
        mesh.run(is_plain ? plain : netmesh::options());
        const std::vector<std::uint32_t> vertices = mesh.input_vertices(), inputs = mesh.vertex_inputs();
        const auto coordinates = mesh.points();
        const auto kinds = mesh.vertex_kinds();
        CHECK(inputs.size() == mesh.counts().vertices && vertices.size() == points.size() / 3);
        for (std::size_t vertex = 0; vertex < inputs.size(); ++vertex) {
            CHECK((inputs[vertex] == NM_NONE) == (kinds[vertex] != NM_VERTEX_INPUT));
            if (inputs[vertex] != NM_NONE) {
                CHECK(vertices[inputs[vertex]] == vertex);
                CHECK(std::equal(coordinates[vertex].begin(), coordinates[vertex].end(),
                                 points.begin() + 3 * inputs[vertex]));
            }
        }
        for (std::size_t input = 0; input < vertices.size(); ++input) {
            const auto first = std::find(vertices.begin(), vertices.end(), vertices[input]);
            CHECK(inputs[vertices[input]] == static_cast<std::size_t>(first - vertices.begin()));
        }
        // Each input is nearest to itself, by the number of the first that equals it.
        const auto near = mesh.nearest_input(points, 2);
        for (std::size_t input = 0; input < vertices.size(); ++input) {
            CHECK(near.inputs[input] == inputs[vertices[input]] && near.distances[input] == 0);
        }
    }
    mesh.run(plain);
    const netmesh::alpha_shape shape(mesh, netmesh::optimal_alpha(mesh));
    // A closed surface of the caller's points: by the divergence theorem it has the shape's volume.
    double volume = 0;
    for (netmesh::span<const std::uint32_t> facet : shape.boundary()) {
        const double *a = &points[3 * facet[0]], *b = &points[3 * facet[1]], *c = &points[3 * facet[2]];
        volume += (a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2])
                   + a[2] * (b[0] * c[1] - b[1] * c[0])) / 6;
    }
    CHECK(std::abs(volume - shape.measures().volume) < 1e-12);
    // A file of the filtration has the same numbers.
    const std::string path = scratch + "/inputs.filtration";
    mesh.save_filtration(path, NM_FILTRATION_ALPHA);
    std::ifstream file(path);
    std::vector<std::uint32_t> named;
    for (std::uint32_t dim = 0, vertex = 0; file >> dim && dim == 0 && file >> vertex;) {
        double value = -1;
        file >> value;
        CHECK(value == 0);
        named.push_back(vertex);
    }
    CHECK(named == mesh.vertex_inputs());
}

// Threads that ask one mesh for arrays of different groups and selections, each several times.
void threads_share_arrays() {
    const netmesh::mesh mesh = meshed(3, 100);
    netmesh::selection hull;
    hull.extent = NM_EXTENT_HULL;
    const auto of = [&mesh](const netmesh::selection& wanted) {
        std::vector<std::vector<std::uint32_t>> arrays;
        for (const auto& facets : {mesh.facets(wanted), mesh.hull(wanted)}) {
            arrays.emplace_back(facets.vertices.flat().begin(), facets.vertices.flat().end());
            arrays.emplace_back(facets.simplices.flat().begin(), facets.simplices.flat().end());
        }
        const auto ridges = mesh.ridge_corners(wanted);
        arrays.emplace_back(ridges.flat().begin(), ridges.flat().end());
        return arrays;
    };
    const auto all = of({}), within = of(hull);
    CHECK(all != within);
    std::vector<std::thread> threads;
    for (int number = 0; number < 4; ++number) {
        threads.emplace_back([&, number] {
            for (int repetition = 0; repetition < 5; ++repetition) {
                const bool is_hull = (number + repetition) % 2 == 0;
                CHECK(of(is_hull ? hull : netmesh::selection{}) == (is_hull ? within : all));
            }
        });
    }
    for (std::thread& thread : threads) {
        thread.join();
    }
}

void failures_are_named() {
    const netmesh::mesh mesh = meshed(2, 20);
    const auto fails = [](const auto& result, nm_status status, const char* word) {
        CHECK(!result && result.status() == status);
        CHECK(result.message().find(word) != std::string::npos);
    };
    const std::vector<double> odd(3), point(2, std::numeric_limits<double>::infinity());
    fails(mesh.try_locate(odd), NM_INVALID_ARGUMENT, "points holds 3");
    fails(mesh.try_locate(point), NM_NON_FINITE, "points[0]");
    fails(mesh.try_interpolate(NM_INTERPOLATION_LINEAR, 1, odd, point), NM_INVALID_ARGUMENT, "values holds 3");
    fails(mesh.try_extend_values(2, odd), NM_INVALID_ARGUMENT, "input_values holds 3");
    netmesh::selection wrong;
    wrong.domain = 1000;
    fails(mesh.try_edges(wrong), NM_INVALID_ARGUMENT, "selection.domain is 1000");
    const netmesh::mesh before(2, generate("uniform", 2, 20).coordinates);
    fails(before.try_hull(), NM_STATE, "nm_run");
    fails(before.try_locate({}), NM_STATE, "nm_run");
}

}  // namespace

int main(int argc, char** argv) {
    if (argc != 2) {
        return 2;
    }
    for (std::uint32_t dim : {2u, 3u, 4u}) {
        middles_are_in_their_simplices(dim);
        arrays_fit_together(dim);
    }
    selections_are_parts(argv[1]);
    attributes_reach_all_vertices(argv[1]);
    segments_become_edges();
    threads_share_an_index();
    filtrations_have_values(argv[1]);
    inputs_have_the_callers_numbers(argv[1]);
    threads_share_arrays();
    failures_are_named();
    return check::result("queries");
}
