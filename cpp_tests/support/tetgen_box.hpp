// TetGen as a peer: the points in a box, refined to a radius-edge bound.
#ifndef NETMESH_TESTS_TETGEN_BOX_HPP
#define NETMESH_TESTS_TETGEN_BOX_HPP

#include <cstdint>
#include <string>
#include <vector>

#include "inputs.hpp"

struct TetgenResult {
    std::vector<double> points;
    std::vector<std::uint32_t> tetrahedra;
    double seconds = 0.0;
    int error = 0;  // what TetGen threw, 0 for nothing
};

// The box has three times the size of the points' bounding box and the same centre; its six faces
// are the constraints, the points lie free inside.
TetgenResult tetgen_in_box(const PointSet& points, const std::string& switches);

#endif
