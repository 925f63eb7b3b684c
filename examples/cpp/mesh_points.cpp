// Meshes a few thousand points of very uneven density in 3D and writes the mesh for ParaView:
//
//     c++ -std=c++17 -Iinclude examples/cpp/mesh_points.cpp -Ltarget/release -lnetmesh -o mesh_points
//     ./mesh_points mesh.vtu

#include <cmath>
#include <cstdint>
#include <iostream>
#include <random>
#include <vector>

#include "netmesh.hpp"

// Half of the points are uniform in a cube; half crowd around its middle, ever closer.
static std::vector<double> make_points(int count) {
    std::mt19937_64 random(42);
    auto coordinate = [&random] { return static_cast<double>(random() >> 11) * 0x1p-52 - 1.0; };
    std::vector<double> points;
    for (int i = 0; i < count; ++i) {
        double scale = i % 2 == 0 ? 1.0 : std::pow(10.0, -9.0 * i / count);
        for (int k = 0; k < 3; ++k) {
            points.push_back(scale * coordinate());
        }
    }
    return points;
}

static bool show_progress(const nm_progress &progress) {
    std::cerr << '\r' << static_cast<int>(100 * progress.fraction) << " %, " << progress.vertices
              << " vertices " << std::flush;
    return true;  // false cancels
}

static void print(const netmesh::mesh &mesh) {
    nm_counts counts = mesh.counts();
    nm_quality quality = mesh.quality();
    std::cout << counts.inputs << " points -> " << counts.vertices << " vertices, "
              << counts.simplices << " tetrahedra, " << counts.domains << " domains\n"
              << "worst aspect " << quality.worst_aspect << ", mean " << quality.mean_aspect
              << ", smallest dihedral angle " << quality.min_angle_degrees << " degrees\n";
}

int main(int argc, char **argv) {
    if (argc != 2) {
        std::cerr << "usage: " << argv[0] << " OUTPUT.vtu\n";
        return 2;
    }
    try {
        netmesh::mesh mesh(3, make_points(2000));
        netmesh::options options;
        options.seed = 7;
        options.progress = show_progress;
        mesh.run(options);
        std::cerr << '\n';
        print(mesh);
        nm_report report = mesh.validate();
        std::cout << "certificate: level " << report.level << " of 3, " << report.checked
                  << " checks, " << report.violations << " violations\n";
        if (report.violations > 0) {
            std::cerr << "first violation: " << report.message << '\n';
            return 1;
        }
        mesh.save(argv[1]);
    } catch (const netmesh::error &error) {
        std::cerr << error.status_name() << ": " << error.what() << '\n';
        return 1;
    }
}
