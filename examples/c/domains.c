/* The hierarchy of domains: clusters within clusters, each a thousand times smaller than the last. */
#include "must.h"

#include <math.h>

enum { DIM = 2, LEVELS = 4, PER_LEVEL = 50, POINTS = LEVELS * PER_LEVEL };

static double *nested_points(void)
{
    double *points = uniform_points(POINTS, DIM);
    for (int i = 0; i < POINTS * DIM; ++i)
        points[i] = (points[i] - 0.5) * pow(1e-3, i / (PER_LEVEL * DIM));
    return points;
}

int main(void)
{
    double *inputs = nested_points();
    nm_mesh *mesh = NULL;
    must(nm_mesh_create(DIM, POINTS, inputs, 0, &mesh));
    free(inputs);
    must(nm_run(mesh, NULL));

    nm_counts counts = NM_COUNTS_INIT;
    must(nm_mesh_counts(mesh, &counts));
    double *points = malloc(counts.vertices * DIM * sizeof *points);
    expect(points != NULL, "there is memory for the vertices");
    must(nm_mesh_get_points(mesh, points, counts.vertices * DIM, NULL));

    /* [domains] */
    nm_domain *domains = malloc(counts.domains * sizeof *domains);
    uint32_t *domain_of = malloc(counts.vertices * sizeof *domain_of);
    expect(domains && domain_of, "there is memory for the domains");
    must(nm_mesh_get_domains(mesh, domains, counts.domains, NULL));
    must(nm_mesh_get_vertex_domains(mesh, domain_of, counts.vertices, NULL));
    for (uint64_t d = 0; d < counts.domains; ++d) {
        const double *center = points + DIM * domains[d].center;
        printf("domain %llu: radius %.3g around (%.3g, %.3g), inside domain %d\n",
               (unsigned long long)d, domains[d].radius, center[0], center[1],
               domains[d].parent == NM_NONE ? -1 : (int)domains[d].parent);
    }
    printf("input 0 is in domain %u, the last one in domain %u\n", (unsigned)domain_of[0],
           (unsigned)domain_of[POINTS - 1]);
    /* [end] */

    double smallest = domains[0].radius;
    for (uint64_t d = 1; d < counts.domains; ++d) {
        expect(domains[d].parent < d, "parents stand before their children");
        expect(domains[d].radius < domains[domains[d].parent].radius, "children are smaller");
        if (domains[d].radius < smallest)
            smallest = domains[d].radius;
    }
    expect(domains[0].parent == NM_NONE, "domain 0 is the root");
    expect(counts.domains >= LEVELS, "each cluster is in a domain of its own");
    expect(domains[domain_of[POINTS - 1]].radius < domains[domain_of[0]].radius / 1000,
           "the last input is in a domain of its cluster");
    expect(smallest < 1e-8, "the innermost domain is as small as the innermost cluster");
    /* What refines across the scales pays for each power of two between them. */
    expect(counts.vertices < 10 * POINTS, "the mesh is of linear size");

    free(domain_of);
    free(domains);
    free(points);
    nm_mesh_free(mesh);
    return 0;
}
