// mesher POINTS MESH: reads two columns of numbers itself and writes their mesh.
#include <cstddef>
#include <fstream>
#include <iostream>
#include <iterator>
#include <vector>

#include "netmesh.hpp"

static_assert(NM_VERSION_MAJOR >= 0 && NM_ABI_VERSION >= 1, "the header tells its version");

int main(int argc, char **argv) {
    if (argc != 3) {
        return 2;
    }
    std::ifstream file(argv[1]);
    const std::vector<double> points{std::istream_iterator<double>(file), {}};
    netmesh::mesh mesh(2, points);
    netmesh::options options;
    options.threads = 1;
    mesh.run(options);
    mesh.save(argv[2]);
    const std::size_t vertices = mesh.points().size();
    const std::size_t simplices = mesh.simplices().size();
    std::cout << "netmesh " << netmesh::version() << ": " << points.size() / 2 << " points, " << vertices
              << " vertices, " << simplices << " simplices, " << mesh.counts().domains << " domains\n";
}
