/* mesher POINTS MESH: reads two columns of numbers itself, and writes and counts their mesh. */
#include <stdio.h>
#include <stdlib.h>

#include "netmesh.h"

enum { LIMIT = 1000 };

/* Numbers in the file; 0 if there are none or too many. */
static size_t read_numbers(const char *path, double *numbers)
{
    FILE *file = fopen(path, "r");
    size_t count = 0;
    if (file == NULL)
        return 0;
    while (count < LIMIT && fscanf(file, "%lf", &numbers[count]) == 1)
        ++count;
    fclose(file);
    return count == LIMIT ? 0 : count;
}

static void require(nm_status status)
{
    char message[256];
    if (status == NM_OK)
        return;
    nm_last_error(message, sizeof message);
    fprintf(stderr, "%s: %s\n", nm_status_name(status), message);
    exit(1);
}

int main(int argc, char **argv)
{
    double numbers[LIMIT];
    nm_mesh *mesh = NULL;
    nm_counts counts = NM_COUNTS_INIT;
    uint64_t coordinates = 0;
    uint64_t simplex_ids = 0;
    size_t count;
    if (argc != 3 || (count = read_numbers(argv[1], numbers)) == 0)
        return 2;
    require(nm_mesh_create(2, count / 2, numbers, 0, &mesh));
    require(nm_run(mesh, NULL));
    require(nm_mesh_get_points(mesh, NULL, 0, &coordinates));
    require(nm_mesh_get_simplices(mesh, NULL, 0, &simplex_ids));
    require(nm_mesh_counts(mesh, &counts));
    require(nm_export(mesh, argv[2], NM_FORMAT_AUTO));
    printf("netmesh %s: %lu points, %lu vertices, %lu simplices, %lu domains\n", nm_version(),
           (unsigned long)(count / 2), (unsigned long)(coordinates / 2), (unsigned long)(simplex_ids / 3),
           (unsigned long)counts.domains);
    nm_mesh_free(mesh);
    return 0;
}
