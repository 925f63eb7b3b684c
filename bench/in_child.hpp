// Work in a child process: it starts from the same memory every time, and may crash or hang.
#ifndef NETMESH_BENCH_IN_CHILD_HPP
#define NETMESH_BENCH_IN_CHILD_HPP

#include <cstddef>
#include <functional>
#include <string>

// Runs the work in a child that lives for at most that many seconds (0: for as long as it likes) and
// answers what became of it: nothing where the work ended well, otherwise a few words. The work
// returns its exit code, 1 where it throws; what it leaves behind for the parent has to be in shared_bytes.
std::string in_child(unsigned most_seconds, const std::function<int()>& work);

// Zeroed memory that parent and children share, for as long as the process lives.
void* shared_bytes(std::size_t size);

template <class Data>
Data& shared() {
    return *static_cast<Data*>(shared_bytes(sizeof(Data)));
}

#endif
