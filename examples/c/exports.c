/* Meshes as files and as bytes: exports DIRECTORY */
#include "must.h"

#include <string.h>

enum { DIM = 3, POINTS = 500 };

/* [sink] */
static int32_t count_bytes(const void *data, size_t size, void *user_data)
{
    (void)data;
    *(uint64_t *)user_data += size;
    return 0; /* anything else stops the export */
}
/* [end] */

static uint64_t inputs(const nm_mesh *mesh)
{
    nm_counts counts = NM_COUNTS_INIT;
    must(nm_mesh_counts(mesh, &counts));
    return counts.vertices;
}

static uint64_t file_size(const char *path)
{
    FILE *file = fopen(path, "rb");
    expect(file != NULL && fseek(file, 0, SEEK_END) == 0, "the file is there");
    long size = ftell(file);
    fclose(file);
    return (uint64_t)size;
}

int main(int argc, char **argv)
{
    char vtu[1024], node[1024];
    if (argc != 2) {
        fprintf(stderr, "usage: %s DIRECTORY\n", argv[0]);
        return 2;
    }
    snprintf(vtu, sizeof vtu, "%s/exports.vtu", argv[1]);
    snprintf(node, sizeof node, "%s/exports.node", argv[1]);

    double *points = uniform_points(POINTS, DIM);
    nm_mesh *mesh = NULL, *again = NULL;
    uint64_t bytes = 0;
    must(nm_mesh_create(DIM, POINTS, points, 0, &mesh));
    free(points);
    must(nm_run(mesh, NULL));

    /* [exports] */
    must(nm_export(mesh, vtu, NM_FORMAT_AUTO));  /* .vtu: for ParaView */
    must(nm_export(mesh, node, NM_FORMAT_AUTO)); /* .node, and .ele beside it */
    must(nm_export_write(mesh, NM_FORMAT_VTU, count_bytes, &bytes)); /* no file at all */
    must(nm_mesh_create_from_file(node, NM_FORMAT_AUTO, &again));    /* the points of a file */
    /* [end] */
    expect(bytes == file_size(vtu), "the callback received what the file holds");
    expect(inputs(again) == inputs(mesh), "the file has every vertex");
    expect(nm_export(mesh, "no/such/directory/mesh.vtu", NM_FORMAT_AUTO) == NM_IO,
           "what cannot be written is reported");

    nm_mesh_free(again);
    nm_mesh_free(mesh);
    return 0;
}
