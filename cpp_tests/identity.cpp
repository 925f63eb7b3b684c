// A mesh is a function of its input and options alone: its bytes are the same whatever the option
// `threads`, whatever lies in fresh memory, and in another process with another allocator and
// other addresses.
//
//   identity            all of it
//   identity --hashes   what the other processes run: prints the hash of each mesh
#ifdef __linux__
#include <malloc.h>
#endif

#include <cstdio>
#include <cstdlib>
#include <iostream>
#include <set>
#include <string>
#include <vector>

#include "check.hpp"
#include "jobs.hpp"

namespace {

struct Printed {
    std::string layout;  // where the process has its heap and its stack
    std::vector<std::uint64_t> hashes;
};

int print_hashes() {
    const int on_stack = 0;
    void* const on_heap = std::malloc(1);
    std::printf("%p %p\n", on_heap, static_cast<const void*>(&on_stack));
    std::free(on_heap);
    for (const std::uint64_t hash : hash_all(jobs())) std::printf("%s\n", hexadecimal(hash).c_str());
    return check::failed == 0 ? 0 : 1;
}

// This program once more, with `environment` before its name.
Printed other_process(const std::string& program, const std::string& environment) {
    const std::string command = environment + " '" + program + "' --hashes";
    Printed printed;
    FILE* const pipe = popen(command.c_str(), "r");
    REQUIRE(pipe != nullptr);
    char line[256];
    while (std::fgets(line, sizeof line, pipe) != nullptr) {
        if (printed.layout.empty()) {
            printed.layout = line;
        } else {
            printed.hashes.push_back(std::strtoull(line, nullptr, 16));
        }
    }
    CHECK_SAYING(pclose(pipe) == 0, command);
    return printed;
}

void other_processes(const std::string& program, const std::vector<Job>& all,
                     const std::vector<std::uint64_t>& expected) {
    const char* const environments[] = {
        "",
        "MALLOC_PERTURB_=165",
        // No caches, one arena, and every larger array a mapping of its own.
        "MALLOC_PERTURB_=90 MALLOC_ARENA_MAX=1 MALLOC_TOP_PAD_=1 MALLOC_MMAP_THRESHOLD_=4096"
        " GLIBC_TUNABLES=glibc.malloc.tcache_count=0",
    };
    std::set<std::string> layouts;
    for (const char* environment : environments) {
        const Printed printed = other_process(program, environment);
        check_same(all, printed.hashes, expected, std::string("a process with '") + environment + "'");
        layouts.insert(printed.layout);
        std::cout << hexadecimal(hash_of(printed.hashes)) << "  another process: " << environment << "\n";
    }
    // This tests less if addresses are not randomised, which is not the library's fault.
    std::cout << layouts.size() << " different address layouts\n";
}

}  // namespace

int main(int count, char** arguments) {
    if (count == 2 && std::string(arguments[1]) == "--hashes") return print_hashes();
    const std::vector<Job> all = jobs();
    const std::vector<std::uint64_t> expected = hash_all(all);
    // A hash that is always the same would agree with itself.
    CHECK(std::set<std::uint64_t>(expected.begin(), expected.end()).size() > all.size() / 2);
    std::cout << hexadecimal(hash_of(expected)) << "  " << all.size() << " meshes, one after the other\n";

    for (const std::uint32_t threads : {0u, 2u, 16u}) {
        const std::vector<std::uint64_t> hashes = hash_all(all, threads);
        check_same(all, hashes, expected, "threads = " + std::to_string(threads));
        std::cout << hexadecimal(hash_of(hashes)) << "  threads = " << threads << "\n";
    }

    other_processes(arguments[0], all, expected);

#ifdef M_PERTURB
    // Last, since it stays: fresh memory is no longer what the system handed out, freed memory is
    // overwritten at once.
    for (const int pattern : {0x5A, 0xFF}) {
        mallopt(M_PERTURB, pattern);
        const std::vector<std::uint64_t> hashes = hash_all(all);
        check_same(all, hashes, expected, "memory filled with " + std::to_string(pattern));
        std::cout << hexadecimal(hash_of(hashes)) << "  memory filled with " << pattern << "\n";
    }
#endif
    return check::result("identity");
}
