/* The C ABI from C99, every function once: small enough to run under valgrind.
 *
 *   c_api_smoke <directory for its files>
 */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "netmesh.h"
#include "support/require.h"

enum { point_count = 60 };

typedef struct {
    size_t bytes;
    size_t calls;
} written;

static int32_t count_bytes(const void *data, size_t size, void *user_data) {
    written *sum = user_data;
    REQUIRE(data != NULL && size > 0);
    sum->bytes += size;
    sum->calls += 1;
    return 0;
}

static int32_t count_progress(const nm_progress *progress, void *user_data) {
    REQUIRE(progress->struct_size >= sizeof *progress);
    REQUIRE(progress->fraction == -1.0 || (progress->fraction >= 0.0 && progress->fraction <= 1.0));
    *(int *)user_data += 1;
    return 0;
}

static void *allocate(size_t count, size_t size) {
    void *memory = malloc(count * size + 1);
    REQUIRE(memory != NULL);
    return memory;
}

static void version(void) {
    char expected[64];
    snprintf(expected, sizeof expected, "%d.%d.%d", NM_VERSION_MAJOR, NM_VERSION_MINOR, NM_VERSION_PATCH);
    REQUIRE(strcmp(nm_version(), expected) == 0);
    REQUIRE(nm_abi_version() == NM_ABI_VERSION);
    REQUIRE(strcmp(nm_status_name(NM_OK), "NM_OK") == 0);
}

/* Points with a stride: the two doubles behind each point must not be looked at. */
static nm_mesh *create(uint32_t dim) {
    size_t stride = dim + 2;
    double *points = allocate(point_count * stride, sizeof *points);
    nm_mesh *mesh = NULL;
    uint32_t state = 12345;
    size_t i;
    uint32_t k;
    for (i = 0; i < point_count * stride; ++i) points[i] = NAN;
    for (i = 0; i < point_count; ++i) {
        for (k = 0; k < dim; ++k) {
            state = state * 1664525u + 1013904223u;
            points[i * stride + k] = state / 4294967296.0;
        }
    }
    memcpy(points + (point_count - 1) * stride, points, dim * sizeof *points); /* a duplicate */
    REQUIRE(nm_mesh_create(dim, point_count, points, stride, &mesh) == NM_OK);
    REQUIRE(mesh != NULL);
    free(points);
    return mesh;
}

static void getters(const nm_mesh *mesh) {
    nm_counts counts = NM_COUNTS_INIT;
    uint64_t needed = 0;
    double *points;
    uint32_t *ids;
    uint8_t *kinds;
    nm_domain *domains;
    uint64_t entries;

    REQUIRE(nm_mesh_counts(mesh, &counts) == NM_OK);
    REQUIRE(counts.inputs == point_count && counts.duplicates == 1);
    REQUIRE(counts.vertices > point_count && counts.simplices > 0 && counts.domains > 0);
    entries = counts.simplices * (counts.dim + 1);

    points = allocate(counts.vertices * counts.dim, sizeof *points);
    REQUIRE(nm_mesh_get_points(mesh, points, counts.vertices * counts.dim, &needed) == NM_OK);
    REQUIRE(needed == counts.vertices * counts.dim);
    free(points);

    ids = allocate(entries, sizeof *ids);
    REQUIRE(nm_mesh_get_simplices(mesh, ids, entries, &needed) == NM_OK && needed == entries);
    REQUIRE(nm_mesh_get_neighbors(mesh, ids, entries, NULL) == NM_OK);
    REQUIRE(nm_mesh_get_simplices(mesh, ids, entries - 1, &needed) == NM_CAPACITY && needed == entries);
    free(ids);

    kinds = allocate(counts.vertices, 1);
    REQUIRE(nm_mesh_get_vertex_kinds(mesh, kinds, counts.vertices, &needed) == NM_OK);
    REQUIRE(kinds[0] == NM_VERTEX_INPUT);
    REQUIRE(nm_mesh_get_precision_limited(mesh, kinds, counts.vertices, &needed) == NM_OK);
    free(kinds);

    ids = allocate(counts.vertices, sizeof *ids);
    REQUIRE(nm_mesh_get_vertex_domains(mesh, ids, counts.vertices, &needed) == NM_OK);
    REQUIRE(nm_mesh_get_input_vertices(mesh, ids, counts.vertices, &needed) == NM_OK);
    REQUIRE(needed == point_count && ids[0] == 0 && ids[point_count - 1] == 0);
    REQUIRE(nm_mesh_get_vertex_inputs(mesh, ids, counts.vertices, &needed) == NM_OK);
    REQUIRE(needed == counts.vertices && ids[0] == 0 && ids[point_count - 2] == point_count - 2);
    REQUIRE(ids[counts.vertices - 1] == NM_NONE);
    free(ids);

    domains = allocate(counts.domains, sizeof *domains);
    REQUIRE(nm_mesh_get_domains(mesh, domains, counts.domains, &needed) == NM_OK);
    REQUIRE(domains[0].parent == NM_NONE && domains[0].radius > 0.0);
    free(domains);
}

static void measures(const nm_mesh *mesh) {
    nm_quality quality = NM_QUALITY_INIT;
    nm_stats stats = NM_STATS_INIT;
    nm_report report = NM_REPORT_INIT;
    REQUIRE(nm_mesh_quality(mesh, &quality) == NM_OK && quality.worst_aspect >= 1.0);
    REQUIRE(nm_mesh_stats(mesh, &stats) == NM_OK && stats.input_vertices == point_count - 1);
    REQUIRE(nm_mesh_validate(mesh, 3, &report) == NM_OK);
    if (report.violations != 0) fprintf(stderr, "%s\n", report.message);
    REQUIRE(report.violations == 0 && report.level == 3 && report.checked > 0);
}

static void exports(const nm_mesh *mesh, const char *directory) {
    static const nm_format formats[] = {
        NM_FORMAT_VTU, NM_FORMAT_TETGEN_NODE, NM_FORMAT_GMSH, NM_FORMAT_MEDIT, NM_FORMAT_OFF, NM_FORMAT_PLY,
        NM_FORMAT_XYZ, NM_FORMAT_CSV, NM_FORMAT_NPY, NM_FORMAT_VORONOI_JSON, NM_FORMAT_DOMAINS_JSON,
        NM_FORMAT_HTML};
    char path[1024];
    size_t i;
    for (i = 0; i < sizeof formats / sizeof *formats; ++i) {
        written sum = {0, 0};
        REQUIRE(nm_export_write(mesh, formats[i], count_bytes, &sum) == NM_OK);
        REQUIRE(sum.bytes > 0 && sum.calls > 0);
    }
    snprintf(path, sizeof path, "%s/c_api_smoke.vtu", directory);
    REQUIRE(nm_export(mesh, path, NM_FORMAT_AUTO) == NM_OK);
    REQUIRE(remove(path) == 0);
}

/* Points come back from every format that can be read; those of OFF and PLY are in space. */
static void round_trips(const nm_mesh *mesh, const char *directory) {
    static const char *const extensions[] = {"xyz", "csv", "npy", "msh", "mesh", "off", "ply"};
    char path[1024];
    size_t i;
    for (i = 0; i < sizeof extensions / sizeof *extensions; ++i) {
        nm_mesh *again = NULL;
        nm_counts before = NM_COUNTS_INIT;
        nm_counts after = NM_COUNTS_INIT;
        snprintf(path, sizeof path, "%s/c_api_smoke.%s", directory, extensions[i]);
        REQUIRE(nm_export(mesh, path, NM_FORMAT_AUTO) == NM_OK);
        REQUIRE(nm_mesh_create_from_file(path, NM_FORMAT_AUTO, &again) == NM_OK);
        REQUIRE(remove(path) == 0);
        REQUIRE(nm_mesh_counts(mesh, &before) == NM_OK && nm_mesh_counts(again, &after) == NM_OK);
        REQUIRE(after.dim == (i < 5 ? before.dim : 3) && after.inputs == before.vertices);
        nm_mesh_free(again);
    }
}

static void failures(void) {
    double points[] = {0, 0, 1, 0, 0, INFINITY};
    nm_mesh *mesh = NULL;
    char message[256];
    size_t size;
    REQUIRE(nm_mesh_create(2, 3, points, 0, &mesh) == NM_NON_FINITE);
    REQUIRE(mesh == NULL);
    size = nm_last_error(NULL, 0);
    REQUIRE(size > 1 && nm_last_error(message, sizeof message) == size && strlen(message) + 1 == size);
    REQUIRE(nm_last_error(message, 5) == size && strlen(message) == 4);
    REQUIRE(nm_mesh_create(2, 3, NULL, 0, &mesh) == NM_NULL_ARGUMENT);
    nm_mesh_free(NULL);
}

int main(int count, char **arguments) {
    uint32_t dim;
    if (count != 2) {
        fprintf(stderr, "usage: c_api_smoke <directory>\n");
        return 2;
    }
    version();
    failures();
    for (dim = 2; dim <= 3; ++dim) {
        nm_options options;
        int reports = 0;
        nm_mesh *mesh = create(dim);
        REQUIRE(nm_run(mesh, NULL) == NM_OK);
        getters(mesh);
        measures(mesh);
        exports(mesh, arguments[1]);
        round_trips(mesh, arguments[1]);
        REQUIRE(nm_options_init(&options, sizeof options) == NM_OK);
        options.output = NM_OUTPUT_WELL_SPACED;
        options.progress = count_progress;
        options.user_data = &reports;
        REQUIRE(nm_run(mesh, &options) == NM_OK);
        getters(mesh);
        measures(mesh);
        options.max_vertices = point_count;
        REQUIRE(nm_run(mesh, &options) == NM_LIMIT);
        measures(mesh);
        nm_mesh_free(mesh);
    }
    puts("c_api_smoke: everything as expected");
    return 0;
}
