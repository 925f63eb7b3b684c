// Matrices of Eigen in and out: the total volume of the tetrahedra of a mesh.
//
//     c++ -std=c++17 -Iinclude -I/usr/include/eigen3 examples/cpp/eigen_matrices.cpp -Ltarget/release -lnetmesh

#include <Eigen/Dense>
#include <iostream>

#include "netmesh/eigen.hpp"

int main() {
    const Eigen::MatrixXd points = Eigen::MatrixXd::Random(500, 3);  // one point a row
    try {
        // [eigen]
        netmesh::mesh mesh = netmesh::eigen::mesh_of_rows(points);  // n x dim; Ref and Map too
        mesh.run();
        const Eigen::MatrixXd vertices = netmesh::eigen::points_in_rows(mesh);
        const Eigen::MatrixXi tetrahedra = netmesh::eigen::simplices_in_rows<int>(mesh);
        // [end]
        double volume = 0;
        for (Eigen::Index t = 0; t < tetrahedra.rows(); ++t) {
            Eigen::Matrix3d edges;
            for (int k = 0; k < 3; ++k) {
                edges.row(k) = vertices.row(tetrahedra(t, k + 1)) - vertices.row(tetrahedra(t, 0));
            }
            volume += edges.determinant() / 6;
        }
        std::cout << vertices.rows() << " vertices, " << tetrahedra.rows() << " tetrahedra, volume " << volume << '\n';
        return volume > 8 ? 0 : 1;  // the points fill a cube of that volume
    } catch (const netmesh::error &error) {
        std::cerr << error.status_name() << ": " << error.what() << '\n';
        return 1;
    }
}
