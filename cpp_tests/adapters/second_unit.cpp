// The header under test in a second translation unit, and twice: what it defines must be inline.
#include NETMESH_TESTED_HEADER
#include NETMESH_TESTED_HEADER
