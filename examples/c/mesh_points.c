/*
 * Meshes a few thousand points of very uneven density and writes the mesh for ParaView:
 *
 *     cc -std=c99 -Iinclude examples/c/mesh_points.c -Ltarget/release -lnetmesh -o mesh_points
 *     ./mesh_points mesh.vtu
 */
#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>

#include "netmesh.h"

enum { DIM = 2, POINTS = 3000 };

/* A number in [0, 1) from a linear congruential generator. */
static double next_random(uint64_t *state)
{
    *state = *state * 6364136223846793005u + 1442695040888963407u;
    return (double)(*state >> 11) / 9007199254740992.0;
}

/* Half of the points are uniform in a square; half crowd around its middle, ever closer. */
static void make_points(double *points)
{
    uint64_t state = 42;
    for (int i = 0; i < POINTS; ++i) {
        double scale = i % 2 == 0 ? 0.5 : 0.5 * pow(10.0, -9.0 * i / POINTS);
        for (int k = 0; k < DIM; ++k)
            points[i * DIM + k] = 0.5 + scale * (2.0 * next_random(&state) - 1.0);
    }
}

/* Prints why a call failed; answers whether it did. */
static int failed(const char *what, nm_status status)
{
    char message[512];
    if (status == NM_OK)
        return 0;
    nm_last_error(message, sizeof message);
    fprintf(stderr, "%s: %s: %s\n", what, nm_status_name(status), message);
    return 1;
}

static int32_t show_progress(const nm_progress *progress, void *user_data)
{
    uint64_t *reports = user_data;
    ++*reports;
    fprintf(stderr, "\r%3.0f %%, %llu vertices ", 100.0 * progress->fraction,
            (unsigned long long)progress->vertices);
    return 0; /* anything else cancels */
}

static int run(nm_mesh *mesh)
{
    uint64_t reports = 0;
    nm_options options;
    if (failed("nm_options_init", nm_options_init(&options, sizeof options)))
        return 0;
    options.seed = 7;
    options.progress = show_progress;
    options.user_data = &reports;
    nm_status status = nm_run(mesh, &options);
    if (reports > 0)
        fputc('\n', stderr);
    return !failed("nm_run", status);
}

static int print_counts_and_quality(const nm_mesh *mesh)
{
    nm_counts counts = NM_COUNTS_INIT;
    nm_quality quality = NM_QUALITY_INIT;
    if (failed("nm_mesh_counts", nm_mesh_counts(mesh, &counts)) ||
        failed("nm_mesh_quality", nm_mesh_quality(mesh, &quality)))
        return 0;
    printf("%llu points -> %llu vertices, %llu triangles, %llu domains\n",
           (unsigned long long)counts.inputs, (unsigned long long)counts.vertices,
           (unsigned long long)counts.simplices, (unsigned long long)counts.domains);
    printf("worst aspect %.3f, mean %.3f, smallest angle %.2f degrees, largest degree %u\n",
           quality.worst_aspect, quality.mean_aspect, quality.min_angle_degrees,
           (unsigned)quality.max_degree);
    return 1;
}

/* Reads the simplices back and prints the first, to show how arrays are fetched. */
static int print_first_simplex(const nm_mesh *mesh)
{
    uint64_t needed = 0;
    if (failed("nm_mesh_get_simplices", nm_mesh_get_simplices(mesh, NULL, 0, &needed)))
        return 0;
    uint32_t *simplices = malloc((size_t)needed * sizeof *simplices);
    if (simplices == NULL)
        return 0;
    int ok = !failed("nm_mesh_get_simplices",
                     nm_mesh_get_simplices(mesh, simplices, needed, NULL));
    if (ok)
        printf("first triangle: %u %u %u\n", (unsigned)simplices[0], (unsigned)simplices[1],
               (unsigned)simplices[2]);
    free(simplices);
    return ok;
}

static int validate(const nm_mesh *mesh)
{
    nm_report report = NM_REPORT_INIT;
    if (failed("nm_mesh_validate", nm_mesh_validate(mesh, 3, &report)))
        return 0;
    printf("certificate: level %u of 3, %llu checks, %llu violations\n", (unsigned)report.level,
           (unsigned long long)report.checked, (unsigned long long)report.violations);
    if (report.violations > 0)
        fprintf(stderr, "first violation: %s\n", report.message);
    return report.violations == 0;
}

int main(int argc, char **argv)
{
    static double points[POINTS * DIM];
    nm_mesh *mesh = NULL;
    if (argc != 2) {
        fprintf(stderr, "usage: %s OUTPUT.vtu\n", argv[0]);
        return 2;
    }
    make_points(points);
    if (failed("nm_mesh_create", nm_mesh_create(DIM, POINTS, points, 0, &mesh)))
        return 1;
    int ok = run(mesh) && print_counts_and_quality(mesh) && print_first_simplex(mesh) &&
             validate(mesh) && !failed("nm_export", nm_export(mesh, argv[1], NM_FORMAT_AUTO));
    nm_mesh_free(mesh);
    return ok ? 0 : 1;
}
