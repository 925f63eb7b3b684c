// Questions to a mesh, and arrays of a selection.
#include "must.hpp"

#include <cmath>
#include <numeric>

int main() {
    const std::vector<double> inputs = uniform_points(1000, 2);
    netmesh::mesh mesh(2, inputs);
    mesh.run();
    const std::vector<double> points = uniform_points(500, 2);

    std::vector<double> heights;
    for (std::size_t i = 0; i < inputs.size(); i += 2) {
        heights.push_back(3 * inputs[i] - inputs[i + 1]);
    }
    // [queries]
    const auto simplices = mesh.locate(points);  // NM_NONE outside
    const auto nearest = mesh.nearest(points);
    const auto values = mesh.extend_values(1, heights);  // from the inputs to all vertices
    const auto found = mesh.interpolate(NM_INTERPOLATION_LINEAR, 1, values.flat(), points);
    // [end]
    for (std::size_t i = 0; i < simplices.size(); ++i) {
        expect(simplices[i] != NM_NONE && nearest.distances[i] < 0.2, "the points are in the mesh");
        expect(std::isfinite(found[i][0]), "there is a value");
    }

    // [arrays]
    for (const auto neighbors : mesh.vertex_neighbors()) {
        expect(neighbors.size() >= 2, "a vertex has an edge to these");
    }
    netmesh::selection inside;
    inside.extent = NM_EXTENT_HULL;
    const auto areas = mesh.volumes(inside);
    // [end]
    const double area = std::accumulate(areas.begin(), areas.end(), 0.0);
    expect(area > 0.5 && area < 1, "what is inside the hull fills most of the unit square");
}
