// netmesh in the place of TetGen: the same objects, the same switches. TetGen is AGPL; its library is
// not needed.
//
//     c++ -std=c++17 -DTETLIBRARY -Iinclude examples/cpp/tetgen_points.cpp -Ltarget/release -lnetmesh

#include <tetgen.h>

#include <iostream>
#include <random>

#include "netmesh/tetgen.hpp"

int main() {
    tetgenio in, out;
    in.numberofpoints = 500;
    in.pointlist = new REAL[3 * 500];
    std::mt19937 random(1);
    for (int i = 0; i < 3 * in.numberofpoints; ++i) {
        in.pointlist[i] = static_cast<double>(random()) / 4294967296.0;
    }
    try {
        // [tetgen]
        netmesh::tetgen::tetrahedralize("q1.5nQ", &in, &out);  // other switches are refused
        // [end]
        std::cout << out.numberofpoints << " points, " << out.numberoftetrahedra << " tetrahedra, "
                  << out.numberoftrifaces << " faces on the hull\n";
        netmesh::tetgen::tetrahedralize("pq", &in, &out);  // facets are no business of netmesh
        return 1;
    } catch (const netmesh::error &error) {
        std::cout << error.status_name() << ": " << error.what() << '\n';
        return error.status() == NM_INVALID_ARGUMENT ? 0 : 1;
    }
}
