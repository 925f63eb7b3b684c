/* How good a mesh is, and whether it is right. */
#include "must.h"

enum { DIM = 3, POINTS = 2000 };

int main(void)
{
    double *points = uniform_points(POINTS, DIM);
    nm_mesh *mesh = NULL;
    nm_options options;
    must(nm_mesh_create(DIM, POINTS, points, 0, &mesh));
    free(points);
    must(nm_options_init(&options, sizeof options));
    options.quality_bound = 3.5;
    must(nm_run(mesh, &options));

    /* [quality] */
    nm_quality quality = NM_QUALITY_INIT;
    must(nm_mesh_quality(mesh, &quality));
    printf("Voronoi aspect at most %.3f, mean %.3f; smallest dihedral angle %.2f degrees\n",
           quality.worst_aspect_anywhere, quality.mean_aspect, quality.min_angle_degrees);
    printf("%llu cells out of reach of the bound in double precision\n",
           (unsigned long long)quality.precision_limited);
    /* [end] */
    expect(quality.worst_aspect_anywhere >= 1 && quality.worst_aspect_anywhere <= 3.5,
           "every cell keeps the bound");
    expect(quality.precision_limited == 0, "doubles are fine enough here");

    /* [slivers] */
    const double degrees = 15;
    uint64_t below_and_rest[2];
    must(nm_mesh_quality_histogram(mesh, NM_MEASURE_SMALLEST_ANGLE, 1, 1, &degrees,
                                   below_and_rest, NULL));
    printf("%llu of %llu tetrahedra have a dihedral angle below %g degrees\n",
           (unsigned long long)below_and_rest[0],
           (unsigned long long)(below_and_rest[0] + below_and_rest[1]), degrees);
    /* [end] */
    expect(below_and_rest[0] > 0 && below_and_rest[0] < below_and_rest[1], "a few are slivers");

    /* [certificate] */
    nm_report report = NM_REPORT_INIT;
    must(nm_mesh_validate(mesh, 3, &report)); /* NM_OK: the check ran. What it found: */
    printf("%llu checks, %llu violations\n", (unsigned long long)report.checked,
           (unsigned long long)report.violations);
    if (report.violations > 0)
        printf("the first: %s\n", report.message);
    /* [end] */
    expect(report.violations == 0 && report.level == 3, "the certificate holds");

    nm_mesh_free(mesh);
    return 0;
}
