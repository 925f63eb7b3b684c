// Takes the place of malloc and its kin for the whole process and passes on to the C library's own,
// which goes by these names in glibc. Resident memory alone is too coarse for small meshes.
#include "heap.hpp"

#include <malloc.h>

#include <atomic>
#include <cerrno>

extern "C" {
void* __libc_malloc(std::size_t size);
void* __libc_calloc(std::size_t count, std::size_t size);
void* __libc_realloc(void* block, std::size_t size);
void* __libc_memalign(std::size_t alignment, std::size_t size);
void __libc_free(void* block);
}

namespace {

std::atomic<std::size_t> held{0};
std::atomic<std::size_t> most{0};

void* taken(void* block) {
    if (block != nullptr) {
        const std::size_t now = held += malloc_usable_size(block);
        std::size_t before = most;
        while (before < now && !most.compare_exchange_weak(before, now)) {
        }
    }
    return block;
}

}  // namespace

namespace heap {

std::size_t restart() {
    most = held.load();
    return held;
}

std::size_t peak() { return most; }

}  // namespace heap

extern "C" {

void* malloc(std::size_t size) { return taken(__libc_malloc(size)); }

void* calloc(std::size_t count, std::size_t size) { return taken(__libc_calloc(count, size)); }

void* realloc(void* block, std::size_t size) {
    const std::size_t before = block == nullptr ? 0 : malloc_usable_size(block);
    void* moved = __libc_realloc(block, size);
    if (moved != nullptr || size == 0) held -= before;
    return taken(moved);
}

void* memalign(std::size_t alignment, std::size_t size) { return taken(__libc_memalign(alignment, size)); }

void* aligned_alloc(std::size_t alignment, std::size_t size) { return memalign(alignment, size); }

int posix_memalign(void** block, std::size_t alignment, std::size_t size) {
    *block = memalign(alignment, size);
    return *block == nullptr ? ENOMEM : 0;
}

void free(void* block) {
    if (block != nullptr) held -= malloc_usable_size(block);
    __libc_free(block);
}

}
