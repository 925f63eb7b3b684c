/*
 * Files that all ranks write into at once (MPI-IO).
 */
#include "layer.h"

#include <stdlib.h>

#define CHECK(call)                                                                                \
    do {                                                                                           \
        int checked = (call);                                                                      \
        if (checked != MPI_SUCCESS)                                                                \
            return checked;                                                                        \
    } while (0)

typedef struct netmesh_shared_file {
    MPI_File file;
} netmesh_shared_file;

/* Collective: a file that must not be there yet. */
int netmesh_shared_file_create(netmesh_ranks *ranks, const char *path, netmesh_shared_file **created)
{
    netmesh_shared_file *shared = malloc(sizeof *shared);
    int has_memory = shared != NULL, all_have = 0;
    CHECK(MPI_Allreduce(&has_memory, &all_have, 1, MPI_INT, MPI_MIN, ranks->messages));
    if (!all_have) {
        free(shared);
        return MPI_ERR_NO_MEM;
    }
    int status = MPI_File_open(ranks->messages, path, MPI_MODE_CREATE | MPI_MODE_EXCL | MPI_MODE_WRONLY,
                               MPI_INFO_NULL, &shared->file);
    if (status != MPI_SUCCESS) {
        free(shared);
        return status;
    }
    *created = shared;
    return MPI_File_set_errhandler(shared->file, MPI_ERRORS_RETURN);
}

/*
 * Not collective, though MPI has a call that is: where the disk of one rank is full Open MPI's waits in it
 * for ever for that rank. The bytes of a rank are in one piece, from which a collective call gains nothing.
 */
int netmesh_shared_file_write(netmesh_shared_file *shared, uint64_t offset, const void *bytes, uint64_t size,
                              uint64_t chunk)
{
    const char *at = bytes;
    while (size > 0) {
        MPI_Status written;
        int now = (int)(size < chunk ? size : chunk), count = 0;
        CHECK(MPI_File_write_at(shared->file, (MPI_Offset)offset, at, now, MPI_BYTE, &written));
        CHECK(MPI_Get_count(&written, MPI_BYTE, &count));
        if (count != now)
            return MPI_ERR_NO_SPACE;
        at += now;
        offset += (uint64_t)now;
        size -= (uint64_t)now;
    }
    return 0;
}

/* Collective: what was written is on the disk afterwards. */
int netmesh_shared_file_close(netmesh_shared_file *shared)
{
    int synchronised = MPI_File_sync(shared->file);
    int closed = MPI_File_close(&shared->file);
    free(shared);
    return synchronised != MPI_SUCCESS ? synchronised : closed;
}
