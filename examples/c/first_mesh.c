/* Six points in the plane, two of them close together, and how large their mesh is. */
#include "must.h"

int main(void)
{
    /* [first] */
    const double points[] = { 0, 0,   1, 0,   0, 1,   1, 1,   0.5, 0.50001,   0.5, 0.50002 };
    nm_mesh *mesh = NULL;
    must(nm_mesh_create(2, 6, points, 0, &mesh)); /* dimension, how many, where, stride */
    must(nm_run(mesh, NULL));                     /* NULL: the default options */

    nm_counts counts = NM_COUNTS_INIT;
    must(nm_mesh_counts(mesh, &counts));
    printf("%llu points, %llu vertices, %llu triangles\n", (unsigned long long)counts.inputs,
           (unsigned long long)counts.vertices, (unsigned long long)counts.simplices);
    /* [end] */
    expect(counts.inputs == 6 && counts.duplicates == 0, "six distinct inputs went in");
    expect(counts.vertices > 6 && counts.simplices > counts.vertices, "Steiner vertices were added");
    /* [free] */
    nm_mesh_free(mesh);
    /* [end] */
    return 0;
}
