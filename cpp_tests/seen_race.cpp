// A race on purpose, for the thread sanitizer: two threads have the library fill one buffer. What the
// sanitizer is to find in the library it must be able to see; ctest expects its report.
#include <iostream>
#include <thread>
#include <vector>

#include "check.hpp"
#include "mesh.hpp"

int main() {
    const MeshHandle mesh = create(generate("uniform", 2, 100));
    std::vector<double> points(200);
    const auto fill = [&] {
        for (int repetition = 0; repetition < 1000; ++repetition) {
            REQUIRE_OK(nm_mesh_get_points(mesh.get(), points.data(), points.size(), nullptr));
        }
    };
    std::thread other(fill);
    fill();
    other.join();
    std::cout << "nobody saw the race" << std::endl;
    return 0;
}
