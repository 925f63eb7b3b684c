// The point sets of the tests: generated ones, and files of public data where they are at hand.
#ifndef NETMESH_TESTS_INPUTS_HPP
#define NETMESH_TESTS_INPUTS_HPP

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

struct PointSet {
    unsigned dim = 0;
    std::vector<double> coordinates;  // size() x dim
    // No d+1 points on a hyperplane, no d+2 on a sphere, with probability 1.
    bool generic = false;

    std::size_t size() const { return dim == 0 ? 0 : coordinates.size() / dim; }
    const double* point(std::size_t i) const { return coordinates.data() + i * dim; }
};

// name: uniform, gaussian, sphere, grid, collinear, coplanar, duplicates, two_skew_lines.
// Exits with a message for any other name and for coplanar in the plane.
PointSet generate(const std::string& name, unsigned dim, std::size_t n, std::uint64_t seed = 1);

// 256 points in 32 clusters of 8, nested about the origin, with a spread of about 2^log_spread.
PointSet nested_clusters(unsigned dim, int log_spread, std::uint64_t seed);

// A file of the data directory: one point per line, separated by spaces or commas. Nothing when
// the directory or the file is missing; exits with the line's number when a line is not a point.
std::optional<PointSet> read_data_file(const std::string& file_name, unsigned dim);

// Directory in which read_data_file looks: $NETMESH_DATA, else ../shared/data beside the source directory.
std::string data_directory();

#endif
