// Six points in the plane, two of them close together, and how large their mesh is.
#include "must.hpp"

static void first_mesh() {
    // [first]
    const std::vector<double> points = {0, 0,  1, 0,  0, 1,  1, 1,  0.5, 0.50001,  0.5, 0.50002};
    netmesh::mesh mesh(2, points);
    mesh.run();
    const nm_counts counts = mesh.counts();
    std::cout << counts.inputs << " points, " << counts.vertices << " vertices, "
              << counts.simplices << " triangles\n";
    // [end]
    expect(counts.inputs == 6 && counts.duplicates == 0, "six distinct inputs went in");
    expect(counts.vertices > 6 && counts.simplices > counts.vertices, "Steiner vertices were added");
}

int main() { return run_example(first_mesh); }
