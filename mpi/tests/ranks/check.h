/*
 * What the programs of the tests share: every failure ends the job, and says where.
 */
#ifndef NETMESH_MPI_TESTS_CHECK_H
#define NETMESH_MPI_TESTS_CHECK_H

#include "netmesh_mpi.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define CHECK(condition)                                                                           \
    do {                                                                                           \
        if (!(condition)) {                                                                        \
            char last_message[512];                                                                \
            nm_mpi_last_error(last_message, sizeof last_message);                                  \
            fprintf(stderr, "%s:%d: %s does not hold; last message: %s\n", __FILE__, __LINE__,     \
                    #condition, last_message);                                                     \
            MPI_Abort(MPI_COMM_WORLD, 1);                                                          \
        }                                                                                          \
    } while (0)

/* The points of a test, equal on all ranks, and which of them are this one's. */
typedef struct cloud {
    uint32_t dim;
    uint64_t count;
    double *points;
    uint64_t first;
    uint64_t local;
} cloud;

/*
 * shape: uniform, clusters, nested, sphere, lattice, duplicates, or a path with a / in it, of a file with a
 * line for each point. shares: even (blocks of one size), first,
 * last (all points on that rank), odd (none on ranks 0, 2, ...), uneven.
 */
cloud make_cloud(const char *shape, uint32_t dim, uint64_t count, const char *shares);

#endif
