// The point sets of the ratios by name: those of the tests, and clusters.
#ifndef NETMESH_BENCH_CLUSTERS_HPP
#define NETMESH_BENCH_CLUSTERS_HPP

#include <cstddef>
#include <string>

#include "inputs.hpp"

// Normal distributions of 100 points about uniform centres, in turn; their deviation is 2^-6 of the
// centres' typical distance. As gaussian_clusters in experiments/src/inputs.rs.
PointSet clusters(unsigned dim, std::size_t n);

// clusters, or what generate() has by that name.
PointSet ratio_input(const std::string& name, unsigned dim, std::size_t n);

#endif
