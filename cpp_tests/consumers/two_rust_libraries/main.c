/* mesher POINTS MESH: as the other meshers, with another library at work before and after. */
#include <inttypes.h>
#include <stdio.h>

#include "netmesh.h"

/* Of the second library: 3. */
uint32_t second_answer(void);

int main(int argc, char **argv)
{
    nm_mesh *mesh = NULL;
    nm_counts counts = NM_COUNTS_INIT;
    if (argc != 3)
        return 2;
    if (second_answer() != 3) {
        fprintf(stderr, "the second library fails before the first has run\n");
        return 1;
    }
    if (nm_mesh_create_from_file(argv[1], NM_FORMAT_AUTO, &mesh) != NM_OK || nm_run(mesh, NULL) != NM_OK ||
        nm_mesh_counts(mesh, &counts) != NM_OK || nm_export(mesh, argv[2], NM_FORMAT_AUTO) != NM_OK) {
        char message[256];
        nm_last_error(message, sizeof message);
        fprintf(stderr, "%s\n", message);
        return 1;
    }
    nm_mesh_free(mesh);
    if (second_answer() != 3) {
        fprintf(stderr, "the second library fails after the first has run\n");
        return 1;
    }
    printf("netmesh %s: %" PRIu64 " points, %" PRIu64 " vertices, %" PRIu64 " simplices, %" PRIu64 " domains\n",
           nm_version(), counts.inputs, counts.vertices, counts.simplices, counts.domains);
    return 0;
}
