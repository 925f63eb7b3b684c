// Meshes particles where they lie in memory, as structs and as floats; nothing is copied for the
// first.
//
//     c++ -std=c++17 -Iinclude examples/cpp/strided_points.cpp -Ltarget/release -lnetmesh

#include <array>
#include <iostream>
#include <random>
#include <vector>

#include "netmesh/strided.hpp"

struct Particle {
    double position[3];
    double velocity[3];
    double mass;
};

int main() {
    std::mt19937 random(1);
    std::vector<Particle> particles(500);
    std::vector<std::array<float, 2>> shadows;
    for (Particle &particle : particles) {
        for (double &x : particle.position) {
            x = static_cast<double>(random()) / 4294967296.0;
        }
        shadows.push_back({static_cast<float>(particle.position[0]), static_cast<float>(particle.position[1])});
    }
    try {
        // [strided]
        const netmesh::strided_points<double> positions{
            &particles[0].position[0], particles.size(), 3, sizeof(Particle) / sizeof(double), 1};
        netmesh::mesh space = netmesh::make_mesh(positions);
        netmesh::mesh plane = netmesh::make_mesh(netmesh::strided(shadows));  // vector<array<float, 2>>
        // [end]
        space.run();
        plane.run();
        std::cout << space.counts().simplices << " tetrahedra, " << plane.counts().simplices << " triangles\n";
    } catch (const netmesh::error &error) {
        std::cerr << error.status_name() << ": " << error.what() << '\n';
        return 1;
    }
}
