/*
 * What Rust calls of MPI. MPI_Comm, MPI_Datatype and the constants are known to mpi.h alone, and differ
 * from one MPI to another: they stay on this side. Every function answers 0, or MPI's error code.
 */
#ifndef NETMESH_MPI_LAYER_H
#define NETMESH_MPI_LAYER_H

#include <mpi.h>
#include <stdint.h>

/* Ranks that talk apart from the caller's own messages. */
typedef struct netmesh_ranks {
    MPI_Comm messages;
    /* Where a rank that has failed tells those that wait for a message. */
    MPI_Comm notices;
    int rank;
    int size;
} netmesh_ranks;

#endif
