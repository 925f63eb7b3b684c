/*
 * Provokes every status that can be provoked through the interface, and checks the status, what the
 * message names, and that nothing changed. Argument: a directory for files.
 */
#ifdef __linux__
#define _POSIX_C_SOURCE 200112L
#include <sys/resource.h>
#endif

#include <float.h>
#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "netmesh.h"

static int failures = 0;

static void complain(int line, const char *what)
{
    fprintf(stderr, "misuse.c:%d: %s\n", line, what);
    ++failures;
}

static void check(int line, int condition, const char *what)
{
    if (!condition)
        complain(line, what);
}

#define CHECK(condition) check(__LINE__, (condition), #condition)

/* Checks a status, and that the message of a failure has a part. */
static void expect(int line, nm_status is, nm_status should, const char *part)
{
    char message[1024], text[1400];
    size_t size = nm_last_error(message, sizeof message);
    if (is != should) {
        sprintf(text, "%s instead of %s: %.1000s", nm_status_name(is), nm_status_name(should),
                message);
        complain(line, text);
    } else if (should != NM_OK && (strstr(message, part) == NULL || size != strlen(message) + 1)) {
        sprintf(text, "no '%.100s' in '%.1000s'", part, message);
        complain(line, text);
    }
}

#define EXPECT(status, call, part) expect(__LINE__, (call), (status), (part))
#define OK(call) expect(__LINE__, (call), NM_OK, "")

enum { N = 60, DIM = 2 };

static double points[N * DIM];

static void make_points(void)
{
    uint32_t state = 1;
    for (int i = 0; i < N * DIM; ++i) {
        state = state * 1664525u + 1013904223u;
        points[i] = (double)(state >> 8) / 16777216.0;
    }
}

static nm_mesh *create(void)
{
    nm_mesh *mesh = NULL;
    OK(nm_mesh_create(DIM, N, points, 0, &mesh));
    return mesh;
}

/* All that the getters say about a mesh, as one number. */
static uint64_t fingerprint(const nm_mesh *mesh)
{
    uint64_t hash = 1469598103934665603u, needed = 0;
    nm_counts counts;
    memset(&counts, 0, sizeof counts);
    counts.struct_size = sizeof counts;
    OK(nm_mesh_counts(mesh, &counts));
    OK(nm_mesh_get_points(mesh, NULL, 0, &needed));
    size_t point_bytes = (size_t)needed * sizeof(double);
    size_t simplex_bytes = (size_t)(counts.simplices * (counts.dim + 1)) * sizeof(uint32_t);
    unsigned char *bytes = calloc(1, point_bytes + simplex_bytes + 1);
    double *coordinates = malloc(point_bytes);
    uint32_t *simplices = malloc(simplex_bytes + 1);
    OK(nm_mesh_get_points(mesh, coordinates, needed, NULL));
    if (counts.simplices > 0)
        OK(nm_mesh_get_simplices(mesh, simplices, simplex_bytes / sizeof(uint32_t), NULL));
    memcpy(bytes, coordinates, point_bytes);
    memcpy(bytes + point_bytes, simplices, simplex_bytes);
    for (size_t i = 0; i < point_bytes + simplex_bytes; ++i)
        hash = (hash ^ bytes[i]) * 1099511628211u;
    free(simplices);
    free(coordinates);
    free(bytes);
    return hash ^ counts.vertices ^ counts.domains << 32;
}

static void test_create(void)
{
    nm_mesh *mesh = (nm_mesh *)points;
    double bad[6] = {0, 0, 1, 1, 2, 2};
    EXPECT(NM_NULL_ARGUMENT, nm_mesh_create(2, 3, bad, 0, NULL), "out");
    EXPECT(NM_NULL_ARGUMENT, nm_mesh_create(2, 3, NULL, 0, &mesh), "points");
    CHECK(mesh == NULL);
    EXPECT(NM_DIMENSION, nm_mesh_create(1, 3, bad, 0, &mesh), "dim is 1");
    EXPECT(NM_DIMENSION, nm_mesh_create(NM_MAX_DIM + 1, 3, bad, 0, &mesh), "dim is 9");
    EXPECT(NM_DIMENSION, nm_mesh_create(0, 3, bad, 0, &mesh), "dim is 0");
    EXPECT(NM_INVALID_ARGUMENT, nm_mesh_create(2, 3, bad, 1, &mesh), "stride is 1");
    EXPECT(NM_INVALID_ARGUMENT, nm_mesh_create(2, 3, bad, SIZE_MAX, &mesh), "stride");
    EXPECT(NM_INVALID_ARGUMENT, nm_mesh_create(2, 3, bad, SIZE_MAX / 8, &mesh), "points");
    EXPECT(NM_CAPACITY, nm_mesh_create(2, 0xFFFFFFFFu, bad, 0, &mesh), "4294967295");
    bad[3] = NAN;
    EXPECT(NM_NON_FINITE, nm_mesh_create(2, 3, bad, 0, &mesh), "points[1]");
    bad[3] = -INFINITY;
    EXPECT(NM_NON_FINITE, nm_mesh_create(2, 3, bad, 0, &mesh), "-inf");
    bad[0] = -0.0, bad[1] = bad[2] = bad[3] = 0.0;
    EXPECT(NM_DEGENERATE_INPUT, nm_mesh_create(2, 2, bad, 0, &mesh), "distinct");
    EXPECT(NM_DEGENERATE_INPUT, nm_mesh_create(2, 0, NULL, 0, &mesh), "distinct");
    CHECK(mesh == NULL);
    nm_mesh_free(NULL);
}

/* No room left for a copy of the points. */
static void test_out_of_memory(void)
{
#ifdef __linux__
    const size_t n = 1000000;
    double *many = calloc(n, 8 * sizeof *many);
    nm_mesh *mesh = NULL;
    struct rlimit before, tight;
    if (many == NULL || getrlimit(RLIMIT_AS, &before) != 0)
        return;
    tight = before;
    tight.rlim_cur = 1u << 20;
    nm_status status = NM_OUT_OF_MEMORY;
    if (setrlimit(RLIMIT_AS, &tight) == 0) {
        status = nm_mesh_create(8, n, many, 0, &mesh);
        setrlimit(RLIMIT_AS, &before);
        EXPECT(NM_OUT_OF_MEMORY, status, "cannot allocate");
    }
    CHECK(mesh == NULL);
    free(many);
#endif
}

static void test_files(const char *directory)
{
    nm_mesh *mesh = NULL;
    char path[512];
    EXPECT(NM_NULL_ARGUMENT, nm_mesh_create_from_file(NULL, NM_FORMAT_AUTO, &mesh), "path_utf8");
    EXPECT(NM_NULL_ARGUMENT, nm_mesh_create_from_file("a.xyz", NM_FORMAT_AUTO, NULL), "out");
    EXPECT(NM_INVALID_ARGUMENT, nm_mesh_create_from_file("\xff", NM_FORMAT_XYZ, &mesh), "UTF-8");
    EXPECT(NM_INVALID_ARGUMENT, nm_mesh_create_from_file("a.xyz", 99, &mesh), "format is 99");
    EXPECT(NM_INVALID_ARGUMENT, nm_mesh_create_from_file("a.what", NM_FORMAT_AUTO, &mesh), "what");
    sprintf(path, "%.400s/missing.xyz", directory);
    EXPECT(NM_IO, nm_mesh_create_from_file(path, NM_FORMAT_AUTO, &mesh), "missing.xyz");
    sprintf(path, "%.400s/garbage.xyz", directory);
    FILE *file = fopen(path, "w");
    CHECK(file != NULL);
    if (file != NULL) {
        fputs("0 0\n1 0\nhello\n", file);
        fclose(file);
        EXPECT(NM_FORMAT_ERROR, nm_mesh_create_from_file(path, NM_FORMAT_AUTO, &mesh), "3");
    }
    CHECK(mesh == NULL);
}

static void test_before_a_run(void)
{
    nm_mesh *mesh = create();
    nm_quality quality;
    nm_stats stats;
    nm_report report;
    const double edge = 1;
    uint64_t before = fingerprint(mesh), needed = 5, bins[2];
    quality.struct_size = sizeof quality;
    stats.struct_size = sizeof stats;
    report.struct_size = sizeof report;
    EXPECT(NM_STATE, nm_mesh_get_simplices(mesh, NULL, 0, &needed), "nm_run");
    EXPECT(NM_STATE, nm_mesh_get_neighbors(mesh, NULL, 0, &needed), "nm_run");
    EXPECT(NM_STATE, nm_mesh_quality(mesh, &quality), "nm_run");
    EXPECT(NM_STATE,
           nm_mesh_quality_histogram(mesh, NM_MEASURE_ASPECT, 0, 1, &edge, bins, NULL), "nm_run");
    EXPECT(NM_STATE, nm_mesh_stats(mesh, &stats), "nm_run");
    EXPECT(NM_STATE, nm_mesh_validate(mesh, 1, &report), "nm_run");
    EXPECT(NM_STATE, nm_export(mesh, "never.vtu", NM_FORMAT_VTU), "");
    CHECK(needed == 5);
    CHECK(fingerprint(mesh) == before);
    nm_mesh_free(mesh);
}

static double answer_nothing(const double *x, void *user_data)
{
    (void)x;
    (void)user_data;
    return NAN;
}

static void test_options(void)
{
    nm_mesh *mesh = create();
    struct {
        nm_options options;
        unsigned char tail[8];
    } newer;
    nm_options options;
    EXPECT(NM_NULL_ARGUMENT, nm_options_init(NULL, sizeof options), "options");
    EXPECT(NM_INVALID_ARGUMENT, nm_options_init(&options, 0), "struct_size is 0");
    EXPECT(NM_INVALID_ARGUMENT, nm_options_init(&options, 25), "struct_size is 25");
    EXPECT(NM_NULL_ARGUMENT, nm_run(NULL, NULL), "mesh");
    OK(nm_options_init(&options, sizeof options));
    CHECK(options.struct_size == sizeof options && options.threads == 1);
    uint64_t before = fingerprint(mesh);
    nm_options bad;
#define REFUSED(field, value, part)                      \
    bad = options;                                       \
    bad.field = (value);                                 \
    EXPECT(NM_INVALID_ARGUMENT, nm_run(mesh, &bad), part)
    REFUSED(struct_size, 3, "struct_size is 3");
    REFUSED(struct_size, 5000, "struct_size is 5000");
    REFUSED(output, 3, "options.output is 3");
    REFUSED(algorithm, -1, "options.algorithm is -1");
    REFUSED(ordering, 77, "options.ordering is 77");
    REFUSED(criterion, 2, "options.criterion is 2");
    REFUSED(quality_bound, 1.0, "quality_bound is 1");
    REFUSED(quality_bound, NAN, "quality_bound is NaN");
    REFUSED(epsilon, 0.9, "epsilon is 0.9");
    REFUSED(delta, -1.0, "delta is -1");
    REFUSED(gamma, INFINITY, "gamma is inf");
    REFUSED(yield_radius, 2.0, "yield_radius is 2");
    REFUSED(encroachment, 0.5, "encroachment is 0.5");
    REFUSED(cage_scale, DBL_MIN, "cage_scale");
    REFUSED(root_scale, 1.0, "root_scale is 1");
    REFUSED(distance_ratio, 1.5, "distance_ratio is 1.5");
    REFUSED(min_angle, 34.0, "options.min_angle is 34");
    REFUSED(instruments, 2, "options.instruments is 2");
    REFUSED(reserved, 1, "options.reserved is 1");
    REFUSED(min_dihedral, 23.0, "min_dihedral is 23");
    REFUSED(max_edge, -1.0, "max_edge is -1");
    REFUSED(size, answer_nothing, "options.size answers NaN");
    REFUSED(gives_way, 2, "options.gives_way is 2");
    REFUSED(interior, 4, "options.interior is 4");
    REFUSED(interior, NM_INTERIOR_WINDING, 
            "options.interior = NM_INTERIOR_WINDING needs segments; the mesh has none");
    options.output = NM_OUTPUT_HIERARCHICAL;
    REFUSED(distance_ratio, 0.5, "it does not go with options.output = NM_OUTPUT_HIERARCHICAL");
    REFUSED(size, answer_nothing,
            "options.size is given; it does not go with options.output = NM_OUTPUT_HIERARCHICAL");
    options.output = NM_OUTPUT_AUTO;
    options.extent = NM_EXTENT_ALL;
    REFUSED(interior, NM_INTERIOR_WINDING, 
            "options.interior = NM_INTERIOR_WINDING does not go with options.extent = NM_EXTENT_ALL");
    options.extent = NM_EXTENT_AUTO;
#undef REFUSED
    memset(&newer, 0, sizeof newer);
    OK(nm_options_init(&newer.options, sizeof newer));
    CHECK(newer.options.struct_size == sizeof newer);
    newer.tail[5] = 1;
    EXPECT(NM_INVALID_ARGUMENT, nm_run(mesh, &newer.options), "newer field");
    CHECK(fingerprint(mesh) == before);
    nm_mesh_free(mesh);
}

static int32_t cancel(const nm_progress *progress, void *user_data)
{
    const nm_mesh *mesh = user_data;
    nm_counts counts;
    counts.struct_size = sizeof counts;
    CHECK(progress->struct_size == sizeof *progress);
    CHECK(progress->fraction <= 1.0);
    EXPECT(NM_STATE, nm_mesh_counts(mesh, &counts), "nm_run");
    EXPECT(NM_STATE, nm_run((nm_mesh *)user_data, NULL), "another call");
    return 1;
}

static int32_t stop(const void *data, size_t size, void *user_data)
{
    int *calls = user_data;
    (void)data;
    CHECK(size > 0);
    ++*calls;
    return 5;
}

/* With enough points for the run to last until the first report. */
static void test_cancel(void)
{
    enum { MANY = 40000 };
    double *many = malloc(3 * MANY * sizeof *many);
    nm_mesh *mesh = NULL;
    nm_options options;
    uint32_t state = 5;
    for (int i = 0; i < 3 * MANY; ++i) {
        state = state * 1664525u + 1013904223u;
        many[i] = (double)(state >> 8) / 16777216.0;
    }
    OK(nm_mesh_create(3, MANY, many, 0, &mesh));
    OK(nm_options_init(&options, sizeof options));
    options.progress = cancel;
    options.user_data = mesh;
    uint64_t before = fingerprint(mesh);
    EXPECT(NM_CANCELLED, nm_run(mesh, &options), "cancel");
    CHECK(fingerprint(mesh) == before);
    nm_mesh_free(mesh);
    free(many);
}

static void test_run_failures(nm_mesh *mesh)
{
    double line[8] = {0, 0, 1, 1, 2, 2, 3, 3};
    nm_mesh *collinear = NULL;
    nm_options options;
    uint64_t before = fingerprint(mesh);
    OK(nm_options_init(&options, sizeof options));
    options.max_vertices = N + 1;
    EXPECT(NM_LIMIT, nm_run(mesh, &options), "max_vertices");
    CHECK(fingerprint(mesh) == before);
    OK(nm_options_init(&options, sizeof options));
    options.algorithm = NM_ALGORITHM_DELAUNAY;
    OK(nm_mesh_create(2, 4, line, 0, &collinear));
    before = fingerprint(collinear);
    EXPECT(NM_DEGENERATE_INPUT, nm_run(collinear, &options), "1");
    CHECK(fingerprint(collinear) == before);
    nm_mesh_free(collinear);
}

static void test_histograms(nm_mesh *mesh)
{
    const nm_measure measure = NM_MEASURE_DIHEDRAL_ANGLE;
    const double edges[3] = {0, 15, 180}, falling[2] = {1, 0};
    uint64_t counts[4] = {7, 7, 7, 7}, off_hull[4];
    double extremes[2] = {0, 0};
    nm_counts mesh_counts;
    EXPECT(NM_NULL_ARGUMENT, nm_mesh_quality_histogram(NULL, measure, 0, 3, edges, counts, NULL),
           "mesh");
    EXPECT(NM_NULL_ARGUMENT, nm_mesh_quality_histogram(mesh, measure, 0, 3, NULL, counts, NULL),
           "edges");
    EXPECT(NM_NULL_ARGUMENT, nm_mesh_quality_histogram(mesh, measure, 0, 3, edges, NULL, NULL),
           "counts");
    EXPECT(NM_INVALID_ARGUMENT,
           nm_mesh_quality_histogram(mesh, (nm_measure)4, 0, 3, edges, counts, NULL), "measure is 4");
    EXPECT(NM_INVALID_ARGUMENT, nm_mesh_quality_histogram(mesh, measure, 2, 3, edges, counts, NULL),
           "at_hull is 2");
    EXPECT(NM_INVALID_ARGUMENT, nm_mesh_quality_histogram(mesh, measure, 0, 0, edges, counts, NULL),
           "edges is empty");
    EXPECT(NM_INVALID_ARGUMENT,
           nm_mesh_quality_histogram(mesh, measure, 0, 2, falling, counts, NULL), "edges[1] is 0");
    CHECK(counts[0] == 7 && counts[3] == 7);
    OK(nm_mesh_quality_histogram(mesh, measure, 0, 3, edges, off_hull, NULL));
    OK(nm_mesh_quality_histogram(mesh, measure, 1, 3, edges, counts, extremes));
    mesh_counts.struct_size = sizeof mesh_counts;
    OK(nm_mesh_counts(mesh, &mesh_counts));
    CHECK(counts[0] == 0 && counts[3] == 0 && off_hull[2] > 0);
    CHECK(counts[1] + counts[2] == mesh_counts.simplices * DIM * (DIM + 1) / 2);
    CHECK(off_hull[1] + off_hull[2] < counts[1] + counts[2]);
    CHECK(extremes[0] > 0 && extremes[0] < 90 && extremes[1] > 90 && extremes[1] < 180);
}

static void test_getters(nm_mesh *mesh)
{
    uint64_t before = fingerprint(mesh), needed = 0;
    double small[2] = {7.0, 7.0};
    nm_counts counts;
    EXPECT(NM_NULL_ARGUMENT, nm_mesh_get_points(NULL, NULL, 0, &needed), "mesh");
    EXPECT(NM_CAPACITY, nm_mesh_get_points(mesh, small, 2, &needed), "capacity is 2");
    CHECK(needed >= N * DIM && small[0] == 7.0 && small[1] == 7.0);
    EXPECT(NM_INVALID_ARGUMENT, nm_mesh_get_points(mesh, (double *)((char *)small + 1), 1, NULL),
           "buf");
    EXPECT(NM_NULL_ARGUMENT, nm_mesh_counts(mesh, NULL), "counts");
    memset(&counts, 0xEE, sizeof counts);
    counts.struct_size = 0;
    EXPECT(NM_INVALID_ARGUMENT, nm_mesh_counts(mesh, &counts), "counts.struct_size is 0");
    counts.struct_size = 8;
    OK(nm_mesh_counts(mesh, &counts));
    CHECK(counts.struct_size == 8 && counts.dim == DIM && counts.inputs == 0xEEEEEEEEEEEEEEEEu);
    EXPECT(NM_NULL_ARGUMENT, nm_mesh_quality(mesh, NULL), "quality");
    EXPECT(NM_NULL_ARGUMENT, nm_mesh_stats(mesh, NULL), "stats");
    test_histograms(mesh);
    CHECK(fingerprint(mesh) == before);
}

static void test_validate_and_export(nm_mesh *mesh, const char *directory)
{
    char path[512];
    int calls = 0;
    nm_report report;
    uint64_t before = fingerprint(mesh);
    report.struct_size = sizeof report;
    EXPECT(NM_NULL_ARGUMENT, nm_mesh_validate(mesh, 1, NULL), "report");
    EXPECT(NM_INVALID_ARGUMENT, nm_mesh_validate(mesh, 0, &report), "level");
    EXPECT(NM_INVALID_ARGUMENT, nm_mesh_validate(mesh, 4, &report), "level");
    EXPECT(NM_NULL_ARGUMENT, nm_export(mesh, NULL, NM_FORMAT_VTU), "path_utf8");
    EXPECT(NM_INVALID_ARGUMENT, nm_export(mesh, "", NM_FORMAT_VTU), "path_utf8");
    EXPECT(NM_INVALID_ARGUMENT, nm_export(mesh, "a.vtu", 20), "format is 20");
    sprintf(path, "%.400s/no/such/directory/mesh.vtu", directory);
    EXPECT(NM_IO, nm_export(mesh, path, NM_FORMAT_AUTO), "mesh.vtu");
    EXPECT(NM_NULL_ARGUMENT, nm_export_write(mesh, NM_FORMAT_VTU, NULL, NULL), "write");
    EXPECT(NM_INVALID_ARGUMENT, nm_export_write(mesh, NM_FORMAT_AUTO, stop, &calls), "");
    CHECK(calls == 0);
    EXPECT(NM_IO, nm_export_write(mesh, NM_FORMAT_VTU, stop, &calls), "write answered 5");
    CHECK(calls == 1);
    CHECK(fingerprint(mesh) == before);
}

int main(int argc, char **argv)
{
    if (argc != 2)
        return 2;
    CHECK(nm_last_error(NULL, 0) == 1);
    CHECK(nm_abi_version() == NM_ABI_VERSION);
    CHECK(strcmp(nm_status_name(NM_OUT_OF_MEMORY), "NM_OUT_OF_MEMORY") == 0);
    CHECK(strcmp(nm_status_name(1234), "NM_UNKNOWN") == 0);
    make_points();
    test_create();
    test_out_of_memory();
    test_files(argv[1]);
    test_before_a_run();
    test_options();
    test_cancel();
    nm_mesh *mesh = create();
    test_run_failures(mesh);
    OK(nm_run(mesh, NULL));
    test_run_failures(mesh);
    test_getters(mesh);
    test_validate_and_export(mesh, argv[1]);
    nm_mesh_free(mesh);
    if (failures == 0)
        puts("all misuse was refused");
    return failures != 0;
}
