// Every function that takes a const mesh, for tests of who may use a mesh when.
#ifndef NETMESH_TESTS_EVERY_GETTER_HPP
#define NETMESH_TESTS_EVERY_GETTER_HPP

#include "netmesh.h"

// Calls all of them on a mesh that was run, beginning with number `first` and going round; each
// must answer `expected`.
void every_getter(const nm_mesh* mesh, nm_status expected, int first);

#endif
