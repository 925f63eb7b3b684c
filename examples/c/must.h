/* What the small examples share: whatever goes wrong ends the program with a reason and with 1. */
#ifndef NETMESH_EXAMPLES_MUST_H
#define NETMESH_EXAMPLES_MUST_H

#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>

#include "netmesh.h"

/* [must] */
static inline void must(nm_status status)
{
    if (status != NM_OK) {
        char message[512];
        nm_last_error(message, sizeof message);
        fprintf(stderr, "%s: %s\n", nm_status_name(status), message);
        exit(1);
    }
}
/* [end] */

static inline void expect(int holds, const char *what)
{
    if (!holds) {
        fprintf(stderr, "this does not hold: %s\n", what);
        exit(1);
    }
}

/* count * dim numbers in [0, 1), always the same ones; NULL does not come back. */
static inline double *uniform_points(size_t count, size_t dim)
{
    uint64_t state = 42;
    double *points = malloc(count * dim * sizeof *points);
    expect(points != NULL, "there is memory for the points");
    for (size_t i = 0; i < count * dim; ++i) {
        state = state * 6364136223846793005u + 1442695040888963407u;
        points[i] = (double)(state >> 11) / 9007199254740992.0;
    }
    return points;
}

#endif
