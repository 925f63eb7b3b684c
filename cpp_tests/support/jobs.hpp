// The 64 small meshes whose bytes must not depend on anything but input and options.
#ifndef NETMESH_TESTS_JOBS_HPP
#define NETMESH_TESTS_JOBS_HPP

#include <cstdint>
#include <string>
#include <vector>

#include "inputs.hpp"
#include "mesh.hpp"

struct Job {
    std::string name;
    PointSet points;
    nm_output output = NM_OUTPUT_HIERARCHICAL;
    std::uint64_t seed = 0;
};

// Dimensions 2, 3 and 4, both outputs, inputs of every kind, 64 different ones.
std::vector<Job> jobs();

// Meshes the job's points; a fresh mesh each time.
MeshHandle create_job(const Job& job);
void run_job(const Job& job, nm_mesh* mesh, std::uint32_t threads = 1);

// Over every array of the mesh, in bytes: points, simplices, neighbors, kinds, labels, domains.
std::uint64_t hash_of(const nm_mesh* mesh);

// One number for all.
std::uint64_t hash_of(const std::vector<std::uint64_t>& hashes);

std::string hexadecimal(std::uint64_t hash);

// One after the other, on this thread.
std::vector<std::uint64_t> hash_all(const std::vector<Job>& jobs, std::uint32_t threads = 1);

// Says which meshes differ.
void check_same(const std::vector<Job>& jobs, const std::vector<std::uint64_t>& hashes,
                const std::vector<std::uint64_t>& expected, const std::string& condition);

#endif
