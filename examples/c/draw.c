/* The mesh of a file of points in the plane as a picture: draw POINTS PICTURE.svg
 *
 * Inputs are blue, Steiner vertices orange and cage vertices green; the frame is that of
 * the inputs, and the mesh goes on beyond it. */
#include "must.h"

#include <math.h>

enum { DIM = 2, WIDTH = 1000 };

static const char *const styles[] = {
    "fill=\"#1a4f8b\"", /* NM_VERTEX_INPUT */
    "fill=\"#e08214\"", /* NM_VERTEX_STEINER */
    "fill=\"#00846b\"", /* NM_VERTEX_CAGE */
};

/* What the picture shows of the plane, and how large. */
typedef struct {
    double left, top, width, height, scale;
} frame;

/* The inputs' bounding box, and some room around it; of inputs in one point, anything. */
static frame frame_of(const double *points, uint64_t inputs)
{
    double low[DIM] = { HUGE_VAL, HUGE_VAL }, high[DIM] = { -HUGE_VAL, -HUGE_VAL };
    for (uint64_t i = 0; i < DIM * inputs; ++i) {
        low[i % DIM] = fmin(low[i % DIM], points[i]);
        high[i % DIM] = fmax(high[i % DIM], points[i]);
    }
    double room = 0.03 * fmax(high[0] - low[0], high[1] - low[1]);
    if (room == 0)
        room = 1;
    frame shown = { low[0] - room, high[1] + room, high[0] - low[0] + 2 * room,
                    high[1] - low[1] + 2 * room, 0 };
    shown.scale = WIDTH / shown.width;
    return shown;
}

static double across(const frame *shown, const double *point)
{
    return (point[0] - shown->left) * shown->scale;
}

static double down(const frame *shown, const double *point)
{
    return (shown->top - point[1]) * shown->scale;
}

static int is_shown(const frame *shown, const double *point)
{
    const double x = across(shown, point), y = down(shown, point);
    return x >= 0 && x <= WIDTH && y >= 0 && y <= shown->height * shown->scale;
}

int main(int argc, char **argv)
{
    if (argc != 3) {
        fprintf(stderr, "usage: %s POINTS PICTURE.svg\n", argv[0]);
        return 2;
    }
    nm_mesh *mesh = NULL;
    must(nm_mesh_create_from_file(argv[1], NM_FORMAT_AUTO, &mesh));
    must(nm_run(mesh, NULL));
    nm_counts counts = NM_COUNTS_INIT;
    must(nm_mesh_counts(mesh, &counts));
    expect(counts.dim == DIM, "the file has two columns (of a mesh in space, nm_export a .vtu)");

    const uint64_t coordinates = DIM * counts.vertices, ids = 3 * counts.simplices;
    double *points = malloc(coordinates * sizeof *points);
    uint32_t *triangles = malloc(ids * sizeof *triangles);
    uint32_t *neighbors = malloc(ids * sizeof *neighbors);
    uint8_t *kinds = malloc(counts.vertices);
    expect(points && triangles && neighbors && kinds, "there is memory for the arrays");
    must(nm_mesh_get_points(mesh, points, coordinates, NULL));
    must(nm_mesh_get_simplices(mesh, triangles, ids, NULL));
    must(nm_mesh_get_neighbors(mesh, neighbors, ids, NULL));
    must(nm_mesh_get_vertex_kinds(mesh, kinds, counts.vertices, NULL));

    FILE *picture = fopen(argv[2], "w");
    expect(picture != NULL, "the picture can be written");
    const frame shown = frame_of(points, counts.inputs - counts.duplicates);
    fprintf(picture, "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 %d %.0f\">\n", WIDTH,
            shown.height * shown.scale);
    fprintf(picture, "<rect width=\"100%%\" height=\"100%%\" fill=\"white\"/>\n<path fill=\"none\" "
                     "stroke=\"#b0b0b0\" stroke-width=\"0.5\" d=\"");
    uint64_t edges = 0;
    for (uint64_t at = 0; at < ids; ++at) {
        /* The edge opposite this vertex, drawn from the side of the triangle with the larger id. */
        const uint64_t triangle = at / 3, vertex = at % 3;
        if (neighbors[at] != NM_NONE && neighbors[at] > triangle)
            continue;
        const double *a = points + DIM * triangles[3 * triangle + (vertex + 1) % 3];
        const double *b = points + DIM * triangles[3 * triangle + (vertex + 2) % 3];
        ++edges;
        if (is_shown(&shown, a) || is_shown(&shown, b))
            fprintf(picture, "M%.2f %.2fL%.2f %.2f", across(&shown, a), down(&shown, a),
                    across(&shown, b), down(&shown, b));
    }
    fprintf(picture, "\"/>\n");
    for (uint64_t v = counts.vertices; v-- > 0;) /* the inputs on top */
        if (is_shown(&shown, points + DIM * v))
            fprintf(picture, "<circle cx=\"%.2f\" cy=\"%.2f\" r=\"1.2\" %s/>\n",
                    across(&shown, points + DIM * v), down(&shown, points + DIM * v), styles[kinds[v]]);
    fprintf(picture, "</svg>\n");
    expect(fclose(picture) == 0, "the picture is written");
    /* Euler, for a triangulated disc. */
    expect(edges == counts.vertices + counts.simplices - 1, "every edge was met once");
    printf("%s: %llu points, %llu vertices, %llu edges\n", argv[2], (unsigned long long)counts.inputs,
           (unsigned long long)counts.vertices, (unsigned long long)edges);

    free(kinds);
    free(neighbors);
    free(triangles);
    free(points);
    nm_mesh_free(mesh);
    return 0;
}
