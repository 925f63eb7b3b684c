// mesher POINTS MESH: meshes a file of points into another file.
#include <exception>
#include <iostream>

#include <netmesh.hpp>

int main(int argc, char **argv) {
    if (argc != 3) {
        return 2;
    }
    try {
        netmesh::mesh mesh = netmesh::mesh::from_file(argv[1]);
        mesh.run();
        mesh.save(argv[2]);
        const nm_counts counts = mesh.counts();
        std::cout << "netmesh " << netmesh::version() << ": " << counts.inputs << " points, "
                  << counts.vertices << " vertices, " << counts.simplices << " simplices, "
                  << counts.domains << " domains\n";
    } catch (const std::exception &error) {
        std::cerr << error.what() << '\n';
        return 1;
    }
}
