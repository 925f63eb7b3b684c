// Facets in space: a box with a wall in it, and a surface that crosses itself.
#include "must.hpp"

#include <cmath>

int main() {
    return run_example([] {
        // [facets]
        const std::vector<double> points = {0, 0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1,   // x = 0
                                            1, 0, 0, 1, 1, 0, 1, 1, 1, 1, 0, 1,   // x = 1
                                            2, 0, 0, 2, 1, 0, 2, 1, 1, 2, 0, 1};  // x = 2
        netmesh::mesh mesh(3, points);
        mesh.set_facets({{0, 3, 2, 1}, {8, 9, 10, 11}, {4, 5, 6, 7},
                         {0, 4, 8, 11, 7, 3}, {1, 2, 6, 10, 9, 5},
                         {0, 1, 5, 9, 8, 4}, {2, 3, 7, 11, 10, 6}});
        nm_region left = NM_REGION_INIT, right = NM_REGION_INIT;
        for (double &x : left.seed) x = 0.5;
        for (double &x : right.seed) x = 0.5;
        right.seed[0] = 1.5;
        left.label = 1;
        right.label = 2;
        const std::vector<nm_region> regions = {left, right};
        mesh.set_regions(regions);
        mesh.run();
        const auto triangles = mesh.facet_triangles();  // three vertices each
        const auto parents = mesh.facet_parents();      // the facet of each
        const auto labels = mesh.simplex_regions();
        // [end]
        double volumes[3] = {}, wall = 0;
        const auto all = mesh.volumes();
        for (std::size_t i = 0; i < labels.size(); ++i) {
            volumes[labels[i]] += all[i];
        }
        expect(std::abs(volumes[1] - 1) < 1e-12 && std::abs(volumes[2] - 1) < 1e-12,
               "each half has its label");
        const auto vertices = mesh.points();
        for (std::size_t i = 0; i < triangles.size(); ++i) {
            if (parents[i] != 2) continue;
            const auto a = vertices[triangles[i][0]], b = vertices[triangles[i][1]],
                       c = vertices[triangles[i][2]];
            wall += ((b[1] - a[1]) * (c[2] - a[2]) - (c[1] - a[1]) * (b[2] - a[2])) / 2;
        }
        expect(std::abs(wall - 1) < 1e-12, "triangles cover the wall");

        // [intersections]
        netmesh::mesh crossed(3, points);
        const std::vector<std::uint32_t> corners = {0, 10, 1, 4, 5, 6};
        crossed.set_triangles(corners);
        for (const nm_intersection &pair : crossed.intersections()) {
            std::cout << "triangles " << pair.first << " and " << pair.second << " meet at ("
                      << pair.point[0] << ", " << pair.point[1] << ", " << pair.point[2] << ")\n";
        }
        // [end]
        expect(crossed.intersections().size() == 1, "they cross");
    });
}
