/* What inputs of space may bring along, from C99: facets with loops of all kinds, triangles, segments,
 * regions and holes; and what is told of facets that cross. Each answer from the drawing itself.
 *
 *   spatial_inputs
 */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "netmesh.h"
#include "support/require.h"

/* A box of two cubes, with a wall between them. Inputs 0 to 3 are at x = 0, 4 to 7 at 1, 8 to 11 at 2;
 * of each four y and z are 0 0, 1 0, 1 1, 0 1. */
enum { input_count = 12, facet_count = 7, loop_count = 12, length = 45, most = 20000 };

static double corners[3 * input_count];

/* Both ends, the wall, and the sides from y = 0 on, each with a segment where the wall meets it. One end
 * has a vertex of its own as a loop. */
static const uint64_t loop_starts[facet_count + 1] = {0, 2, 3, 4, 6, 8, 10, 12};
static const uint64_t input_starts[loop_count + 1] = {0, 4, 5, 9, 13, 19, 21, 27, 29, 35, 37, 43, 45};
static const uint32_t inputs[length] = {0, 3, 2, 1, 2, /* x = 0, seen from outside */
                                            8, 9, 10, 11,  /* x = 2 */
                                            4, 5, 6, 7,    /* the wall */
                                            0, 4, 8, 11, 7, 3, 4, 7, 1, 2, 6, 10, 9, 5, 5, 6,
                                            0, 1, 5, 9, 8, 4, 4, 5, 2, 3, 7, 11, 10, 6, 6, 7};
static const int32_t markers[facet_count] = {10, -20, 30, 40, 50, 60, 70};
static const double areas[facet_count] = {1, 1, 1, 2, 2, 2, 2};
/* The coordinate that a facet's normal runs along, and where to: outwards, and at the wall to the right. */
static const int axes[facet_count] = {0, 0, 0, 1, 1, 2, 2}, looks[facet_count] = {-1, 1, 1, -1, 1, -1, 1};

static void *allocate(uint64_t count, size_t size) {
    void *memory = malloc((size_t)count * size + 1);
    REQUIRE(memory != NULL);
    return memory;
}

static nm_counts counts_of(const nm_mesh *mesh) {
    nm_counts counts = NM_COUNTS_INIT;
    REQUIRE(nm_mesh_counts(mesh, &counts) == NM_OK);
    return counts;
}

static nm_mesh *boxes(void) {
    nm_mesh *mesh = NULL;
    int i;
    for (i = 0; i < input_count; ++i) {
        corners[3 * i] = i / 4;
        corners[3 * i + 1] = i % 4 == 1 || i % 4 == 2;
        corners[3 * i + 2] = i % 4 >= 2;
    }
    REQUIRE(nm_mesh_create(3, input_count, corners, 0, &mesh) == NM_OK);
    REQUIRE(nm_mesh_set_facets(mesh, facet_count, loop_starts, input_starts, inputs, markers) == NM_OK);
    return mesh;
}

/* Twice the vector area of a triangle. */
static void normal(const double *points, const uint32_t *ids, double *out) {
    const double *a = points + 3 * ids[0], *b = points + 3 * ids[1], *c = points + 3 * ids[2];
    int k;
    for (k = 0; k < 3; ++k) {
        const int i = (k + 1) % 3, j = (k + 2) % 3;
        out[k] = (b[i] - a[i]) * (c[j] - a[j]) - (b[j] - a[j]) * (c[i] - a[i]);
    }
}

static double volume(const double *points, const uint32_t *ids) {
    const double *a = points + 3 * ids[0], *d = points + 3 * ids[3];
    double n[3];
    normal(points, ids, n);
    return (n[0] * (d[0] - a[0]) + n[1] * (d[1] - a[1]) + n[2] * (d[2] - a[2])) / 6;
}

/* The vertex of a simplex that is none of a triangle; ends the program unless the other three are. */
static uint32_t apex(const uint32_t *simplex, const uint32_t *triangle) {
    uint32_t found = NM_NONE;
    int i, others = 0;
    for (i = 0; i < 4; ++i) {
        if (simplex[i] == triangle[0] || simplex[i] == triangle[1] || simplex[i] == triangle[2]) {
            ++others;
        } else {
            found = simplex[i];
        }
    }
    REQUIRE(others == 3);
    return found;
}

/* Triangles lie in their facets, cover them, look where the facets look, and have simplices there. */
static void facets_are_tiled(const nm_mesh *mesh) {
    const nm_counts counts = counts_of(mesh);
    double covered[facet_count] = {0}, *points = allocate(3 * counts.vertices, sizeof *points);
    uint32_t *simplices = allocate(4 * counts.simplices, sizeof *simplices);
    uint32_t *triangles, *parents, *sides;
    uint64_t needed = 0, of_parents = 0, of_sides = 0, i;
    REQUIRE(nm_mesh_get_points(mesh, points, 3 * counts.vertices, NULL) == NM_OK);
    REQUIRE(nm_mesh_get_simplices(mesh, simplices, 4 * counts.simplices, NULL) == NM_OK);
    REQUIRE(nm_mesh_get_facet_triangles(mesh, NULL, 0, &needed) == NM_OK);
    REQUIRE(nm_mesh_get_facet_parents(mesh, NULL, 0, &of_parents) == NM_OK);
    REQUIRE(nm_mesh_get_facet_triangle_simplices(mesh, NULL, 0, &of_sides) == NM_OK);
    REQUIRE(needed == 3 * counts.facet_triangles && of_parents == counts.facet_triangles);
    REQUIRE(of_sides == 2 * counts.facet_triangles && of_parents >= 2 * facet_count);
    triangles = allocate(needed, sizeof *triangles);
    parents = allocate(of_parents, sizeof *parents);
    sides = allocate(of_sides, sizeof *sides);
    REQUIRE(nm_mesh_get_facet_triangles(mesh, triangles, needed - 1, &needed) == NM_CAPACITY);
    REQUIRE(nm_mesh_get_facet_triangles(mesh, triangles, needed, NULL) == NM_OK);
    REQUIRE(nm_mesh_get_facet_parents(mesh, parents, of_parents, NULL) == NM_OK);
    REQUIRE(nm_mesh_get_facet_triangle_simplices(mesh, sides, of_sides, NULL) == NM_OK);
    for (i = 0; i < of_parents; ++i) {
        const uint32_t *ids = triangles + 3 * i, parent = parents[i];
        double own[3];
        int k, axis;
        REQUIRE(parent < facet_count && (i == 0 || parents[i - 1] <= parent));
        axis = axes[parent];
        normal(points, ids, own);
        for (k = 0; k < 3; ++k) {
            /* Facets are square to an axis, where no rounding moves a vertex. */
            REQUIRE(points[3 * ids[k] + axis] == corners[3 * inputs[input_starts[loop_starts[parent]]] + axis]);
            REQUIRE(k == axis ? own[k] * looks[parent] > 0 : own[k] == 0);
        }
        covered[parent] += fabs(own[axis]) / 2;
        for (k = 0; k < 2; ++k) {
            const uint32_t simplex = sides[2 * i + k];
            double towards = 0;
            uint32_t top;
            int j;
            /* The box ends where all facets but the wall look. */
            REQUIRE((simplex == NM_NONE) == (k == 0 && parent != 2));
            if (simplex == NM_NONE) continue;
            REQUIRE(simplex < counts.simplices);
            top = apex(simplices + 4 * simplex, ids);
            for (j = 0; j < 3; ++j) towards += own[j] * (points[3 * top + j] - points[3 * ids[0] + j]);
            REQUIRE(k == 0 ? towards > 0 : towards < 0);
        }
    }
    for (i = 0; i < facet_count; ++i) REQUIRE(fabs(covered[i] - areas[i]) < 1e-12);
    free(points);
    free(simplices);
    free(triangles);
    free(parents);
    free(sides);
}

/* The volume of the simplices with a label, all of which are on one side of the wall. */
static double volume_of(const nm_mesh *mesh, int32_t label, int is_left) {
    const nm_counts counts = counts_of(mesh);
    double sum = 0, *points = allocate(3 * counts.vertices, sizeof *points);
    uint32_t *simplices = allocate(4 * counts.simplices, sizeof *simplices);
    int32_t *labels = allocate(counts.simplices, sizeof *labels);
    uint64_t needed = 0, i;
    REQUIRE(nm_mesh_get_points(mesh, points, 3 * counts.vertices, NULL) == NM_OK);
    REQUIRE(nm_mesh_get_simplices(mesh, simplices, 4 * counts.simplices, NULL) == NM_OK);
    REQUIRE(nm_mesh_get_simplex_regions(mesh, labels, counts.simplices, &needed) == NM_OK);
    REQUIRE(needed == counts.simplices);
    for (i = 0; i < counts.simplices; ++i) {
        const uint32_t *ids = simplices + 4 * i;
        int k;
        if (labels[i] != label) continue;
        for (k = 0; k < 4; ++k) REQUIRE(is_left ? points[3 * ids[k]] <= 1 : points[3 * ids[k]] >= 1);
        sum += volume(points, ids);
    }
    free(points);
    free(simplices);
    free(labels);
    return sum;
}

static void regions_are_between_facets(nm_mesh *mesh) {
    nm_region regions[2] = {NM_REGION_INIT, NM_REGION_INIT};
    nm_options options = NM_OPTIONS_INIT;
    nm_report report = NM_REPORT_INIT;
    nm_quality quality = NM_QUALITY_INIT;
    uint64_t needed = 7;
    int k;
    for (k = 0; k < 3; ++k) regions[0].seed[k] = regions[1].seed[k] = 0.5;
    regions[0].label = 5;
    regions[1].label = -7;
    regions[1].seed[0] = 1.5;
    REQUIRE(nm_mesh_set_regions(mesh, 2, regions) == NM_OK);
    REQUIRE(nm_mesh_get_facet_triangles(mesh, NULL, 0, &needed) == NM_STATE);
    REQUIRE(nm_mesh_get_facet_parents(mesh, NULL, 0, &needed) == NM_STATE);
    REQUIRE(nm_mesh_get_facet_triangle_simplices(mesh, NULL, 0, &needed) == NM_STATE && needed == 7);
    options.max_edge = 0.5;
    REQUIRE(nm_run(mesh, &options) == NM_OK);
    REQUIRE(nm_mesh_options(mesh, &options) == NM_OK);
    REQUIRE(options.extent == NM_EXTENT_BOUNDARY && options.coplanar == 0);
    facets_are_tiled(mesh);
    REQUIRE(fabs(volume_of(mesh, 5, 1) - 1) < 1e-12 && fabs(volume_of(mesh, -7, 0) - 1) < 1e-12);
    REQUIRE(nm_mesh_validate(mesh, 3, &report) == NM_OK && report.violations == 0);
    REQUIRE(nm_mesh_quality(mesh, &quality) == NM_OK && quality.flat == 0 && quality.forced == 0);
    REQUIRE(nm_mesh_get_flat_simplices(mesh, NULL, 0, &needed) == NM_OK && needed == 0);
    /* A hole is no part of the result, the wall bounds it. */
    regions[1].is_hole = 1;
    REQUIRE(nm_mesh_set_regions(mesh, 2, regions) == NM_OK);
    REQUIRE(nm_run(mesh, NULL) == NM_OK);
    REQUIRE(fabs(volume_of(mesh, 5, 1) - 1) < 1e-12 && volume_of(mesh, -7, 0) == 0);
}

/* A surface of triangles, with a segment besides; those of one marker in one plane are one facet. */
static void triangles_are_a_surface(void) {
    static const double points[] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0, 0, 0, 1,
                                    1, 0, 1, 0, 1, 1, 1, 1, 1, 0.25, 0.25, 0.5, 0.75, 0.5, 0.5};
    static const uint32_t sides[] = {0, 2, 1, 1, 2, 3, 4, 5, 6, 5, 7, 6, 0, 1, 4, 1, 5, 4,
                                     2, 6, 3, 3, 6, 7, 0, 4, 2, 2, 4, 6, 1, 3, 5, 3, 7, 5};
    static const int32_t same[12] = {3, 3, 4, 5};
    static const uint32_t segment[] = {8, 9};
    nm_mesh *mesh = NULL;
    uint64_t needed = 0, i;
    static uint32_t parents[most], edges[2 * most];
    int seen[12] = {0}, ends = 0;
    REQUIRE(nm_mesh_create(3, 10, points, 0, &mesh) == NM_OK);
    REQUIRE(nm_mesh_set_triangles(mesh, 12, sides, same) == NM_OK);
    REQUIRE(nm_mesh_set_segments(mesh, 1, segment, NULL) == NM_OK);
    REQUIRE(nm_run(mesh, NULL) == NM_OK);
    REQUIRE(nm_mesh_get_facet_parents(mesh, parents, most, &needed) == NM_OK);
    for (i = 0; i < needed; ++i) {
        REQUIRE(parents[i] < 12);
        seen[parents[i]] = 1;
    }
    /* Triangles 2 and 3 differ in their markers, the others are pairs. */
    for (i = 0; i < 12; ++i) REQUIRE(seen[i] == (i % 2 == 0 || i == 3));
    REQUIRE(nm_mesh_get_segment_parents(mesh, parents, most, &needed) == NM_OK);
    REQUIRE(nm_mesh_get_segments(mesh, edges, 2 * most, NULL) == NM_OK && parents[0] == 0);
    for (i = 0; i < needed; ++i) {
        REQUIRE(parents[i] == 0 || parents[i] == NM_NONE);
        if (parents[i] == 0) ends += (edges[2 * i] == 8) + (edges[2 * i + 1] == 9);
    }
    REQUIRE(ends == 2);
    nm_mesh_free(mesh);
}

static void crossings_are_told(void) {
    static const double points[] = {0, 0, 0, 4, 0, 0, 0, 4, 0, 1, 1, -1, 1, 1, 1, 9, 9, 1, 2, 2, 0, 2, 2, 5};
    static const uint32_t triangles[] = {0, 1, 2, 3, 4, 5}, segments[] = {6, 7, 0, 1};
    nm_mesh *mesh = NULL;
    nm_intersection found[3] = {NM_INTERSECTION_INIT};
    uint64_t needed = 7;
    char message[256];
    REQUIRE(nm_mesh_create(3, 8, points, 0, &mesh) == NM_OK);
    REQUIRE(nm_mesh_get_intersections(mesh, NULL, 0, &needed) == NM_OK && needed == 0);
    REQUIRE(nm_mesh_set_triangles(mesh, 2, triangles, NULL) == NM_OK);
    REQUIRE(nm_mesh_set_segments(mesh, 2, segments, NULL) == NM_OK);
    REQUIRE(nm_mesh_get_intersections(mesh, NULL, 0, &needed) == NM_OK && needed == 3);
    REQUIRE(nm_mesh_get_intersections(mesh, found, 2, &needed) == NM_CAPACITY);
    REQUIRE(nm_mesh_get_intersections(mesh, found, 3, NULL) == NM_OK);
    /* The triangles cross in a line from (1, 1, 0) to where x = y leaves the first; the first segment ends
     * on the side of the first triangle, and goes through the second. */
    REQUIRE(found[0].kind == NM_INTERSECTION_CROSS && found[0].first_feature == NM_FEATURE_FACET);
    REQUIRE(found[0].second_feature == NM_FEATURE_FACET && found[0].first == 0 && found[0].second == 1);
    REQUIRE(fabs(found[0].point[0] - found[0].point[1]) < 1e-15 && fabs(found[0].point[2]) < 1e-15);
    REQUIRE(found[1].kind == NM_INTERSECTION_TOUCH && found[1].second_feature == NM_FEATURE_SEGMENT);
    REQUIRE(found[1].first == 0 && found[1].second == 0 && found[1].struct_size == sizeof *found);
    REQUIRE(found[1].point[0] == 2 && found[1].point[1] == 2 && found[1].point[2] == 0);
    REQUIRE(found[2].first == 1 && found[2].second == 0 && found[2].second_feature == NM_FEATURE_SEGMENT);
    /* The run refuses, with the first. */
    REQUIRE(nm_run(mesh, NULL) == NM_INVALID_ARGUMENT);
    nm_last_error(message, sizeof message);
    REQUIRE(strstr(message, "[0]") != NULL && strstr(message, "[1]") != NULL);
    REQUIRE(nm_mesh_set_triangles(mesh, 0, NULL, NULL) == NM_OK);
    REQUIRE(nm_mesh_get_intersections(mesh, NULL, 0, &needed) == NM_OK && needed == 0);
    REQUIRE(nm_mesh_set_facets(mesh, 0, NULL, NULL, NULL, NULL) == NM_OK);
    nm_mesh_free(mesh);
}

/* A box without its lid is closed by two triangles, after those that were given. */
static void holes_are_closed(void) {
    static const double points[] = {0, 0, 0, 2, 0, 0, 0, 1, 0, 2, 1, 0, 0, 0, 1, 2, 0, 1, 0, 1, 1, 2, 1, 1};
    static const uint32_t sides[] = {0, 2, 1, 1, 2, 3, 0, 1, 4, 1, 5, 4, 2, 6, 3, 3, 6, 7,
                                     0, 4, 2, 2, 4, 6, 1, 3, 5, 3, 7, 5};
    nm_mesh *mesh = NULL;
    nm_closed_holes closed = NM_CLOSED_HOLES_INIT;
    static uint32_t parents[most];
    uint64_t needed = 0, lids = 0, i;
    REQUIRE(nm_mesh_create(3, 8, points, 0, &mesh) == NM_OK);
    REQUIRE(nm_mesh_set_triangles(mesh, 10, sides, NULL) == NM_OK);
    REQUIRE(nm_mesh_close_holes(mesh, 3, &closed) == NM_OK && closed.holes == 0 && closed.open_edges == 4);
    REQUIRE(nm_mesh_close_holes(mesh, 4, &closed) == NM_OK && closed.holes == 1 && closed.open_edges == 0);
    REQUIRE(closed.triangles == 2);
    REQUIRE(nm_run(mesh, NULL) == NM_OK);
    REQUIRE(nm_mesh_get_facet_parents(mesh, parents, most, &needed) == NM_OK);
    for (i = 0; i < needed; ++i) lids += parents[i] == 10;
    REQUIRE(lids >= 2);
    nm_mesh_free(mesh);
}

/* A polygon that is not plane is refused, and meshed as triangles. */
static void polygons_become_triangles(void) {
    static const double points[] = {0, 0, 0, 2, 0, 0, 2, 2, 0.5, 0, 2, 0, 1, 1, 2};
    static const uint32_t inputs[] = {0, 3, 2, 1, 0, 1, 4, 1, 2, 4, 2, 3, 4, 3, 0, 4};
    static const uint64_t loops[] = {0, 1, 2, 3, 4, 5}, starts[] = {0, 4, 7, 10, 13, 16};
    nm_mesh *mesh = NULL;
    uint64_t polygons = 9;
    nm_counts counts = NM_COUNTS_INIT;
    REQUIRE(nm_mesh_create(3, 5, points, 0, &mesh) == NM_OK);
    REQUIRE(nm_mesh_set_facets(mesh, 5, loops, starts, inputs, NULL) == NM_OK);
    REQUIRE(nm_run(mesh, NULL) == NM_INVALID_ARGUMENT);
    REQUIRE(nm_mesh_triangulate_facets(mesh, &polygons) == NM_OK && polygons == 5);
    REQUIRE(nm_mesh_triangulate_facets(mesh, &polygons) == NM_OK && polygons == 0);
    REQUIRE(nm_mesh_triangulate_facets(mesh, NULL) == NM_OK);
    REQUIRE(nm_mesh_triangulate_facets(NULL, &polygons) == NM_NULL_ARGUMENT);
    REQUIRE(nm_run(mesh, NULL) == NM_OK);
    REQUIRE(nm_mesh_counts(mesh, &counts) == NM_OK && counts.simplices > 0);
    nm_mesh_free(mesh);
}

/* A corner that is there twice, some roundings apart, becomes one. */
static void corners_are_merged(void) {
    double points[] = {0, 0, 0, 1, 0, 0, 1e-17, 0, 3e-33, 0, 1, 0};
    uint64_t moved = 0;
    REQUIRE(nm_merge_points(3, 4, points, 1e-9, &moved) == NM_OK && moved == 1);
    REQUIRE(points[6] == 0 && points[8] == 0);
    REQUIRE(nm_merge_points(3, 4, points, 0.5, &moved) == NM_INVALID_ARGUMENT);
}

static void odd_edges_are_told(void) {
    /* A tetrahedron whose second triangle is turned round, the last input equal to the first, and a
     * triangle that stands on its first edge. */
    static const double points[] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0.5, -1, -1, 0, 0, 0};
    static const uint32_t triangles[] = {0, 2, 1, 5, 3, 1, 1, 2, 3, 2, 0, 3, 5, 1, 4};
    static const nm_edge_fault faults[] = {NM_EDGE_CROWDED, NM_EDGE_TURNED, NM_EDGE_OPEN, NM_EDGE_TURNED,
                                           NM_EDGE_OPEN};
    static const uint32_t ends[] = {0, 1, 0, 3, 0, 4, 1, 3, 1, 4}, counts[] = {3, 2, 1, 2, 1};
    nm_mesh *mesh = NULL;
    nm_odd_edge found[5] = {NM_ODD_EDGE_INIT};
    uint64_t needed = 7;
    int i;
    REQUIRE(nm_mesh_create(3, 6, points, 0, &mesh) == NM_OK);
    REQUIRE(nm_mesh_get_odd_edges(mesh, NULL, 0, &needed) == NM_OK && needed == 0);
    REQUIRE(nm_mesh_set_triangles(mesh, 5, triangles, NULL) == NM_OK);
    REQUIRE(nm_mesh_get_odd_edges(mesh, NULL, 0, &needed) == NM_OK && needed == 5);
    REQUIRE(nm_mesh_get_odd_edges(mesh, found, 4, &needed) == NM_CAPACITY);
    REQUIRE(nm_mesh_get_odd_edges(mesh, found, 5, NULL) == NM_OK);
    for (i = 0; i < 5; ++i) {
        REQUIRE(found[i].fault == faults[i] && found[i].facets == counts[i]);
        REQUIRE(found[i].inputs[0] == ends[2 * i] && found[i].inputs[1] == ends[2 * i + 1]);
        REQUIRE(found[i].struct_size == sizeof *found);
    }
    /* The tetrahedron alone is closed. */
    REQUIRE(nm_mesh_set_triangles(mesh, 4, (const uint32_t[]){0, 2, 1, 0, 1, 3, 1, 2, 3, 2, 0, 3}, NULL) == NM_OK);
    REQUIRE(nm_mesh_get_odd_edges(mesh, found, 0, &needed) == NM_OK && needed == 0);
    nm_mesh_free(mesh);
}

/* A turned cube whose sides are squares of a lattice: four points of a square are on one circle but for
 * roundings, and some tetrahedra are between its two diagonals. */
static void flat_simplices_are_told(void) {
    enum { along = 4, squares = 6 * (along - 1) * (along - 1) };
    static const double turn[3][3] = {{0.36, 0.48, -0.8}, {-0.8, 0.6, 0.0}, {0.48, 0.64, 0.6}};
    static double points[along * along * along * 3];
    static uint64_t loops[squares + 1], starts[squares + 1];
    static uint32_t corners_of[4 * squares];
    nm_mesh *mesh = NULL;
    nm_quality quality = NM_QUALITY_INIT;
    nm_counts counts;
    uint32_t *simplices, *flat;
    double *vertices;
    uint64_t needed = 0, i, count = 0;
    int axis, side, u, v, k;
    for (i = 0; i < along * along * along; ++i) {
        const double place[3] = {(double)(i / 16), (double)(i / 4 % 4), (double)(i % 4)};
        for (k = 0; k < 3; ++k)
            points[3 * i + k] = (turn[k][0] * place[0] + turn[k][1] * place[1] + turn[k][2] * place[2]) / 3 + 0.7;
    }
    for (axis = 0; axis < 3; ++axis)
        for (side = 0; side < along; side += along - 1)
            for (u = 0; u + 1 < along; ++u)
                for (v = 0; v + 1 < along; ++v) {
                    static const int ring[4][2] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
                    static const int steps[3] = {16, 4, 1};
                    const int across = steps[(axis + 1) % 3], up = steps[(axis + 2) % 3];
                    for (k = 0; k < 4; ++k)
                        corners_of[4 * count + k] =
                            (uint32_t)(side * steps[axis] + (u + ring[k][0]) * across + (v + ring[k][1]) * up);
                    loops[count] = count;
                    starts[count] = 4 * count;
                    ++count;
                }
    loops[count] = count;
    starts[count] = 4 * count;
    REQUIRE(nm_mesh_create(3, along * along * along, points, 0, &mesh) == NM_OK);
    REQUIRE(nm_mesh_set_facets(mesh, squares, loops, starts, corners_of, NULL) == NM_OK);
    REQUIRE(nm_mesh_get_flat_simplices(mesh, NULL, 0, &needed) == NM_STATE);
    REQUIRE(nm_run(mesh, NULL) == NM_OK && nm_mesh_quality(mesh, &quality) == NM_OK && quality.flat > 0);
    REQUIRE(nm_mesh_get_flat_simplices(mesh, NULL, 0, &needed) == NM_OK && needed == quality.flat);
    counts = counts_of(mesh);
    flat = allocate(needed, sizeof *flat);
    vertices = allocate(3 * counts.vertices, sizeof *vertices);
    simplices = allocate(4 * counts.simplices, sizeof *simplices);
    REQUIRE(nm_mesh_get_flat_simplices(mesh, flat, needed, &needed) == NM_OK);
    REQUIRE(nm_mesh_get_points(mesh, vertices, 3 * counts.vertices, NULL) == NM_OK);
    REQUIRE(nm_mesh_get_simplices(mesh, simplices, 4 * counts.simplices, NULL) == NM_OK);
    for (i = 0; i < needed; ++i) {
        REQUIRE(flat[i] < counts.simplices && (i == 0 || flat[i - 1] < flat[i]));
        REQUIRE(fabs(volume(vertices, simplices + 4 * flat[i])) < 1e-12);
    }
    free(flat);
    free(vertices);
    free(simplices);
    nm_mesh_free(mesh);
}

int main(void) {
    nm_mesh *mesh;
    holes_are_closed();
    polygons_become_triangles();
    corners_are_merged();
    crossings_are_told();
    odd_edges_are_told();
    mesh = boxes();
    regions_are_between_facets(mesh);
    nm_mesh_free(mesh);
    triangles_are_a_surface();
    flat_simplices_are_told();
    puts("spatial_inputs: everything as expected");
    return 0;
}
