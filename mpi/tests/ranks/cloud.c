/*
 * Points of tests.
 */
#include "check.h"

#include <math.h>

/* L'Ecuyer's 64-bit multiplier; the upper bits. */
static double uniform(uint64_t *state)
{
    *state = *state * 2862933555777941757u + 3037000493u;
    return (double)(*state >> 11) / 9007199254740992.0;
}

static void point_of(const char *shape, uint32_t dim, uint64_t i, uint64_t count, uint64_t *state, double *point,
                     const double *before)
{
    double length = 0;
    for (uint32_t k = 0; k < dim; k++)
        point[k] = uniform(state);
    if (strcmp(shape, "clusters") == 0) {
        for (uint32_t k = 0; k < dim; k++)
            point[k] = (double)((i % 5) * (k + 3) % 7) + 0.01 * point[k] * point[k];
    } else if (strcmp(shape, "crowds") == 0) {
        /* Each far smaller than its distance to the next. */
        uint64_t crowd = i % (count / 50 + 1);
        for (uint32_t k = 0; k < dim; k++)
            point[k] = uniform(&crowd) + 1e-6 * point[k];
    } else if (strcmp(shape, "nested") == 0) {
        double scale = pow(10.0, -3.0 * (double)(i % 4));
        for (uint32_t k = 0; k < dim; k++)
            point[k] = scale * (point[k] - 0.5);
    } else if (strcmp(shape, "sphere") == 0) {
        for (uint32_t k = 0; k < dim; k++) {
            point[k] -= 0.5;
            length += point[k] * point[k];
        }
        for (uint32_t k = 0; k < dim; k++)
            point[k] /= sqrt(length);
    } else if (strcmp(shape, "lattice") == 0) {
        uint64_t side = (uint64_t)ceil(pow((double)count, 1.0 / dim)), rest = i;
        for (uint32_t k = 0; k < dim; k++, rest /= side)
            point[k] = (double)(rest % side);
    } else if (strcmp(shape, "duplicates") == 0) {
        /* Every third point is one that was there before, most of them on another rank. */
        if (i % 3 == 2)
            memcpy(point, before + (i * 7919 % i) * dim, dim * sizeof *point);
    } else {
        CHECK(strcmp(shape, "uniform") == 0);
    }
}

/* The first points of a text file that has a line for each. */
static void read_points(const char *path, uint32_t dim, uint64_t count, double *points)
{
    FILE *file = fopen(path, "r");
    CHECK(file != NULL);
    for (uint64_t i = 0; i < count * dim; i++)
        CHECK(fscanf(file, "%lf", points + i) == 1);
    fclose(file);
}

static uint64_t share_start(const char *shares, uint64_t count, uint64_t rank, uint64_t ranks)
{
    if (strcmp(shares, "first") == 0)
        return rank == 0 ? 0 : count;
    if (strcmp(shares, "last") == 0)
        return rank == ranks ? count : 0;
    if (strcmp(shares, "odd") == 0)
        return ranks == 1 ? count * rank : rank == ranks ? count : rank / 2 * count / (ranks / 2);
    if (strcmp(shares, "uneven") == 0)
        return count * rank * rank / (ranks * ranks);
    CHECK(strcmp(shares, "even") == 0);
    return count * rank / ranks;
}

cloud make_cloud(const char *shape, uint32_t dim, uint64_t count, const char *shares)
{
    int rank, ranks;
    MPI_Comm_rank(MPI_COMM_WORLD, &rank);
    MPI_Comm_size(MPI_COMM_WORLD, &ranks);
    cloud made = { dim, count, malloc(count * dim * sizeof(double)), 0, 0 };
    uint64_t state = 12345;
    CHECK(made.points != NULL);
    if (strchr(shape, '/') != NULL)
        read_points(shape, dim, count, made.points);
    for (uint64_t i = 0; strchr(shape, '/') == NULL && i < count; i++)
        point_of(shape, dim, i, count, &state, made.points + i * dim, made.points);
    made.first = share_start(shares, count, (uint64_t)rank, (uint64_t)ranks);
    made.local = share_start(shares, count, (uint64_t)rank + 1, (uint64_t)ranks) - made.first;
    return made;
}
