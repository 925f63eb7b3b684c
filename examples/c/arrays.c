/* The arrays of a mesh: vertices, simplices, neighbours, kinds, and where each input is. */
#include "must.h"

#include <string.h>

enum { DIM = 2, POINTS = 1000 };

/* Twice the area of a triangle, positive if its vertices are counterclockwise. */
static double doubled_area(const double *points, const uint32_t *vertices)
{
    const double *a = points + DIM * vertices[0], *b = points + DIM * vertices[1],
                 *c = points + DIM * vertices[2];
    return (b[0] - a[0]) * (c[1] - a[1]) - (c[0] - a[0]) * (b[1] - a[1]);
}

/* The third vertex is opposite to the edge of the other two; neighbours share that edge. */
static int shares_edge(const uint32_t *triangle, int opposite, const uint32_t *other)
{
    int shared = 0;
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j)
            shared += i != opposite && triangle[i] == other[j];
    return shared == 2;
}

int main(void)
{
    double *inputs = uniform_points(POINTS, DIM);
    nm_mesh *mesh = NULL;
    must(nm_mesh_create(DIM, POINTS, inputs, 0, &mesh));
    must(nm_run(mesh, NULL));

    /* [arrays] */
    nm_counts counts = NM_COUNTS_INIT;
    must(nm_mesh_counts(mesh, &counts));
    const uint64_t coordinates = counts.vertices * DIM, ids = counts.simplices * (DIM + 1);

    double *points = malloc(coordinates * sizeof *points);
    uint32_t *triangles = malloc(ids * sizeof *triangles);
    uint32_t *neighbors = malloc(ids * sizeof *neighbors);
    uint8_t *kinds = malloc(counts.vertices);
    expect(points && triangles && neighbors && kinds, "there is memory for the arrays");
    must(nm_mesh_get_points(mesh, points, coordinates, NULL));    /* x0 y0 x1 y1 ... */
    must(nm_mesh_get_simplices(mesh, triangles, ids, NULL));      /* three vertices each */
    must(nm_mesh_get_neighbors(mesh, neighbors, ids, NULL));      /* opposite these vertices */
    must(nm_mesh_get_vertex_kinds(mesh, kinds, counts.vertices, NULL));
    /* [end] */

    expect(memcmp(points, inputs, sizeof *points * POINTS * DIM) == 0,
           "the inputs are the first vertices, bit for bit");
    for (uint64_t v = 0; v < counts.vertices; ++v)
        expect((kinds[v] == NM_VERTEX_INPUT) == (v < POINTS), "kinds tell inputs from the others");

    /* [walk] */
    double area = 0;
    uint64_t hull_edges = 0;
    for (uint64_t t = 0; t < counts.simplices; ++t) {
        const uint32_t *vertices = triangles + 3 * t;
        area += doubled_area(points, vertices) / 2;
        for (int i = 0; i < 3; ++i) {
            uint32_t neighbor = neighbors[3 * t + i];
            if (neighbor == NM_NONE) /* the edge opposite vertex i is on the hull */
                ++hull_edges;
            else
                expect(shares_edge(vertices, i, triangles + 3 * neighbor), "neighbours share an edge");
        }
    }
    /* [end] */
    printf("area %.3f, %llu edges on the hull\n", area, (unsigned long long)hull_edges);
    expect(area > 1, "the mesh covers the square of the inputs");
    /* Euler: in a triangulated disc, triangles = 2 (vertices - 1) - edges of the hull. */
    expect(counts.simplices == 2 * (counts.vertices - 1) - hull_edges, "the mesh is a disc");

    free(kinds);
    free(neighbors);
    free(triangles);
    free(points);
    free(inputs);
    nm_mesh_free(mesh);
    return 0;
}
