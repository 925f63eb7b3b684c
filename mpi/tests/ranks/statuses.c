/*
 * Statuses are collective: what one rank has wrong is the same status and message on all, and nobody
 * waits for ever.
 *
 *     statuses DIRECTORY
 *
 * DIRECTORY/full, if it is there, has no room for what is written.
 */
#include "check.h"

#include <math.h>
#include <sys/stat.h>

static int rank, ranks;

/* All ranks must have this status, and a message with these words. */
static void expect_same(nm_status status, nm_status expected, const char *words)
{
    char message[512] = "", first[512];
    nm_mpi_last_error(message, sizeof message);
    if (status != expected || strstr(message, words) == NULL) {
        fprintf(stderr, "rank %d: status %d, %d expected; \"%s\" has no \"%s\"\n", rank, (int)status,
                (int)expected, message, words);
        MPI_Abort(MPI_COMM_WORLD, 1);
    }
    memcpy(first, message, sizeof first);
    MPI_Bcast(first, sizeof first, MPI_CHAR, 0, MPI_COMM_WORLD);
    CHECK(strcmp(first, message) == 0);
}

static int cancel(const nm_progress *progress, void *user_data)
{
    (void)progress;
    (void)user_data;
    return 1;
}

static nm_status run(const cloud *points, const double *own, const nm_options *options)
{
    nm_mpi_mesh *mesh = NULL;
    nm_status status = nm_mpi_run(MPI_COMM_WORLD, points->dim, points->local, own, options, &mesh);
    CHECK(status == NM_OK || mesh == NULL);
    if (mesh != NULL)
        nm_mpi_mesh_free(mesh);
    return status;
}

static void bad_arguments(const cloud *points, double *own)
{
    nm_options options;
    int last = ranks - 1, is_last = rank == last;
    char words[128];
    double kept = own[1];
    if (is_last)
        own[1] = NAN;
    snprintf(words, sizeof words, ranks > 1 ? "points[0] has a non-finite coordinate 1: NaN; every coordinate "
                                              "must be finite (rank %d)" : "points[0]", last);
    expect_same(run(points, own, NULL), NM_NON_FINITE, words);
    own[1] = kept;
    expect_same(run(points, is_last ? NULL : own, NULL), NM_NULL_ARGUMENT, "points is NULL");

    CHECK(nm_options_init(&options, sizeof options) == NM_OK);
    if (is_last)
        options.quality_bound = -1;
    expect_same(run(points, own, &options), NM_INVALID_ARGUMENT, ranks > 1 ? "options" : "quality_bound is -1");
    options.quality_bound = -1;
    expect_same(run(points, own, &options), NM_INVALID_ARGUMENT, "options.quality_bound is -1");
    CHECK(nm_options_init(&options, sizeof options) == NM_OK);
    options.algorithm = is_last ? NM_ALGORITHM_SVR : NM_ALGORITHM_NETMESH;
    expect_same(run(points, own, &options), NM_INVALID_ARGUMENT, "options.algorithm");
    CHECK(nm_options_init(&options, sizeof options) == NM_OK);
    options.struct_size = is_last ? 3 : options.struct_size;
    expect_same(run(points, own, &options), NM_INVALID_ARGUMENT, "options.struct_size is 3");
    CHECK(nm_options_init(&options, sizeof options) == NM_OK);
    options.max_vertices = points->count;
    expect_same(run(points, own, &options), NM_LIMIT, "max_vertices");
    CHECK(nm_options_init(&options, sizeof options) == NM_OK);
    options.progress = is_last ? cancel : NULL;
    expect_same(run(points, own, &options), NM_CANCELLED, "");

    nm_mpi_mesh *mesh = NULL;
    expect_same(nm_mpi_run(MPI_COMM_WORLD, is_last ? 9 : points->dim, points->local, own, NULL, &mesh),
                NM_DIMENSION, "dim is 9; meshes of several ranks are of 2 or 3");
    expect_same(nm_mpi_run(MPI_COMM_WORLD, points->dim, points->local, own, NULL, is_last ? NULL : &mesh),
                NM_NULL_ARGUMENT, "mesh is NULL");
    CHECK(mesh == NULL);
    if (ranks > 1)
        expect_same(nm_mpi_run(MPI_COMM_WORLD, is_last ? 3 : 2, 0, NULL, NULL, &mesh), NM_DIMENSION,
                    "dim is 3, on rank 0 it is 2; it must be the same on all ranks");
    expect_same(nm_mpi_run(MPI_COMM_WORLD, 2, 0, NULL, NULL, &mesh), NM_DEGENERATE_INPUT, "0 points");
    CHECK(nm_mpi_run(MPI_COMM_NULL, 2, 0, NULL, NULL, &mesh) == NM_IO);
}

/* What must be the same on all ranks, one call after another, of which the last rank makes another. */
static void disagreements(const cloud *points, const double *own, const char *directory)
{
    nm_mpi_mesh *mesh = NULL;
    nm_mpi_report report = NM_MPI_REPORT_INIT;
    nm_options options;
    char path[4096], other[4096];
    int is_last = rank == ranks - 1;
    if (ranks == 1)
        return;
    CHECK(nm_options_init(&options, sizeof options) == NM_OK);
    options.seed = is_last;
    expect_same(run(points, own, &options), NM_INVALID_ARGUMENT, "options.seed is 1, on rank 0 it is 0");
    CHECK(nm_options_init(&options, sizeof options) == NM_OK);
    options.epsilon = 0.01 + 1e-9 * rank;
    expect_same(run(points, own, &options), NM_INVALID_ARGUMENT, "options.epsilon is 0.01000000");
    options.epsilon = 0;
    options.threads = 1 + (uint32_t)rank % 2;
    CHECK(run(points, own, &options) == NM_OK);

    CHECK(nm_mpi_run(MPI_COMM_WORLD, points->dim, points->local, own, NULL, &mesh) == NM_OK);
    snprintf(path, sizeof path, "%s/one.pvtu", directory);
    snprintf(other, sizeof other, "%s/two.pvtu", directory);
    expect_same(nm_mpi_export(mesh, is_last ? other : path, NM_MPI_FORMAT_AUTO), NM_INVALID_ARGUMENT,
                "path_utf8 is ");
    expect_same(nm_mpi_export(mesh, path, is_last ? NM_MPI_FORMAT_NPY : NM_MPI_FORMAT_PVTU),
                NM_INVALID_ARGUMENT, "format is 2, on rank 0 it is 1");
    snprintf(other, sizeof other, "%s/one.npy", directory);
    expect_same(nm_mpi_export(mesh, is_last ? other : path, NM_MPI_FORMAT_AUTO), NM_INVALID_ARGUMENT,
                "path_utf8 is ");
    expect_same(nm_mpi_validate(mesh, is_last ? 3 : 1, &report), NM_INVALID_ARGUMENT,
                "level is 3, on rank 0 it is 1");
    expect_same(is_last ? nm_mpi_validate(mesh, 1, &report) : nm_mpi_export(mesh, path, NM_MPI_FORMAT_AUTO),
                NM_INVALID_ARGUMENT, "the call is nm_mpi_validate, on rank 0 it is nm_mpi_export");
    /* One after another they go on. */
    CHECK(nm_mpi_validate(mesh, 3, &report) == NM_OK && report.level == 3);
    CHECK(nm_mpi_export(mesh, path, NM_MPI_FORMAT_AUTO) == NM_OK);
    nm_mpi_mesh_free(mesh);
}

static void exports(const cloud *points, const double *own, const char *directory)
{
    nm_mpi_mesh *mesh = NULL;
    char path[4096];
    struct stat found;
    CHECK(nm_mpi_run(MPI_COMM_WORLD, points->dim, points->local, own, NULL, &mesh) == NM_OK);
    expect_same(nm_mpi_export(mesh, "mesh.off", NM_MPI_FORMAT_AUTO), NM_INVALID_ARGUMENT, "extension");
    expect_same(nm_mpi_export(mesh, rank == ranks - 1 ? NULL : "mesh.pvtu", NM_MPI_FORMAT_AUTO),
                NM_NULL_ARGUMENT, "path_utf8 is NULL");
    expect_same(nm_mpi_export(mesh, "mesh.pvtu", (nm_mpi_format)7), NM_INVALID_ARGUMENT,
                "format is 7; it must be one of nm_mpi_format, 0 to 2");
    for (int format = 0; format < 2; format++) {
        const char *name = format == 0 ? "mesh.pvtu" : "mesh.npy";
        snprintf(path, sizeof path, "%s/absent/%s", directory, name);
        expect_same(nm_mpi_export(mesh, path, NM_MPI_FORMAT_AUTO), NM_IO, "cannot create");
        snprintf(path, sizeof path, "%s/full/%s", directory, name);
        snprintf(path, sizeof path, "%s/full", directory);
        if (stat(path, &found) == 0) {
            snprintf(path, sizeof path, "%s/full/%s", directory, name);
            expect_same(nm_mpi_export(mesh, path, NM_MPI_FORMAT_AUTO), NM_IO, "cannot write");
        }
        /* The mesh is as good as before. */
        snprintf(path, sizeof path, "%s/%s", directory, name);
        CHECK(nm_mpi_export(mesh, path, NM_MPI_FORMAT_AUTO) == NM_OK);
    }
    nm_mpi_mesh_free(mesh);
    nm_mpi_mesh_free(NULL);
}

static void certificates(const cloud *points, const double *own)
{
    nm_mpi_mesh *mesh = NULL;
    nm_mpi_report report = NM_MPI_REPORT_INIT;
    int is_last = rank == ranks - 1;
    CHECK(nm_mpi_run(MPI_COMM_WORLD, points->dim, points->local, own, NULL, &mesh) == NM_OK);
    expect_same(nm_mpi_validate(mesh, 1, is_last ? NULL : &report), NM_NULL_ARGUMENT, "report is NULL");
    report.struct_size = is_last ? 3 : report.struct_size;
    expect_same(nm_mpi_validate(mesh, 1, &report), NM_INVALID_ARGUMENT, "struct_size is 3");
    report.struct_size = sizeof report;
    expect_same(nm_mpi_validate(mesh, is_last ? 4 : 1, &report), NM_INVALID_ARGUMENT, "level is 4");
    CHECK(nm_mpi_validate(NULL, 1, &report) == NM_NULL_ARGUMENT);
    CHECK(report.level == 0);
    for (uint32_t level = 1; level <= 3; level++)
        CHECK(nm_mpi_validate(mesh, level, &report) == NM_OK && report.level == level);
    nm_mpi_mesh_free(mesh);
}

int main(int argc, char **argv)
{
    MPI_Init(&argc, &argv);
    MPI_Comm_rank(MPI_COMM_WORLD, &rank);
    MPI_Comm_size(MPI_COMM_WORLD, &ranks);
    CHECK(argc == 2);
    cloud points = make_cloud("uniform", 3, 2000, "even");
    double *own = points.points + points.first * points.dim;
    bad_arguments(&points, own);
    disagreements(&points, own, argv[1]);
    exports(&points, own, argv[1]);
    certificates(&points, own);
    if (rank == 0)
        printf("statuses are the same on %d ranks\n", ranks);
    MPI_Finalize();
    return 0;
}
