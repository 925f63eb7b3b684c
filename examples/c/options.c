/* Options, progress, sizes, and the three ways in which a run ends early. */
#include "must.h"

#include <time.h>

enum { DIM = 3, POINTS = 20000 };

/* [progress] */
struct deadline {
    clock_t end;
    unsigned reports;
};

static int32_t watch(const nm_progress *progress, void *user_data)
{
    struct deadline *deadline = user_data;
    ++deadline->reports;
    fprintf(stderr, "\r%3.0f %%, %llu vertices", 100.0 * progress->fraction,
            (unsigned long long)progress->vertices);
    return clock() >= deadline->end; /* nonzero cancels */
}
/* [end] */

static uint64_t vertices(const nm_mesh *mesh)
{
    nm_counts counts = NM_COUNTS_INIT;
    must(nm_mesh_counts(mesh, &counts));
    return counts.vertices;
}

static void mesh_with_a_bound(nm_mesh *mesh)
{
    /* [options] */
    struct deadline deadline = { clock() + 60 * CLOCKS_PER_SEC, 0 };
    nm_options options;
    must(nm_options_init(&options, sizeof options));
    options.output = NM_OUTPUT_WELL_SPACED;
    options.criterion = NM_CRITERION_RADIUS_EDGE;
    options.quality_bound = 1.8;
    options.progress = watch;
    options.user_data = &deadline;
    must(nm_run(mesh, &options));
    /* [end] */
    fputc('\n', stderr);
    expect(deadline.reports > 0, "the progress function was called");
}

/* [size] */
static double finer_on_the_left(const double *x, void *user_data)
{
    const double *factor = user_data;
    return *factor * (0.05 + 0.2 * x[0]); /* the length that edges shall have at x */
}
/* [end] */

static void mesh_by_size(nm_mesh *mesh)
{
    const uint64_t before = vertices(mesh);
    nm_options options;
    must(nm_options_init(&options, sizeof options));
    /* [sized] */
    double factor = 0.5;
    options.max_edge = 0.1; /* no edge is longer in the box of the points */
    options.size = finer_on_the_left;
    options.size_user_data = &factor;
    must(nm_run(mesh, &options));
    /* [end] */
    expect(vertices(mesh) > before, "sizes make a finer mesh");
}

static void cancel(nm_mesh *mesh)
{
    const uint64_t before = vertices(mesh);
    nm_options options;
    must(nm_options_init(&options, sizeof options));
    /* [cancel] */
    struct deadline now = { clock(), 0 };
    options.progress = watch;
    options.user_data = &now;
    nm_status status = nm_run(mesh, &options); /* NM_CANCELLED, and the mesh is as it was */
    /* [end] */
    fputc('\n', stderr);
    expect(status == NM_CANCELLED, "the run was cancelled");
    expect(vertices(mesh) == before, "a cancelled run leaves the mesh as it was");
}

static void limit(nm_mesh *mesh)
{
    const uint64_t before = vertices(mesh);
    nm_options options;
    must(nm_options_init(&options, sizeof options));
    /* [limit] */
    options.max_vertices = POINTS + 100;
    nm_status status = nm_run(mesh, &options); /* NM_LIMIT, and the mesh is as it was */
    /* [end] */
    expect(status == NM_LIMIT, "the run stopped at max_vertices");
    expect(vertices(mesh) == before, "a limited run leaves the mesh as it was");
}

static void refuse(nm_mesh *mesh)
{
    nm_options options;
    char message[256];
    must(nm_options_init(&options, sizeof options));
    options.quality_bound = 1.0;
    expect(nm_run(mesh, &options) == NM_INVALID_ARGUMENT, "a bound that is too small is refused");
    nm_last_error(message, sizeof message);
    printf("refused: %s\n", message);
}

int main(void)
{
    double *points = uniform_points(POINTS, DIM);
    nm_mesh *mesh = NULL;
    must(nm_mesh_create(DIM, POINTS, points, 0, &mesh));
    free(points); /* the mesh has copied them */
    mesh_with_a_bound(mesh);
    expect(vertices(mesh) > POINTS, "the mesh is there");
    mesh_by_size(mesh);
    cancel(mesh);
    limit(mesh);
    refuse(mesh);
    nm_mesh_free(mesh);
    return 0;
}
