/*
 * MPI as Rust sees it: communicators behind a pointer, counts of 64 bits, waits that end when another
 * rank has failed. Sizes beyond what an int can say go in pieces of at most `chunk` bytes.
 */
/* For clock_gettime. */
#define _POSIX_C_SOURCE 200112L

#include "layer.h"

#include <limits.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

/* The answer of a wait that a failure of another rank has ended; no error code of MPI is negative. */
#define INTERRUPTED (-1)
#define NO_MEMORY (-2)
#define NOT_RUNNING (-3)

#define CHECK(call)                                                                                \
    do {                                                                                           \
        int checked = (call);                                                                      \
        if (checked != MPI_SUCCESS)                                                                \
            return checked;                                                                        \
    } while (0)

static int smaller(uint64_t size, uint64_t chunk)
{
    return (int)(size < chunk ? size : chunk);
}

/* Fails alike on all ranks, or leaves the process to MPI's own error handler before it. */
int netmesh_ranks_open(const MPI_Comm *of, netmesh_ranks **opened)
{
    int is_running = 0, is_over = 0, is_between_groups = 0;
    CHECK(MPI_Initialized(&is_running));
    CHECK(MPI_Finalized(&is_over));
    if (!is_running || is_over)
        return NOT_RUNNING;
    if (*of == MPI_COMM_NULL)
        return MPI_ERR_COMM;
    CHECK(MPI_Comm_test_inter(*of, &is_between_groups));
    if (is_between_groups)
        return MPI_ERR_COMM;
    netmesh_ranks *ranks = malloc(sizeof *ranks);
    int has_memory = ranks != NULL, all_have = 0;
    MPI_Comm messages;
    /* Collective before anything can fail on one rank only. */
    int status = MPI_Comm_dup(*of, &messages);
    if (status != MPI_SUCCESS) {
        free(ranks);
        return status;
    }
    MPI_Comm_set_errhandler(messages, MPI_ERRORS_RETURN);
    status = MPI_Allreduce(&has_memory, &all_have, 1, MPI_INT, MPI_MIN, messages);
    if (status != MPI_SUCCESS || !all_have) {
        MPI_Comm_free(&messages);
        free(ranks);
        return status != MPI_SUCCESS ? status : NO_MEMORY;
    }
    ranks->messages = messages;
    status = MPI_Comm_dup(messages, &ranks->notices);
    if (status != MPI_SUCCESS) {
        MPI_Comm_free(&ranks->messages);
        free(ranks);
        return status;
    }
    MPI_Comm_set_errhandler(ranks->notices, MPI_ERRORS_RETURN);
    MPI_Comm_rank(messages, &ranks->rank);
    MPI_Comm_size(messages, &ranks->size);
    *opened = ranks;
    return 0;
}

int netmesh_ranks_open_world(netmesh_ranks **opened)
{
    MPI_Comm world = MPI_COMM_WORLD;
    return netmesh_ranks_open(&world, opened);
}

static int has_notice(netmesh_ranks *ranks)
{
    int found = 0;
    MPI_Iprobe(MPI_ANY_SOURCE, MPI_ANY_TAG, ranks->notices, &found, MPI_STATUS_IGNORE);
    return found;
}

/* Collective. After MPI_Finalize nothing is left to be freed but the memory. */
void netmesh_ranks_close(netmesh_ranks *ranks)
{
    int is_over = 0;
    if (ranks == NULL)
        return;
    if (MPI_Finalized(&is_over) == MPI_SUCCESS && !is_over) {
        while (has_notice(ranks))
            MPI_Recv(NULL, 0, MPI_BYTE, MPI_ANY_SOURCE, MPI_ANY_TAG, ranks->notices, MPI_STATUS_IGNORE);
        MPI_Comm_free(&ranks->notices);
        MPI_Comm_free(&ranks->messages);
    }
    free(ranks);
}

int netmesh_ranks_rank(const netmesh_ranks *ranks)
{
    return ranks->rank;
}

int netmesh_ranks_size(const netmesh_ranks *ranks)
{
    return ranks->size;
}

/* What an error code means, at most `capacity` bytes with the NUL. */
void netmesh_ranks_error(int code, char *text, int capacity)
{
    char full[MPI_MAX_ERROR_STRING + 1] = "unknown error";
    int length = 0;
    if (code == NO_MEMORY)
        strcpy(full, "no memory on some rank");
    else if (code == NOT_RUNNING)
        strcpy(full, "MPI is not running: MPI_Init comes first, MPI_Finalize last");
    else if (code > 0)
        MPI_Error_string(code, full, &length);
    strncpy(text, full, (size_t)capacity - 1);
    text[capacity - 1] = '\0';
}

static MPI_Op operation_of(int operation)
{
    return operation == 0 ? MPI_MIN : operation == 1 ? MPI_MAX : MPI_SUM;
}

int netmesh_ranks_reduce(netmesh_ranks *ranks, void *values, uint64_t count, int are_doubles, int operation)
{
    MPI_Datatype type = are_doubles ? MPI_DOUBLE : MPI_UINT64_T;
    char *at = values;
    while (count > 0) {
        int now = smaller(count, 1 << 24);
        CHECK(MPI_Allreduce(MPI_IN_PLACE, at, now, type, operation_of(operation), ranks->messages));
        at += 8 * (size_t)now;
        count -= (uint64_t)now;
    }
    return 0;
}

int netmesh_ranks_broadcast(netmesh_ranks *ranks, int root, void *bytes, uint64_t size)
{
    return MPI_Bcast(bytes, (int)size, MPI_BYTE, root, ranks->messages);
}

int netmesh_ranks_gather_integers(netmesh_ranks *ranks, uint64_t value, uint64_t *values)
{
    return MPI_Allgather(&value, 1, MPI_UINT64_T, values, 1, MPI_UINT64_T, ranks->messages);
}

int netmesh_ranks_exchange_integers(netmesh_ranks *ranks, const uint64_t *values, uint64_t *received)
{
    return MPI_Alltoall(values, 1, MPI_UINT64_T, received, 1, MPI_UINT64_T, ranks->messages);
}

/* Every rank's bytes to all, from one rank after another: no second copy of them all is needed. */
int netmesh_ranks_gather(netmesh_ranks *ranks, const void *bytes, void **gathered, const uint64_t *sizes,
                         uint64_t chunk)
{
    memcpy(gathered[ranks->rank], bytes, (size_t)sizes[ranks->rank]);
    for (int root = 0; root < ranks->size; root++) {
        char *at = gathered[root];
        for (uint64_t left = sizes[root]; left > 0;) {
            int now = smaller(left, chunk);
            CHECK(MPI_Bcast(at, now, MPI_BYTE, root, ranks->messages));
            at += now;
            left -= (uint64_t)now;
        }
    }
    return 0;
}

/* To the rank `step` further on while that `step` back sends here, step by step. */
int netmesh_ranks_exchange(netmesh_ranks *ranks, const void *const *messages, const uint64_t *sizes,
                           void **received, const uint64_t *received_sizes, uint64_t chunk)
{
    for (int step = 1; step < ranks->size; step++) {
        int to = (ranks->rank + step) % ranks->size;
        int from = (ranks->rank - step + ranks->size) % ranks->size;
        const char *out = messages[to];
        char *in = received[from];
        uint64_t out_left = sizes[to], in_left = received_sizes[from];
        while (out_left > 0 || in_left > 0) {
            int out_now = smaller(out_left, chunk), in_now = smaller(in_left, chunk), count = 0;
            MPI_Request requests[2];
            if (in_now > 0)
                CHECK(MPI_Irecv(in, in_now, MPI_BYTE, from, 0, ranks->messages, &requests[count++]));
            if (out_now > 0)
                CHECK(MPI_Isend(out, out_now, MPI_BYTE, to, 0, ranks->messages, &requests[count++]));
            CHECK(MPI_Waitall(count, requests, MPI_STATUSES_IGNORE));
            out += out_now;
            in += in_now;
            out_left -= (uint64_t)out_now;
            in_left -= (uint64_t)in_now;
        }
    }
    return 0;
}

/*
 * Waits for a request, or for the notice that a rank has failed. A message that was not taken by then
 * will never be: its receiver is at a checkpoint.
 */
static int wait_for(netmesh_ranks *ranks, MPI_Request *request, int is_receive)
{
    for (int done = 0; !done;) {
        CHECK(MPI_Test(request, &done, MPI_STATUS_IGNORE));
        if (!done && has_notice(ranks)) {
            if (is_receive) {
                MPI_Status status;
                int was_cancelled = 0;
                CHECK(MPI_Cancel(request));
                CHECK(MPI_Wait(request, &status));
                CHECK(MPI_Test_cancelled(&status, &was_cancelled));
                if (!was_cancelled)
                    return 0;
            } else {
                CHECK(MPI_Request_free(request));
            }
            return INTERRUPTED;
        }
    }
    return 0;
}

/* Tag 0 is that of the exchanges. */
static int tag_of(int tag)
{
    return tag + 1;
}

int netmesh_ranks_send(netmesh_ranks *ranks, int to, int tag, const void *bytes, uint64_t size, uint64_t chunk)
{
    MPI_Request request;
    const char *at = bytes;
    CHECK(MPI_Send(&size, 1, MPI_UINT64_T, to, tag_of(tag), ranks->messages));
    while (size > 0) {
        int now = smaller(size, chunk);
        CHECK(MPI_Isend(at, now, MPI_BYTE, to, tag_of(tag), ranks->messages, &request));
        CHECK(wait_for(ranks, &request, 0));
        at += now;
        size -= (uint64_t)now;
    }
    return 0;
}

/* The size of the message that netmesh_ranks_receive takes next. */
int netmesh_ranks_receive_size(netmesh_ranks *ranks, int from, int tag, uint64_t *size)
{
    MPI_Request request;
    CHECK(MPI_Irecv(size, 1, MPI_UINT64_T, from, tag_of(tag), ranks->messages, &request));
    return wait_for(ranks, &request, 1);
}

int netmesh_ranks_receive(netmesh_ranks *ranks, int from, int tag, void *bytes, uint64_t size, uint64_t chunk)
{
    MPI_Request request;
    char *at = bytes;
    while (size > 0) {
        int now = smaller(size, chunk);
        CHECK(MPI_Irecv(at, now, MPI_BYTE, from, tag_of(tag), ranks->messages, &request));
        CHECK(wait_for(ranks, &request, 1));
        at += now;
        size -= (uint64_t)now;
    }
    return 0;
}

void netmesh_ranks_notify(netmesh_ranks *ranks)
{
    for (int rank = 0; rank < ranks->size; rank++) {
        MPI_Request request;
        if (rank != ranks->rank &&
            MPI_Isend(NULL, 0, MPI_BYTE, rank, 0, ranks->notices, &request) == MPI_SUCCESS)
            MPI_Request_free(&request);
    }
}

/* The processor time of the calling thread. */
double netmesh_processor_seconds(void)
{
    struct timespec time = {0, 0};
    (void)clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
    return (double)time.tv_sec + 1e-9 * (double)time.tv_nsec;
}

/* For the program: begins MPI, and ends it. */
int netmesh_mpi_begin(void)
{
    int provided = 0;
    return MPI_Init_thread(NULL, NULL, MPI_THREAD_FUNNELED, &provided);
}

int netmesh_mpi_end(void)
{
    return MPI_Finalize();
}
