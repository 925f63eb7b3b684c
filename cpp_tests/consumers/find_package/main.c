/* mesher POINTS MESH: meshes a file of points into another file. */
#include <inttypes.h>
#include <stdio.h>

#include <netmesh.h>

static nm_status mesh_file(const char *points, const char *path, nm_mesh **mesh, nm_counts *counts)
{
    nm_status status = nm_mesh_create_from_file(points, NM_FORMAT_AUTO, mesh);
    if (status == NM_OK)
        status = nm_run(*mesh, NULL);
    if (status == NM_OK)
        status = nm_mesh_counts(*mesh, counts);
    if (status == NM_OK)
        status = nm_export(*mesh, path, NM_FORMAT_AUTO);
    return status;
}

int main(int argc, char **argv)
{
    nm_mesh *mesh = NULL;
    nm_counts counts = NM_COUNTS_INIT;
    if (argc != 3)
        return 2;
    if (mesh_file(argv[1], argv[2], &mesh, &counts) != NM_OK) {
        char message[256];
        nm_last_error(message, sizeof message);
        fprintf(stderr, "%s\n", message);
        nm_mesh_free(mesh);
        return 1;
    }
    printf("netmesh %s: %" PRIu64 " points, %" PRIu64 " vertices, %" PRIu64 " simplices, %" PRIu64 " domains\n",
           nm_version(), counts.inputs, counts.vertices, counts.simplices, counts.domains);
    nm_mesh_free(mesh);
    return 0;
}
