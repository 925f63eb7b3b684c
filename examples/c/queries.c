/* Questions to a mesh: where points are, what is near them, what a function is there; ready arrays. */
#include "must.h"

#include <math.h>

enum { DIM = 2, POINTS = 1000, ASKED = 500 };

/* A function that the mesh knows at the inputs only. */
static double height(const double *point)
{
    return 3 * point[0] - point[1];
}

static void ask(const nm_mesh *mesh, const double *values)
{
    double *points = uniform_points(ASKED, DIM);
    /* [queries] */
    uint32_t simplices[ASKED], nearest[ASKED];
    double distances[ASKED], found[ASKED];
    must(nm_mesh_locate(mesh, ASKED, points, 0, simplices)); /* 0: all cores */
    must(nm_mesh_nearest(mesh, ASKED, points, 0, nearest, distances));
    must(nm_mesh_interpolate(mesh, NM_INTERPOLATION_SIBSON, 1, values, ASKED, points, 0, found));
    /* [end] */
    for (int i = 0; i < ASKED; ++i)
        expect(simplices[i] != NM_NONE && distances[i] < 0.2, "the points are in the mesh");
    free(points);
}

int main(void)
{
    double *inputs = uniform_points(POINTS, DIM);
    double *heights = malloc(POINTS * sizeof *heights);
    expect(heights != NULL, "there is memory for the values");
    for (int i = 0; i < POINTS; ++i)
        heights[i] = height(inputs + DIM * i);
    nm_mesh *mesh = NULL;
    must(nm_mesh_create(DIM, POINTS, inputs, 0, &mesh));
    must(nm_run(mesh, NULL));
    nm_counts counts = NM_COUNTS_INIT;
    must(nm_mesh_counts(mesh, &counts));

    /* [values] */
    double *values = malloc(counts.vertices * sizeof *values);
    expect(values != NULL, "there is memory for the values");
    must(nm_mesh_extend_values(mesh, 1, heights, values)); /* from the inputs to all vertices */
    /* [end] */
    for (int i = 0; i < POINTS; ++i)
        expect(values[i] == heights[i], "the inputs keep their values");
    ask(mesh, values);

    /* [selection] */
    nm_selection inside = NM_SELECTION_INIT;
    inside.extent = NM_EXTENT_HULL;
    uint64_t needed = 0;
    must(nm_mesh_get_volumes(mesh, &inside, NULL, 0, &needed));
    double *areas = malloc(needed * sizeof *areas);
    expect(areas != NULL, "there is memory for the areas");
    must(nm_mesh_get_volumes(mesh, &inside, areas, needed, NULL));
    /* [end] */
    double area = 0;
    for (uint64_t i = 0; i < needed; ++i)
        area += areas[i];
    expect(area > 0.5 && area < 1, "what is inside the hull fills most of the unit square");

    free(areas);
    free(values);
    free(heights);
    free(inputs);
    nm_mesh_free(mesh);
    return 0;
}
