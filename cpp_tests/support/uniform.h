/* For programs in C: the same numbers in every run (Marsaglia, "Xorshift RNGs", 2003). */
#ifndef NETMESH_TESTS_UNIFORM_H
#define NETMESH_TESTS_UNIFORM_H

#include <stdint.h>

/* The next number, uniform in [0, 1). */
static double uniform(void) {
  static uint64_t state = 88172645463325252u;
  state ^= state << 13;
  state ^= state >> 7;
  state ^= state << 17;
  return (double)(state >> 11) / 9007199254740992.0;
}

#endif
