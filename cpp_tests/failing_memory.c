/* Memory that runs out: every allocation of a whole job fails in turn.
 *
 *   failing_memory <job>
 *
 * This program defines the allocation functions, so those of the static library (and of libc below
 * it) come here. Each request of the job forks children in which it is refused: alone, mostly with
 * all that follow, or (if it is of 4 KiB or more) with all such that follow. A child must see
 * NM_OUT_OF_MEMORY, find the mesh as it was and usable, and give back all memory. What ends a child
 * is counted, and nothing may. */
#define _GNU_SOURCE
#include <errno.h>
#include <float.h>
#include <netmesh.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "support/uniform.h"

#ifndef __GLIBC__

int main(void) {
  puts("SKIP: needs glibc, whose allocator can be called under another name");
  return 77;
}

#else

#include <sys/wait.h>
#include <unistd.h>

void *__libc_malloc(size_t);
void *__libc_calloc(size_t, size_t);
void *__libc_realloc(void *, size_t);
void *__libc_memalign(size_t, size_t);
void __libc_free(void *);

/* Requests from here on are the big arrays. */
static const size_t BIG = 4096;

/* Which requests are refused: none, one, from one on all, from one on all big ones. */
enum refusal { NONE_FAILS, ONE_FAILS, ALL_FAIL, BIG_FAIL };

/* Of this process. The parent forks at every request while `forking`. */
static struct {
  int forking, child;
  enum refusal refusal;
  size_t failed, points, big_points, children, aborts, panics;
} plan;
static long live;

/* How a child ends that saw NM_PANIC. */
enum { PANICKED = 3, MOST_VERTICES = 1 << 14 };

/* Forks a child in which the request at hand is refused; answers 1 in the child. */
static int fork_child(enum refusal refusal, size_t size) {
  pid_t child = fork();
  if (child == 0) {
    plan.forking = 0;
    plan.child = 1;
    plan.refusal = refusal;
    return 1;
  }
  int status = 0;
  plan.children++;
  if (child < 0 || waitpid(child, &status, 0) != child) _exit(2);
  if (WIFSIGNALED(status)) {
    plan.aborts++;
  } else if (WEXITSTATUS(status) == PANICKED) {
    plan.panics++;
  } else if (WEXITSTATUS(status) != 1) {
    fprintf(stderr, "request %zu, %zu bytes: a child failed\n", plan.points, size);
    _exit(2);
  }
  return 0;
}

/* Jobs in space have up to 30,000 requests: after the first 4,096 one in `many` will do for what
 * takes long. */
static int is_one_in(size_t many) { return plan.points < 4096 || plan.points % many == 0; }

static int forked(size_t size) {
  plan.points++;
  plan.big_points += size >= BIG;
  return fork_child(ONE_FAILS, size) || (is_one_in(4) && fork_child(ALL_FAIL, size)) ||
         (size >= BIG && fork_child(BIG_FAIL, size));
}

static int refused(size_t size) {
  int refuse = plan.refusal == ALL_FAIL || (plan.refusal == BIG_FAIL && size >= BIG);
  if (plan.forking && forked(size)) refuse = 1;
  if (!refuse) return 0;
  plan.failed++;
  errno = ENOMEM;
  return 1;
}

static void *counted(void *memory) {
  live += memory != NULL;
  return memory;
}

void *malloc(size_t size) { return refused(size) ? NULL : counted(__libc_malloc(size)); }

void *calloc(size_t count, size_t size) {
  size_t bytes = size != 0 && count > SIZE_MAX / size ? SIZE_MAX : count * size;
  return refused(bytes) ? NULL : counted(__libc_calloc(count, size));
}

void *realloc(void *memory, size_t size) {
  if (memory == NULL) return malloc(size);
  return refused(size) ? NULL : __libc_realloc(memory, size);
}

void *aligned_alloc(size_t alignment, size_t size) {
  return refused(size) ? NULL : counted(__libc_memalign(alignment, size));
}

int posix_memalign(void **out, size_t alignment, size_t size) {
  *out = aligned_alloc(alignment, size);
  return *out == NULL ? ENOMEM : 0;
}

void free(void *memory) {
  live -= memory != NULL;
  __libc_free(memory);
}

/* From here on there is memory again. */
static void relent(void) { plan.refusal = NONE_FAILS; }

static void check(int holds, const char *what) {
  if (holds) return;
  relent();
  fprintf(stderr, "failed: %s\n", what);
  _exit(2);
}

/* The sides of a cube between a job's first eight points, or two tetrahedra that cross. */
enum surface { NO_SURFACE, CUBE, CROSSINGS };

/* What a job works on. */
struct job {
  const char *name;
  uint32_t dim;
  size_t n;
  nm_format mesh_format;
  const double *points;
  /* Segments between the points that come one after the other, and from the last to the first. */
  uint64_t segments;
  /* Which regions of these are inside. */
  nm_interior interior;
  enum surface surface;
};

/* Eight bytes at a time: byte for byte, children would mostly do this. Each step is a bijection. */
static uint64_t mixed(uint64_t hash, const void *data, size_t size) {
  const unsigned char *bytes = data;
  for (size_t i = 0; i < size; i += 8) {
    uint64_t word = 0;
    memcpy(&word, bytes + i, size - i < 8 ? size - i : 8);
    hash = (hash ^ word) * 1099511628211u;
    hash ^= hash >> 32;
  }
  return hash;
}

static int32_t mix_bytes(const void *data, size_t size, void *user_data) {
  uint64_t *hash = user_data;
  *hash = mixed(*hash, data, size);
  return 0;
}

/* Everything that can be seen of a mesh, in one number, without an allocation: buffers are static. */
static uint64_t fingerprint(const nm_mesh *mesh) {
  static double points[1 << 16];
  static uint32_t ids[1 << 18];
  uint64_t hash = 14695981039346656037u, needed = 0;
  nm_counts counts = NM_COUNTS_INIT;
  check(nm_mesh_counts(mesh, &counts) == NM_OK, "counts");
  hash = mixed(hash, &counts, sizeof counts);
  check(nm_mesh_get_points(mesh, points, 1 << 16, &needed) == NM_OK, "points");
  hash = mixed(hash, points, needed * sizeof *points);
  if (counts.simplices == 0) return hash;
  check(nm_mesh_get_simplices(mesh, ids, 1 << 18, &needed) == NM_OK, "simplices");
  hash = mixed(hash, ids, needed * sizeof *ids);
  check(nm_mesh_get_neighbors(mesh, ids, 1 << 18, &needed) == NM_OK, "neighbours");
  hash = mixed(hash, ids, needed * sizeof *ids);
  check(nm_mesh_get_vertex_domains(mesh, ids, 1 << 18, &needed) == NM_OK, "domains");
  return mixed(hash, ids, needed * sizeof *ids);
}

/* Whether the status is NM_OK; otherwise it must be what a failed allocation answers. */
static int succeeded(nm_status status, const char *what) {
  if (status == NM_PANIC && plan.failed > 0) _exit(PANICKED);
  check(status == NM_OK || (status == NM_OUT_OF_MEMORY && plan.failed > 0), what);
  check(status != NM_OUT_OF_MEMORY || nm_last_error(NULL, 0) > 1, "no message");
  return status == NM_OK;
}

/* Runs are long: one in 64. */
static int is_run_again(void) { return plan.points % 64 == 0 && is_one_in(512); }

/* One run; after a failure the mesh must be as before, and the same run must succeed with memory. */
static int run(nm_mesh *mesh, nm_output output, nm_algorithm algorithm) {
  uint64_t before = fingerprint(mesh);
  nm_options options;
  check(nm_options_init(&options, sizeof options) == NM_OK, "options");
  options.output = output;
  options.algorithm = algorithm;
  nm_counts counts = NM_COUNTS_INIT;
  check(nm_mesh_counts(mesh, &counts) == NM_OK, "counts");
  if (counts.dim == 3) options.min_dihedral = 15;
  if (succeeded(nm_run(mesh, &options), "nm_run")) return 1;
  check(fingerprint(mesh) == before, "a failed run changed the mesh");
  relent();
  if (is_run_again())
    check(nm_run(mesh, &options) == NM_OK, "the mesh is not usable after a failed run");
  return 0;
}

/* A run with sizes at the inputs and on a background: they ask for no vertices, but for memory. */
static int run_sized(nm_mesh *mesh) {
  static double values[MOST_VERTICES];
  nm_counts counts = NM_COUNTS_INIT;
  check(nm_mesh_counts(mesh, &counts) == NM_OK, "counts");
  check(counts.inputs <= MOST_VERTICES && counts.vertices <= MOST_VERTICES, "room for sizes");
  for (int i = 0; i < MOST_VERTICES; ++i) values[i] = DBL_MAX;
  return succeeded(nm_mesh_set_sizes(mesh, counts.inputs, values), "nm_mesh_set_sizes") &&
         succeeded(nm_mesh_set_background(mesh, mesh, counts.vertices, values), "background") &&
         run(mesh, NM_OUTPUT_WELL_SPACED, NM_ALGORITHM_NETMESH) &&
         succeeded(nm_mesh_set_sizes(mesh, 0, NULL), "nm_mesh_set_sizes") &&
         succeeded(nm_mesh_set_background(mesh, NULL, 0, NULL), "nm_mesh_set_background");
}

static int measure(const nm_mesh *mesh) {
  nm_quality quality = NM_QUALITY_INIT;
  if (!succeeded(nm_mesh_quality(mesh, &quality), "nm_mesh_quality")) return 0;
  const double edge = 1;
  uint64_t counts[2];
  for (int measure = NM_MEASURE_DIHEDRAL_ANGLE; measure <= NM_MEASURE_SMALLEST_ANGLE; ++measure) {
    const nm_status status = nm_mesh_quality_histogram(mesh, (nm_measure)measure, 1, 1, &edge,
                                                       counts, NULL);
    if (!succeeded(status, "nm_mesh_quality_histogram")) return 0;
  }
  nm_report report = NM_REPORT_INIT;
  if (!succeeded(nm_mesh_validate(mesh, 3, &report), "nm_mesh_validate")) return 0;
  check(report.level == 3 && report.violations == 0, "the certificate");
  return 1;
}

static int export(const nm_mesh *mesh, nm_format format) {
  uint64_t hash = 0;
  return succeeded(nm_export_write(mesh, format, mix_bytes, &hash), "nm_export_write");
}

/* A run with segments; as above. */
static int run_within(nm_mesh *mesh, nm_extent extent, nm_interior interior, nm_crossings crossings) {
  uint64_t before = fingerprint(mesh);
  nm_options options;
  check(nm_options_init(&options, sizeof options) == NM_OK, "options");
  options.output = NM_OUTPUT_WELL_SPACED;
  options.extent = extent;
  options.interior = interior;
  options.crossings = crossings;
  if (succeeded(nm_run(mesh, &options), "nm_run with segments")) return 1;
  check(fingerprint(mesh) == before, "a failed run with segments changed the mesh");
  relent();
  if (is_run_again())
    check(nm_run(mesh, &options) == NM_OK, "the mesh is not usable after a failed run");
  return 0;
}

/* What reads the whole of a mesh that is cut: location, and sizes on it, which ask for no vertices. */
static int ask_cut(nm_mesh *mesh) {
  static const double points[] = {3, 1, 2, 1.75, 1e3, -1e3};
  static double values[MOST_VERTICES];
  uint32_t simplices[3];
  nm_counts counts = NM_COUNTS_INIT;
  check(nm_mesh_counts(mesh, &counts) == NM_OK, "counts");
  check(counts.vertices <= MOST_VERTICES, "room for sizes");
  for (int i = 0; i < MOST_VERTICES; ++i) values[i] = DBL_MAX;
  return succeeded(nm_mesh_locate(mesh, 3, points, 1, simplices), "nm_mesh_locate") &&
         succeeded(nm_mesh_set_background(mesh, mesh, counts.vertices, values), "background") &&
         succeeded(nm_mesh_set_background(mesh, NULL, 0, NULL), "no background");
}

/* Segments, a region and a hole, cut to each extent. */
static int use_segments(const struct job *job, nm_mesh *mesh) {
  static uint32_t ends[64];
  static int32_t markers[32];
  nm_region regions[] = {NM_REGION_INIT, NM_REGION_INIT};
  for (uint32_t i = 0; i < 2 * job->segments; i++) {
    ends[i] = (i + 1) / 2 % (uint32_t)job->segments;
    markers[i / 2] = (int32_t)i;
  }
  regions[0].label = 3;
  regions[1].is_hole = 1;
  regions[0].seed[0] = 3;
  regions[0].seed[1] = 1;
  regions[1].seed[0] = 2;
  regions[1].seed[1] = 1.75;
  return succeeded(nm_mesh_set_segments(mesh, job->segments, ends, markers), "segments") &&
         succeeded(nm_mesh_set_regions(mesh, 2, regions), "regions") &&
         run_within(mesh, NM_EXTENT_BOUNDARY, job->interior, NM_CROSSINGS_SPLIT) && measure(mesh) &&
         ask_cut(mesh) &&
         export(mesh, NM_FORMAT_VTU) && export(mesh, NM_FORMAT_TETGEN_NODE) &&
         export(mesh, NM_FORMAT_MEDIT) && export(mesh, NM_FORMAT_GMSH) &&
         run_within(mesh, NM_EXTENT_BOX, NM_INTERIOR_SEEDS, NM_CROSSINGS_SPLIT) && measure(mesh) &&
         succeeded(nm_mesh_set_segments(mesh, 0, NULL, NULL), "no segments") &&
         succeeded(nm_mesh_set_regions(mesh, 0, NULL), "no regions") &&
         run_within(mesh, NM_EXTENT_HULL, NM_INTERIOR_SEEDS, NM_CROSSINGS_REFUSE) && measure(mesh);
}

/* The sides of a cube as facets and as triangles, with a segment in it, a label and a hole. */
static int use_facets(const struct job *job, nm_mesh *mesh) {
  static const uint64_t loops[] = {0, 1, 2, 3, 4, 5, 6}, starts[] = {0, 4, 8, 12, 16, 20, 24};
  static const uint32_t sides[] = {0, 2, 3, 1, 4, 5, 7, 6, 0, 1, 5, 4, 2, 6, 7, 3, 0, 4, 6, 2, 1, 3, 7, 5};
  static const int32_t markers[] = {1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12};
  static const uint32_t segment[] = {8, 9};
  static uint32_t triangles[36];
  static nm_intersection found[1];
  static nm_odd_edge edges[12];
  uint64_t needed = 1;
  nm_region region = NM_REGION_INIT;
  for (int i = 0; i < 6; ++i) {
    const uint32_t *side = sides + 4 * i;
    const uint32_t both[] = {side[0], side[1], side[2], side[0], side[2], side[3]};
    memcpy(triangles + 6 * i, both, sizeof both);
  }
  for (int k = 0; k < 3; ++k) region.seed[k] = 0.75;
  region.label = 3;
  return succeeded(nm_mesh_set_facets(mesh, 6, loops, starts, sides, markers), "facets") &&
         succeeded(nm_mesh_set_segments(mesh, 1, segment, markers), "a segment in space") &&
         succeeded(nm_mesh_set_regions(mesh, 1, &region), "a region in space") &&
         succeeded(nm_mesh_get_intersections(mesh, found, 1, &needed), "intersections") &&
         succeeded(nm_mesh_get_odd_edges(mesh, edges, 12, &needed), "edges of facets") &&
         run_within(mesh, NM_EXTENT_BOUNDARY, job->interior, NM_CROSSINGS_REFUSE) && measure(mesh) &&
         export(mesh, NM_FORMAT_VTU) && export(mesh, NM_FORMAT_TETGEN_NODE) &&
         export(mesh, NM_FORMAT_MEDIT) && export(mesh, NM_FORMAT_GMSH) &&
         export(mesh, NM_FORMAT_PLY) && export(mesh, NM_FORMAT_STL) &&
         succeeded(nm_mesh_triangulate_facets(mesh, NULL), "polygons as triangles") &&
         succeeded(nm_mesh_set_triangles(mesh, 11, triangles, markers), "triangles with a hole") &&
         succeeded(nm_mesh_close_holes(mesh, 3, NULL), "a hole") &&
         run_within(mesh, NM_EXTENT_ALL, NM_INTERIOR_SEEDS, NM_CROSSINGS_REFUSE) && measure(mesh);
}

/* Two tetrahedra that cross, and a triangle that is there twice: what is split in space. */
static int use_crossings(const struct job *job, nm_mesh *mesh) {
  static const uint32_t triangles[] = {0, 2, 1, 0, 1, 3, 1, 2, 3, 2, 0, 3, 4, 6, 5, 4, 5, 7, 5, 6, 7, 6, 4, 7, 0, 2, 1};
  return succeeded(nm_mesh_set_triangles(mesh, 9, triangles, NULL), "triangles that cross") &&
         run_within(mesh, NM_EXTENT_BOX, job->interior, NM_CROSSINGS_SPLIT) && measure(mesh);
}

/* Everything after the handle is there; stops where an allocation fails. */
static int use(const struct job *job, nm_mesh *mesh) {
  if (job->segments > 0) return use_segments(job, mesh);
  if (job->surface == CUBE) return use_facets(job, mesh);
  if (job->surface == CROSSINGS) return use_crossings(job, mesh);
  return run(mesh, NM_OUTPUT_HIERARCHICAL, NM_ALGORITHM_NETMESH) && measure(mesh) &&
         export(mesh, job->mesh_format) && export(mesh, NM_FORMAT_OFF) &&
         export(mesh, NM_FORMAT_TETGEN_NODE) && export(mesh, NM_FORMAT_CSV) &&
         export(mesh, NM_FORMAT_VORONOI_JSON) && export(mesh, NM_FORMAT_DOMAINS_JSON) &&
         (job->dim > 3 || export(mesh, NM_FORMAT_HTML)) && (job->dim > 2 || export(mesh, NM_FORMAT_SVG)) &&
         run(mesh, NM_OUTPUT_WELL_SPACED, NM_ALGORITHM_NETMESH) && measure(mesh) && run_sized(mesh) &&
         run(mesh, NM_OUTPUT_HIERARCHICAL, NM_ALGORITHM_DELAUNAY);
}

/* The whole job. Returns 1 if nothing was refused, 0 after NM_OUT_OF_MEMORY. */
static int whole(const struct job *job) {
  long before = live;
  nm_mesh *mesh = (nm_mesh *)&plan;
  if (!succeeded(nm_mesh_create(job->dim, job->n, job->points, 0, &mesh), "nm_mesh_create")) {
    check(mesh == NULL, "a handle after a failure");
    check(live == before, "nm_mesh_create leaks");
    return 0;
  }
  int done = use(job, mesh);
  nm_mesh_free(mesh);
  check(live == before, "memory is leaked");
  return done;
}

/* Refuses every allocation of the job, each in children. */
static void sweep(const struct job *job) {
  memset(&plan, 0, sizeof plan);
  plan.forking = 1;
  int done = whole(job);
  if (plan.child) {
    relent();
    check(!done, "a failed allocation went unnoticed");
    _exit(1);
  }
  plan.forking = 0;
  check(done, "a job with memory");
  printf("%s: %zu failure points, %zu of them of 4 KiB and more; %zu children, %zu aborts, %zu panics\n",
         job->name, plan.points, plan.big_points, plan.children, plan.aborts, plan.panics);
  fflush(stdout);
  check(plan.aborts + plan.panics == 0, "an allocation ended the process");
}

/* Half of the points in the unit cube, half of them a million times closer together: with cages. */
static void scatter(double *points, uint32_t dim, size_t n, double scale) {
  for (size_t i = 0; i < n; i++)
    for (uint32_t k = 0; k < dim; k++)
      points[i * dim + k] = scale * (i % 2 ? uniform() : 0.5 + uniform() * 1e-6);
}

int main(int count, char **arguments) {
  static double plane[2 * 36], space[3 * 16], lattice[2 * 25];
  static double huge_plane[2 * 24], huge_space[3 * 12], huge_4d[4 * 8];
  /* The curve through these crosses itself, and passes one of them. */
  static const double curve[] = {0, 0, 4, 0, 4, 4, 0, 4, 1, 1, 3, 1.5, 1.5, 3, 3, 3};
  /* The bits of a corner's number are its coordinates, the last one first. */
  static const double cube[] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0, 0, 0, 1, 1, 0, 1, 0, 1, 1, 1, 1, 1,
                                0.5, 0.25, 0.5, 0.5, 0.5, 0.5};
  /* Four corners each. */
  static const double crossed[] = {0, 0, 0, 3, 0, 0, 0, 3, 0, 0, 0, 3, 0.5, 0.5, -1, 4, 0.75, 1, 0.75, 4, 1, 1, 1, 4};
  scatter(plane, 2, 36, 1.0);
  scatter(space, 3, 16, 1.0);
  /* Outside the window of the adaptive signs: all that the filters leave open goes to integers. */
  scatter(huge_plane, 2, 24, 1e200);
  scatter(huge_space, 3, 12, 1e200);
  scatter(huge_4d, 4, 8, 1e200);
  for (size_t i = 0; i < 2 * 25; i++) lattice[i] = (double)(i % 2 ? i / 2 / 5 : i / 2 % 5);
  const struct job jobs[] = {
      {"2d", 2, 36, NM_FORMAT_VTU, plane, 0, NM_INTERIOR_SEEDS, NO_SURFACE},
      {"2d_lattice", 2, 25, NM_FORMAT_VTU, lattice, 0, NM_INTERIOR_SEEDS, NO_SURFACE},
      {"3d", 3, 16, NM_FORMAT_VTU, space, 0, NM_INTERIOR_SEEDS, NO_SURFACE},
      {"2d_big_integers", 2, 24, NM_FORMAT_VTU, huge_plane, 0, NM_INTERIOR_SEEDS, NO_SURFACE},
      {"3d_big_integers", 3, 12, NM_FORMAT_VTU, huge_space, 0, NM_INTERIOR_SEEDS, NO_SURFACE},
      {"4d_big_integers", 4, 8, NM_FORMAT_OFF, huge_4d, 0, NM_INTERIOR_SEEDS, NO_SURFACE},
      {"2d_segments", 2, 8, NM_FORMAT_VTU, curve, 8, NM_INTERIOR_SEEDS, NO_SURFACE},
      {"2d_parity", 2, 8, NM_FORMAT_VTU, curve, 8, NM_INTERIOR_PARITY, NO_SURFACE},
      {"3d_facets", 3, 10, NM_FORMAT_VTU, cube, 0, NM_INTERIOR_PARITY, CUBE},
      {"3d_crossings", 3, 8, NM_FORMAT_VTU, crossed, 0, NM_INTERIOR_SEEDS, CROSSINGS},
  };
  /* What ends a child would search for its own symbols first. */
  setenv("RUST_BACKTRACE", "0", 1);
  for (size_t i = 0; i < sizeof jobs / sizeof *jobs; i++) {
    if (count == 2 && strcmp(arguments[1], jobs[i].name) == 0) {
      sweep(&jobs[i]);
      return 0;
    }
  }
  fputs("usage: failing_memory <job>\n", stderr);
  return 2;
}

#endif
