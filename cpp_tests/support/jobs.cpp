#include "jobs.hpp"

#include <cstdio>

#include "check.hpp"

namespace {

// FNV-1a: short, and every byte counts.
class Hash {
public:
    void bytes(const void* data, std::size_t size) {
        const auto* byte = static_cast<const unsigned char*>(data);
        for (std::size_t i = 0; i < size; ++i) state_ = (state_ ^ byte[i]) * 0x100000001B3u;
    }

    // The length first: what ends one array must not pass for the beginning of the next.
    template <class Item>
    void array(const std::vector<Item>& items) {
        const std::uint64_t size = items.size();
        bytes(&size, sizeof size);
        bytes(items.data(), items.size() * sizeof(Item));
    }

    std::uint64_t value() const { return state_; }

private:
    std::uint64_t state_ = 0xCBF29CE484222325u;
};

// Small enough that all 64 take a second or two.
std::size_t size_in(unsigned dim) { return dim == 2 ? 500 : dim == 3 ? 120 : 40; }

}  // namespace

std::vector<Job> jobs() {
    const char* const inputs[] = {"uniform", "gaussian", "sphere", "grid", "duplicates"};
    std::vector<Job> all;
    for (std::uint64_t seed = 1; all.size() < 64; ++seed) {
        for (unsigned dim = 2; dim <= 4; ++dim) {
            for (const nm_output output : {NM_OUTPUT_HIERARCHICAL, NM_OUTPUT_WELL_SPACED}) {
                if (all.size() == 64) return all;
                // Each dimension and output meets each kind of input, nested clusters (cages in
                // cages) among them.
                const std::size_t kind = all.size() / 6 % 6;
                Job job;
                job.output = output;
                job.seed = seed;
                if (kind < 5) {
                    job.points = generate(inputs[kind], dim, size_in(dim), seed);
                } else {
                    job.points = nested_clusters(dim, dim == 2 ? 64 : 24, seed);
                    job.points.coordinates.resize(size_in(dim) / 2 * dim);
                }
                job.name = std::to_string(dim) + "d " + (kind < 5 ? inputs[kind] : "nested")
                           + (output == NM_OUTPUT_WELL_SPACED ? " well-spaced " : " hierarchical ")
                           + std::to_string(seed);
                all.push_back(std::move(job));
            }
        }
    }
    return all;
}

MeshHandle create_job(const Job& job) { return create(job.points); }

void run_job(const Job& job, nm_mesh* mesh, std::uint32_t threads) {
    nm_options options = default_options();
    options.output = job.output;
    options.seed = job.seed;
    options.threads = threads;
    REQUIRE_OK(nm_run(mesh, &options));
}

std::uint64_t hash_of(const nm_mesh* mesh) {
    const ExportedMesh exported = export_mesh(mesh);
    CHECK(exported.simplex_count() > 0);
    Hash hash;
    hash.array(exported.points);
    hash.array(exported.simplices);
    hash.array(exported.neighbors);
    hash.array(exported.kinds);
    hash.array(exported.vertex_domains);
    hash.array(exported.input_vertices);
    hash.array(exported.domain_radii);
    hash.array(exported.domain_centers);
    hash.array(exported.domain_parents);
    return hash.value();
}

std::uint64_t hash_of(const std::vector<std::uint64_t>& hashes) {
    Hash hash;
    hash.array(hashes);
    return hash.value();
}

std::string hexadecimal(std::uint64_t hash) {
    char text[17];
    std::snprintf(text, sizeof text, "%016llx", static_cast<unsigned long long>(hash));
    return text;
}

std::vector<std::uint64_t> hash_all(const std::vector<Job>& jobs, std::uint32_t threads) {
    std::vector<std::uint64_t> hashes;
    for (const Job& job : jobs) {
        const MeshHandle mesh = create_job(job);
        run_job(job, mesh.get(), threads);
        hashes.push_back(hash_of(mesh.get()));
    }
    return hashes;
}

void check_same(const std::vector<Job>& jobs, const std::vector<std::uint64_t>& hashes,
                const std::vector<std::uint64_t>& expected, const std::string& condition) {
    REQUIRE(hashes.size() == jobs.size() && expected.size() == jobs.size());
    for (std::size_t i = 0; i < jobs.size(); ++i) {
        CHECK_SAYING(hashes[i] == expected[i], jobs[i].name + ", " + condition + ": "
                     + hexadecimal(hashes[i]) + " instead of " + hexadecimal(expected[i]));
    }
}
