// Turns of nm_run and of CGAL's plain Delaunay triangulation of its vertices in one process.
#ifndef NETMESH_BENCH_CGAL_TURNS_HPP
#define NETMESH_BENCH_CGAL_TURNS_HPP

#include <cstddef>
#include <string>
#include <vector>

#include "netmesh.h"

struct Medians {
    std::string distribution;
    unsigned dim = 0;
    std::size_t n = 0;
    std::size_t vertices = 0;
    double ours = 0.0;
    double theirs = 0.0;
    double ratio = 0.0;
};

// Prints the turns, and answers with their medians. `options` may be null.
Medians compare_with_cgal(unsigned dim, std::size_t n, int turns, const std::string& distribution,
                          const nm_options* options);

// Prints a line for each comparison.
void print_medians(const std::vector<Medians>& all);

// Compares by the arguments of a program, <dim> <n> <turns> [distribution]; answers with its exit code.
int compare_by_arguments(int count, char** arguments, const char* program, const nm_options* options);

#endif
