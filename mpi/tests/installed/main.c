/* ranks POINTS MESH: meshes the points of a file in the plane, which rank 0 reads, on all ranks. */
#include <inttypes.h>
#include <stdio.h>

#include <netmesh_mpi.h>

enum { LIMIT = 1000 };

static uint64_t read_numbers(const char *path, double *numbers)
{
    FILE *file = fopen(path, "r");
    uint64_t count = 0;
    if (file == NULL)
        return 0;
    while (count < LIMIT && fscanf(file, "%lf", &numbers[count]) == 1)
        ++count;
    fclose(file);
    return count;
}

int main(int argc, char **argv)
{
    double numbers[LIMIT];
    uint64_t count = 0;
    int rank;
    nm_mpi_mesh *mesh = NULL;
    nm_mpi_counts counts = NM_MPI_COUNTS_INIT;
    MPI_Init(&argc, &argv);
    MPI_Comm_rank(MPI_COMM_WORLD, &rank);
    if (rank == 0 && argc == 3)
        count = read_numbers(argv[1], numbers) / 2;
    nm_status status = nm_mpi_run(MPI_COMM_WORLD, 2, count, numbers, NULL, &mesh);
    if (status == NM_OK)
        status = nm_mpi_get_counts(mesh, &counts);
    if (status == NM_OK)
        status = nm_mpi_export(mesh, argv[2], NM_MPI_FORMAT_AUTO);
    if (rank == 0 && status == NM_OK)
        printf("netmesh %s: %" PRIu64 " vertices\n", nm_version(), counts.vertices);
    if (rank == 0 && status != NM_OK) {
        char message[256];
        nm_mpi_last_error(message, sizeof message);
        fprintf(stderr, "%s\n", message);
    }
    nm_mpi_mesh_free(mesh);
    MPI_Finalize();
    return status != NM_OK;
}
