/* What inputs of the plane may bring along, from C99: segments, regions and holes, attributes, columns of
 * files, and selections in files; each answer from the drawing itself.
 *
 *   planar_inputs <directory for its files>
 */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "netmesh.h"
#include "support/require.h"

/* A square with a diagonal, and a square hole below it. Input 8 lies on the first side. */
enum { input_count = 9, segment_count = 10 };
static const double corners[2 * input_count] = {0,   0,   4,   0,   4,   4,   0,   4, 2.5,
                                                0.5, 3.5, 0.5, 3.5, 1.5, 2.5, 1.5, 1, 0};
/* The last one runs along a part of the first. */
static const uint32_t ends[2 * segment_count] = {0, 1, 1, 2, 2, 3, 3, 0, 0, 2, 4, 5, 5, 6, 6, 7, 7, 4, 0, 8};

static void *allocate(size_t count, size_t size) {
    void *memory = malloc(count * size + 1);
    REQUIRE(memory != NULL);
    return memory;
}

static nm_counts counts_of(const nm_mesh *mesh) {
    nm_counts counts = NM_COUNTS_INIT;
    REQUIRE(nm_mesh_counts(mesh, &counts) == NM_OK);
    return counts;
}

static double *points_of(const nm_mesh *mesh) {
    const uint64_t needed = 2 * counts_of(mesh).vertices;
    double *points = allocate(needed, sizeof *points);
    REQUIRE(nm_mesh_get_points(mesh, points, needed, NULL) == NM_OK);
    return points;
}

static uint32_t *triangles_of(const nm_mesh *mesh) {
    const uint64_t needed = 3 * counts_of(mesh).simplices;
    uint32_t *triangles = allocate(needed, sizeof *triangles);
    REQUIRE(nm_mesh_get_simplices(mesh, triangles, needed, NULL) == NM_OK);
    return triangles;
}

static double area(const double *points, const uint32_t *ids) {
    const double *a = points + 2 * ids[0], *b = points + 2 * ids[1], *c = points + 2 * ids[2];
    return ((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])) / 2;
}

static nm_mesh *drawing(void) {
    nm_mesh *mesh = NULL;
    nm_region regions[3] = {NM_REGION_INIT, NM_REGION_INIT, NM_REGION_INIT};
    nm_options options;
    uint64_t needed = 7;
    REQUIRE(nm_mesh_create(2, input_count, corners, 0, &mesh) == NM_OK);
    REQUIRE(nm_mesh_set_segments(mesh, segment_count, ends, NULL) == NM_OK);
    regions[0].label = 5;
    regions[0].seed[0] = 1;
    regions[0].seed[1] = 3;
    regions[1].label = -7;
    regions[1].seed[0] = 2;
    regions[1].seed[1] = 1;
    regions[2].is_hole = 1;
    regions[2].seed[0] = 3;
    regions[2].seed[1] = 1;
    REQUIRE(nm_mesh_set_regions(mesh, 3, regions) == NM_OK);
    REQUIRE(nm_mesh_get_segments(mesh, NULL, 0, &needed) == NM_STATE);
    REQUIRE(nm_mesh_get_segment_parents(mesh, NULL, 0, &needed) == NM_STATE);
    REQUIRE(nm_mesh_get_simplex_regions(mesh, NULL, 0, &needed) == NM_STATE);
    REQUIRE(needed == 7);
    REQUIRE(nm_options_init(&options, sizeof options) == NM_OK);
    options.min_angle = 25;
    REQUIRE(nm_mesh_options(mesh, &options) == NM_STATE);
    REQUIRE(nm_run(mesh, &options) == NM_OK);
    /* What auto has become: segments enclose something, and an angle is asked for. */
    REQUIRE(nm_mesh_options(mesh, &options) == NM_OK);
    REQUIRE(options.extent == NM_EXTENT_BOUNDARY && options.output == NM_OUTPUT_WELL_SPACED);
    REQUIRE(options.interior == NM_INTERIOR_SEEDS && options.min_angle == 25);
    return mesh;
}

static int is_edge(const uint32_t *triangles, uint64_t count, uint32_t a, uint32_t b) {
    uint64_t i;
    int k;
    for (i = 0; i < count; ++i) {
        for (k = 0; k < 3; ++k) {
            const uint32_t from = triangles[3 * i + k], to = triangles[3 * i + (k + 1) % 3];
            if ((from == a && to == b) || (from == b && to == a)) return 1;
        }
    }
    return 0;
}

/* How far along its segment a vertex is, from 0 to 1; ends the program if it lies beside it. */
static double place_on(uint32_t segment, const double *x) {
    const double *a = corners + 2 * ends[2 * segment], *b = corners + 2 * ends[2 * segment + 1];
    const double along[2] = {b[0] - a[0], b[1] - a[1]}, step[2] = {x[0] - a[0], x[1] - a[1]};
    /* The segments run along axes or the diagonal, where no rounding moves a vertex. */
    REQUIRE(step[0] * along[1] == step[1] * along[0]);
    return (step[0] * along[0] + step[1] * along[1]) / (along[0] * along[0] + along[1] * along[1]);
}

/* Pieces lead from end to end, in the order and direction of the segments, and are edges. */
static void segments_are_chains(const nm_mesh *mesh) {
    uint64_t needed = 0, of_parents = 0, i;
    uint32_t segment, *pieces, *parents;
    double *points = points_of(mesh);
    uint32_t *triangles = triangles_of(mesh);
    REQUIRE(nm_mesh_get_segments(mesh, NULL, 0, &needed) == NM_OK);
    REQUIRE(nm_mesh_get_segment_parents(mesh, NULL, 0, &of_parents) == NM_OK);
    REQUIRE(needed == 2 * of_parents && of_parents > segment_count);
    pieces = allocate(needed, sizeof *pieces);
    parents = allocate(of_parents, sizeof *parents);
    REQUIRE(nm_mesh_get_segments(mesh, pieces, needed - 1, &needed) == NM_CAPACITY);
    REQUIRE(nm_mesh_get_segments(mesh, pieces, needed, NULL) == NM_OK);
    REQUIRE(nm_mesh_get_segment_parents(mesh, parents, of_parents, NULL) == NM_OK);
    i = 0;
    for (segment = 0; segment + 1 < segment_count; ++segment) {
        uint32_t at = ends[2 * segment];
        int meets_input = 0;
        for (; i < of_parents && parents[i] == segment; ++i) {
            REQUIRE(pieces[2 * i] == at);
            at = pieces[2 * i + 1];
            meets_input |= at == 8;
            REQUIRE(place_on(segment, points + 2 * at) > place_on(segment, points + 2 * pieces[2 * i]));
            REQUIRE(is_edge(triangles, counts_of(mesh).simplices, at, pieces[2 * i]));
        }
        REQUIRE(at == ends[2 * segment + 1]);
        REQUIRE(meets_input == (segment == 0));
    }
    /* Where segments overlap the first counts: none is of the last. */
    REQUIRE(i == of_parents);
    free(points);
    free(triangles);
    free(pieces);
    free(parents);
}

static void regions_have_their_labels(const nm_mesh *mesh) {
    const uint64_t count = counts_of(mesh).simplices;
    uint64_t needed = 0, i;
    double above = 0, below = 0, *points = points_of(mesh);
    uint32_t *triangles = triangles_of(mesh);
    int32_t *labels = allocate(count, sizeof *labels);
    REQUIRE(nm_mesh_get_simplex_regions(mesh, labels, count, &needed) == NM_OK && needed == count);
    for (i = 0; i < count; ++i) {
        const uint32_t *ids = triangles + 3 * i;
        const double x = (points[2 * ids[0]] + points[2 * ids[1]] + points[2 * ids[2]]) / 3;
        const double y = (points[2 * ids[0] + 1] + points[2 * ids[1] + 1] + points[2 * ids[2] + 1]) / 3;
        REQUIRE(labels[i] == (y > x ? 5 : -7));
        REQUIRE(!(x > 2.5 && x < 3.5 && y > 0.5 && y < 1.5));
        *(y > x ? &above : &below) += area(points, ids);
    }
    /* Half of the square; the other half without the hole. */
    REQUIRE(fabs(above - 8) < 1e-12 && fabs(below - 7) < 1e-12);
    free(points);
    free(triangles);
    free(labels);
}

/* Two components, the first linear, the second only at inputs. */
static void attributes_reach_vertices(nm_mesh *mesh) {
    const uint64_t vertices = counts_of(mesh).vertices;
    double given[2 * input_count], *points = points_of(mesh), *found = allocate(2 * vertices, sizeof *found);
    uint64_t needed = 0, i;
    for (i = 0; i < input_count; ++i) {
        given[2 * i] = 1 + 2 * corners[2 * i] - 3 * corners[2 * i + 1];
        given[2 * i + 1] = (double)i;
    }
    REQUIRE(vertices > input_count);
    REQUIRE(nm_mesh_set_attributes(mesh, "plane", 1, corners) == NM_OK);
    REQUIRE(nm_mesh_set_attributes(mesh, "plane", 2, given) == NM_OK); /* replaces */
    REQUIRE(nm_mesh_set_input_attributes(mesh, "own", 2, given) == NM_OK);
    REQUIRE(nm_mesh_get_attributes(mesh, "plane", found, 2 * vertices - 1, &needed) == NM_CAPACITY);
    REQUIRE(needed == 2 * vertices);
    REQUIRE(nm_mesh_get_attributes(mesh, "plane", found, needed, NULL) == NM_OK);
    for (i = 0; i < vertices; ++i) {
        /* All vertices are in the hull of the inputs, where linear functions extend as they are. */
        const double expected = 1 + 2 * points[2 * i] - 3 * points[2 * i + 1];
        REQUIRE(fabs(found[2 * i] - expected) < 1e-13);
        REQUIRE(i >= input_count || (found[2 * i] == given[2 * i] && found[2 * i + 1] == (double)i));
        REQUIRE(found[2 * i + 1] >= 0 && found[2 * i + 1] <= input_count - 1);
    }
    REQUIRE(nm_mesh_get_attributes(mesh, "own", found, needed, NULL) == NM_OK);
    for (i = 0; i < 2 * vertices; ++i) REQUIRE(i < 2 * input_count ? found[i] == given[i] : isnan(found[i]));
    REQUIRE(nm_mesh_set_attributes(mesh, "plane", 0, NULL) == NM_OK); /* removes */
    REQUIRE(nm_mesh_get_attributes(mesh, "plane", found, needed, NULL) == NM_INVALID_ARGUMENT);
    REQUIRE(nm_mesh_set_attributes(mesh, "domain", 1, given) == NM_INVALID_ARGUMENT);
    REQUIRE(nm_mesh_set_input_attributes(mesh, "two words", 1, given) == NM_INVALID_ARGUMENT);
    REQUIRE(nm_mesh_set_input_attributes(mesh, NULL, 1, given) == NM_NULL_ARGUMENT);
    free(points);
    free(found);
}

static void columns_are_chosen(const char *directory) {
    static const char *const text = "id,north,height,east,class\n1,0.5,7.25,10,3\n2,1.5,-2,20,4\n3,0.5,1e3,30,5\n";
    const double expected[] = {10, 0.5, 20, 1.5, 30, 0.5}, heights[] = {7.25, -2, 1000}, kinds[] = {3, 4, 5};
    double found[3], *points;
    char path[1024];
    nm_mesh *mesh = NULL;
    FILE *file;
    snprintf(path, sizeof path, "%s/planar_inputs.csv", directory);
    file = fopen(path, "w");
    REQUIRE(file != NULL && fputs(text, file) >= 0 && fclose(file) == 0);
    REQUIRE(nm_mesh_create_from_columns(path, NM_FORMAT_AUTO, "east,north", "height,sort=5", &mesh) == NM_OK);
    REQUIRE(counts_of(mesh).dim == 2 && counts_of(mesh).inputs == 3);
    points = points_of(mesh);
    REQUIRE(memcmp(points, expected, sizeof expected) == 0);
    REQUIRE(nm_mesh_get_attributes(mesh, "height", found, 3, NULL) == NM_OK);
    REQUIRE(memcmp(found, heights, sizeof heights) == 0);
    REQUIRE(nm_mesh_get_attributes(mesh, "sort", found, 3, NULL) == NM_OK);
    REQUIRE(memcmp(found, kinds, sizeof kinds) == 0);
    REQUIRE(nm_mesh_get_attributes(mesh, "class", found, 3, NULL) == NM_INVALID_ARGUMENT);
    nm_mesh_free(mesh);
    free(points);
    /* Columns by number: the points are in space. */
    REQUIRE(nm_mesh_create_from_columns(path, NM_FORMAT_CSV, "2-4", NULL, &mesh) == NM_OK);
    REQUIRE(counts_of(mesh).dim == 3);
    nm_mesh_free(mesh);
    REQUIRE(nm_mesh_create_from_columns(path, NM_FORMAT_AUTO, "east,west", NULL, &mesh) == NM_INVALID_ARGUMENT);
    REQUIRE(mesh == NULL && remove(path) == 0);
}

typedef struct {
    char *text;
    size_t size;
} collected;

static int32_t collect(const void *data, size_t size, void *user_data) {
    collected *all = user_data;
    all->text = realloc(all->text, all->size + size + 1);
    REQUIRE(all->text != NULL);
    memcpy(all->text + all->size, data, size);
    all->size += size;
    all->text[all->size] = '\0';
    return 0;
}

/* The numbers of a section of a Medit file, which begins with their count. */
static double *section(const char *text, const char *name, uint64_t width, uint64_t *count) {
    const char *at = strstr(text, name);
    char *end;
    double *numbers;
    uint64_t i;
    REQUIRE(at != NULL);
    at += strlen(name);
    *count = (uint64_t)strtod(at, &end);
    numbers = allocate(*count * width, sizeof *numbers);
    for (i = 0; i < *count * width; ++i) {
        at = end;
        numbers[i] = strtod(at, &end);
        REQUIRE(end != at);
    }
    return numbers;
}

static int is_in_box(const double *x) {
    return x[0] >= 0 && x[0] <= 1 && x[1] >= 0 && x[1] <= 1;
}

/* The triangles whose vertices are in the unit square, which is the box of the inputs, and no others. */
static void selections_reach_files(const char *directory) {
    static const double inputs[] = {0, 0, 1, 0, 1, 1, 0, 1, 0.25, 0.5, 0.75, 0.625, 0.5, 0.125};
    nm_selection box = NM_SELECTION_INIT;
    nm_mesh *mesh = NULL;
    nm_options options;
    collected all = {NULL, 0};
    char path[1024], *again;
    double *points, *written, *numbers;
    uint32_t *triangles;
    uint64_t i, k, inside = 0, vertex_count, triangle_count;
    FILE *file;
    REQUIRE(nm_mesh_create(2, 7, inputs, 0, &mesh) == NM_OK);
    REQUIRE(nm_options_init(&options, sizeof options) == NM_OK);
    options.extent = NM_EXTENT_ALL;
    REQUIRE(nm_run(mesh, &options) == NM_OK);
    box.extent = NM_EXTENT_BOX;
    REQUIRE(nm_export_write_selected(mesh, &box, NM_FORMAT_MEDIT, collect, &all) == NM_OK);
    points = points_of(mesh);
    triangles = triangles_of(mesh);
    written = section(all.text, "Vertices", 3, &vertex_count);
    numbers = section(all.text, "Triangles", 4, &triangle_count);
    for (i = 0; i < counts_of(mesh).simplices; ++i) {
        const uint32_t *ids = triangles + 3 * i;
        int is_inside = 1, times = 0;
        for (k = 0; k < 3; ++k) is_inside &= is_in_box(points + 2 * ids[k]);
        inside += (uint64_t)is_inside;
        for (k = 0; k < triangle_count; ++k) {
            int same = 1, corner;
            for (corner = 0; corner < 3; ++corner) {
                const double *x = written + 3 * ((uint64_t)numbers[4 * k + (uint64_t)corner] - 1);
                same &= memcmp(x, points + 2 * ids[corner], 2 * sizeof *x) == 0;
            }
            times += same;
        }
        REQUIRE(times == is_inside);
    }
    REQUIRE(inside == triangle_count && inside > 0 && inside < counts_of(mesh).simplices);
    for (i = 0; i < vertex_count; ++i) REQUIRE(is_in_box(written + 3 * i));
    /* A file has the same bytes. */
    snprintf(path, sizeof path, "%s/planar_inputs.mesh", directory);
    REQUIRE(nm_export_selected(mesh, &box, path, NM_FORMAT_AUTO) == NM_OK);
    again = allocate(all.size, 1);
    file = fopen(path, "rb");
    REQUIRE(file != NULL && fread(again, 1, all.size + 1, file) == all.size && fclose(file) == 0);
    REQUIRE(memcmp(again, all.text, all.size) == 0 && remove(path) == 0);
    box.domain = 1000;
    REQUIRE(nm_export_selected(mesh, &box, path, NM_FORMAT_AUTO) == NM_INVALID_ARGUMENT);
    REQUIRE(fopen(path, "rb") == NULL);
    REQUIRE(nm_export_write_selected(mesh, NULL, NM_FORMAT_MEDIT, NULL, NULL) == NM_NULL_ARGUMENT);
    free(points);
    free(triangles);
    free(written);
    free(numbers);
    free(again);
    free(all.text);
    nm_mesh_free(mesh);
}

int main(int count, char **arguments) {
    nm_mesh *mesh;
    if (count != 2) {
        fprintf(stderr, "usage: planar_inputs <directory>\n");
        return 2;
    }
    mesh = drawing();
    segments_are_chains(mesh);
    regions_have_their_labels(mesh);
    attributes_reach_vertices(mesh);
    nm_mesh_free(mesh);
    columns_are_chosen(arguments[1]);
    selections_reach_files(arguments[1]);
    puts("planar_inputs: everything as expected");
    return 0;
}
