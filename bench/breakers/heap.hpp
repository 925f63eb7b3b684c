// The bytes that this process, the libraries it links included, holds through malloc.
#ifndef NETMESH_BREAKERS_HEAP_HPP
#define NETMESH_BREAKERS_HEAP_HPP

#include <cstddef>

namespace heap {

// Bytes held now; the peak counts anew from here.
std::size_t restart();
// The most that was held at a time since then.
std::size_t peak();

}  // namespace heap

#endif
