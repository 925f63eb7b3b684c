/* How soon a run stops: for a million (or argv[1]) uniform points in 3D, the time from the callback's
 * nonzero answer to nm_run's return, cancelled at several stages, and the largest gap between two
 * callbacks until then. The memory of the run is freed on the way: what a large state costs. With
 * `torus` as argv[2] n is the number of triangles of a torus instead, whose inside is meshed. */
#define _POSIX_C_SOURCE 199309L
#include <math.h>
#include <netmesh.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "../cpp_tests/support/uniform.h"

static double seconds(void) {
  struct timespec now;
  clock_gettime(CLOCK_MONOTONIC, &now);
  return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

struct watch {
  double stop_after, stop_fraction; /* seconds and fraction: both must be reached */
  int stop_phase;                   /* nm_phase, and so must this */
  double begun, last, largest, largest_at, stopped;
};

static int32_t progress(const nm_progress *report, void *user_data) {
  struct watch *watch = user_data;
  double now = seconds();
  if (now - watch->last > watch->largest) {
    watch->largest = now - watch->last;
    watch->largest_at = now - watch->begun;
  }
  int stop = now - watch->begun >= watch->stop_after && report->fraction >= watch->stop_fraction &&
             (int)report->phase >= watch->stop_phase;
  watch->last = seconds();
  watch->stopped = watch->last;
  return stop;
}

/* Makes a mesh with the two triangles of each of rings * sides squares of a torus for facets. */
static nm_mesh *torus(size_t rings, size_t sides) {
  const double turn = 6.283185307179586;
  double *points = malloc(3 * rings * sides * sizeof *points);
  uint32_t *triangles = malloc(6 * rings * sides * sizeof *triangles);
  nm_mesh *mesh = NULL;
  int is_made = points != NULL && triangles != NULL;
  for (size_t i = 0; is_made && i < rings; i++) {
    for (size_t j = 0; j < sides; j++) {
      double along = turn * (double)i / (double)rings, around = turn * (double)j / (double)sides;
      double width = 1 + 0.4 * cos(around), *x = &points[3 * (i * sides + j)];
      x[0] = width * cos(along), x[1] = width * sin(along), x[2] = 0.4 * sin(around);
      size_t next = (i + 1) % rings, beside = (j + 1) % sides;
      uint32_t a = (uint32_t)(i * sides + j), b = (uint32_t)(next * sides + j);
      uint32_t c = (uint32_t)(next * sides + beside), d = (uint32_t)(i * sides + beside);
      uint32_t both[] = {a, b, c, a, c, d};
      memcpy(&triangles[6 * (i * sides + j)], both, sizeof both);
    }
  }
  is_made = is_made && nm_mesh_create(3, rings * sides, points, 0, &mesh) == NM_OK &&
            nm_mesh_set_triangles(mesh, 2 * rings * sides, triangles, NULL) == NM_OK;
  free(points);
  free(triangles);
  return is_made ? mesh : NULL;
}

/* Makes a mesh of n points in the unit cube. */
static nm_mesh *cube(size_t n) {
  double *points = malloc(3 * n * sizeof *points);
  nm_mesh *mesh = NULL;
  if (points == NULL) return NULL;
  for (size_t i = 0; i < 3 * n; i++) points[i] = uniform();
  int is_made = nm_mesh_create(3, n, points, 0, &mesh) == NM_OK;
  free(points);
  return is_made ? mesh : NULL;
}

int main(int argc, char **argv) {
  const struct {
    const char *name;
    double after, fraction;
    int phase;
  } stages[] = {
      {"at once", 0, 0, NM_PHASE_PREPARE},        {"copying", 0.03, 0, NM_PHASE_PREPARE},
      {"homing", 0.5, 0, NM_PHASE_PREPARE},       {"a tenth", 0, 0.1, NM_PHASE_PREPARE},
      {"a half", 0, 0.5, NM_PHASE_PREPARE},       {"output", 0, 0, NM_PHASE_EXPORT},
      {"not at all", 0, 2, NM_PHASE_PREPARE},
  };
  size_t n = argc > 1 ? (size_t)strtoull(argv[1], NULL, 10) : 1000000;
  int is_torus = argc > 2 && strcmp(argv[2], "torus") == 0;
  /* Twice as many squares along as around: the way along is some 2.5 times as long. */
  size_t sides = (size_t)sqrt((double)n / 4);
  nm_mesh *mesh = is_torus ? torus(2 * sides, sides) : cube(n);
  if (mesh == NULL) return 1;
  for (size_t i = 0; i < sizeof stages / sizeof *stages; i++) {
    struct watch watch = {stages[i].after, stages[i].fraction, stages[i].phase, 0, 0, 0, 0, 0};
    nm_options options;
    if (nm_options_init(&options, sizeof options) != NM_OK) return 1;
    options.progress = progress;
    options.user_data = &watch;
    watch.begun = watch.last = seconds();
    nm_status status = nm_run(mesh, &options);
    double end = seconds();
    printf("%-10s %-12s after %6.2f s; last callback to return %6.1f ms; largest gap %6.1f ms, at %.2f s\n",
           stages[i].name, nm_status_name(status), end - watch.begun, 1e3 * (end - watch.stopped),
           1e3 * watch.largest, watch.largest_at);
    fflush(stdout);
  }
  nm_mesh_free(mesh);
  return 0;
}
