/* What docs/recipes.md shows in C. */
#include "must.h"

#include <math.h>
#include <string.h>

static nm_counts counts_of(const nm_mesh *mesh)
{
    nm_counts counts = NM_COUNTS_INIT;
    must(nm_mesh_counts(mesh, &counts));
    return counts;
}

static uint64_t precision_limited(const nm_mesh *mesh)
{
    nm_quality quality = NM_QUALITY_INIT;
    must(nm_mesh_quality(mesh, &quality));
    return quality.precision_limited;
}

/* 50 points in each of seven boxes around the origin, each 10^50 times smaller than the last. */
static double *seven_scales(void)
{
    double *points = uniform_points(350, 3);
    for (int i = 0; i < 350 * 3; ++i)
        points[i] = (points[i] - 0.5) * pow(10.0, -50.0 * (i / 150));
    return points;
}

static void four_dimensions(void)
{
    double *events = uniform_points(300, 4);
    nm_mesh *mesh = NULL;
    /* [four] */
    must(nm_mesh_create(4, 300, events, 0, &mesh)); /* x, y, z, t: scale t so that it compares */
    must(nm_run(mesh, NULL));
    uint64_t ids = 0; /* five a simplex */
    must(nm_mesh_get_simplices(mesh, NULL, 0, &ids));
    /* [end] */
    expect(ids == 5 * counts_of(mesh).simplices, "a simplex has five vertices");
    free(events);
    nm_mesh_free(mesh);
}

static void wide_scales(void)
{
    double *points = seven_scales();
    nm_mesh *mesh = NULL;
    must(nm_mesh_create(3, 350, points, 0, &mesh));
    must(nm_run(mesh, NULL));
    printf("%llu vertices for 350 points from 1 to 1e-300\n",
           (unsigned long long)counts_of(mesh).vertices);
    expect(counts_of(mesh).vertices < 10 * 350, "the size does not grow with the spread");
    expect(precision_limited(mesh) == 0, "doubles are fine enough around the origin");

    nm_options options;
    must(nm_options_init(&options, sizeof options));
    /* [well_spaced] */
    options.output = NM_OUTPUT_WELL_SPACED;
    options.max_vertices = 20 * 350; /* NM_LIMIT rather than a mesh that pays for each scale */
    nm_status status = nm_run(mesh, &options);
    /* [end] */
    expect(status == NM_LIMIT, "a well-spaced mesh pays for every scale between");
    free(points);
    nm_mesh_free(mesh);
}

/* The simplices, for the caller to free. */
static uint32_t *simplices_of(const nm_mesh *mesh, uint64_t *ids)
{
    must(nm_mesh_get_simplices(mesh, NULL, 0, ids));
    uint32_t *simplices = malloc(*ids * sizeof *simplices);
    expect(simplices != NULL, "there is memory for the simplices");
    must(nm_mesh_get_simplices(mesh, simplices, *ids, NULL));
    return simplices;
}

static void reproducibility(void)
{
    double *points = uniform_points(2000, 3);
    nm_mesh *mesh = NULL, *other = NULL;
    nm_options options;
    must(nm_mesh_create(3, 2000, points, 0, &mesh));
    must(nm_mesh_create(3, 2000, points, 0, &other));
    must(nm_options_init(&options, sizeof options));
    /* [same] */
    options.seed = 7; /* or without any random number: */
    options.ordering = NM_ORDERING_DETERMINISTIC_NET;
    must(nm_run(mesh, &options));
    options.threads = 0; /* all cores: no influence on the mesh */
    must(nm_run(other, &options));
    /* [end] */
    uint64_t ids = 0, other_ids = 0;
    uint32_t *one = simplices_of(mesh, &ids), *two = simplices_of(other, &other_ids);
    expect(ids == other_ids && memcmp(one, two, ids * sizeof *one) == 0, "both meshes are the same");
    free(one);
    free(two);
    free(points);
    nm_mesh_free(mesh);
    nm_mesh_free(other);
}

static void plain_delaunay(void)
{
    double *points = uniform_points(2000, 3);
    nm_mesh *mesh = NULL;
    nm_options options;
    must(nm_mesh_create(3, 2000, points, 0, &mesh));
    must(nm_options_init(&options, sizeof options));
    /* [delaunay] */
    options.algorithm = NM_ALGORITHM_DELAUNAY;
    must(nm_run(mesh, &options));
    /* [end] */
    expect(counts_of(mesh).vertices == 2000, "no vertex was added");
    free(points);
    nm_mesh_free(mesh);
}

int main(void)
{
    four_dimensions();
    wide_scales();
    reproducibility();
    plain_delaunay();
    return 0;
}
