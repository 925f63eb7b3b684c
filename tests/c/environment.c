/*
 * Makes and checks meshes in other floating-point environments than the default one: what comes out
 * are the same bytes, every call leaves the environment as it was, and callbacks find the caller's.
 * Argument: a directory for files.
 */
#define _GNU_SOURCE

#include <fenv.h>
#include <float.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "netmesh.h"

/* The registers of the environment: how results are made, and which exceptions have occurred. */
typedef struct {
    uint64_t control, flags;
} registers;

#if defined(__x86_64__)
#include <xmmintrin.h>

#define FLUSH_TO_ZERO 0x8000u
#define DENORMALS_ARE_ZERO 0x40u
#define INEXACT 0x20u

static registers get(void)
{
    registers now = { _mm_getcsr() & ~0x3fu, _mm_getcsr() & 0x3fu };
    return now;
}

static void set(registers to)
{
    _mm_setcsr((unsigned)(to.control | to.flags));
}
#elif defined(__aarch64__)
/* One bit of this processor does both. */
#define FLUSH_TO_ZERO (1u << 24)
#define DENORMALS_ARE_ZERO (1u << 24)
#define INEXACT 0x10u

static registers get(void)
{
    registers now;
    __asm__ volatile("mrs %0, fpcr\n\tmrs %1, fpsr" : "=r"(now.control), "=r"(now.flags));
    return now;
}

static void set(registers to)
{
    __asm__ volatile("msr fpcr, %0\n\tmsr fpsr, %1" : : "r"(to.control), "r"(to.flags));
}
#else
#define NO_REGISTERS
#endif

#ifdef NO_REGISTERS
int main(void)
{
    puts("every environment is left as it is on this processor");
    return 0;
}
#else

static int failures = 0;
static const char *mode = "";
static registers of_mode, usual_registers;

static int is_as(registers should)
{
    registers now = get();
    return now.control == should.control && now.flags == should.flags;
}

/* Reports in the default environment: to print may compute. */
static void complain(int line, const char *what)
{
    fenv_t before;
    feholdexcept(&before);
    fesetenv(FE_DFL_ENV);
    fprintf(stderr, "environment.c:%d: %s: %s\n", line, mode, what);
    fesetenv(&before);
    ++failures;
}

#define CHECK(condition) ((condition) ? (void)0 : complain(__LINE__, #condition))

/* The bytes of all answers, mixed. */
static uint64_t digest;

static void mix(const void *bytes, size_t size)
{
    const unsigned char *byte = bytes;
    for (size_t i = 0; i < size; ++i)
        digest = (digest ^ byte[i]) * 0x100000001b3u;
}

/* Checks a status and the environment after a call. */
static void expect(int line, nm_status is, nm_status should, const char *call)
{
    char message[600];
    if (!is_as(of_mode)) {
        complain(line, "the environment was not restored");
        set(of_mode);
    }
    if (is != should) {
        nm_last_error(message, sizeof message);
        complain(line, call);
        complain(line, message);
    }
}

#define OK(call) expect(__LINE__, (call), NM_OK, #call)

static int32_t report(const nm_progress *progress, void *calls)
{
    registers strange = { of_mode.control ^ FLUSH_TO_ZERO, 0 };
    CHECK(is_as(of_mode));
    ++*(int *)calls;
    set(strange);
    return progress->struct_size == 0;
}

static double size_at(const double *x, void *answer)
{
    registers strange = { of_mode.control ^ FLUSH_TO_ZERO, 0 };
    CHECK(is_as(of_mode));
    set(strange);
    return x == NULL ? 0.0 : *(const double *)answer;
}

static int32_t append(const void *data, size_t size, void *calls)
{
    registers strange = { of_mode.control ^ FLUSH_TO_ZERO, 0 };
    CHECK(is_as(of_mode));
    ++*(int *)calls;
    mix(data, size);
    set(strange);
    return 0;
}

typedef struct {
    const char *name;
    uint32_t dim;
    size_t count;
    double points[1000];
    /* Asked for everywhere. */
    double size;
} input;

enum { INPUTS = 6 };

static input inputs[INPUTS];

static void add(input *to, double x, double y, double z)
{
    const double point[3] = { x, y, z };
    memcpy(to->points + to->count * to->dim, point, to->dim * sizeof *point);
    ++to->count;
}

static uint32_t drawn(void)
{
    static uint32_t state = 7;
    state = state * 1664525u + 1013904223u;
    return state >> 12;
}

static input *begin(int at, const char *name, uint32_t dim, double size)
{
    inputs[at].name = name;
    inputs[at].dim = dim;
    inputs[at].size = size;
    return &inputs[at];
}

static void make_inputs(void)
{
    static const double triples[][2] = { { 16, 63 }, { 25, 60 }, { 33, 56 }, { 39, 52 } };
    input *to = begin(0, "a lattice in the plane", 2, 0.08);
    for (int i = 0; i < 144; ++i)
        add(to, i % 12 * 0.1, i / 12 * 0.1, 0);
    to = begin(1, "a lattice in space", 3, 0.2);
    for (int i = 0; i < 64; ++i)
        add(to, i % 4 * 0.1, i / 4 % 4 * 0.1, i / 16 * 0.1);
    to = begin(2, "subnormal numbers", 2, 1.0);
    add(to, 1e-310, 0, 0);
    add(to, 0, 3e-309, 0);
    for (int i = 0; i < 20; ++i)
        add(to, drawn() * 5e-324, drawn() * 5e-324, 0);
    to = begin(3, "a circle", 2, 30.0);
    for (int i = 0; i < 32; ++i) {
        double x = triples[i / 8][i & 1] * (i & 2 ? 1 : -1);
        add(to, x, triples[i / 8][~i & 1] * (i & 4 ? 1 : -1), 0);
    }
    to = begin(4, "a sphere", 3, 3.0);
    for (int i = 0; i < 24; ++i) {
        double at[3] = { i & 1 ? 2 : -2, i & 2 ? 2 : -2, i & 4 ? 2 : -2 };
        at[i / 8] /= 2;
        add(to, at[0], at[1], at[2]);
    }
    to = begin(5, "close pairs", 2, 0.5);
    for (int i = 0; i < 15; ++i) {
        double x = 1 + drawn() / 1048576.0, y = 1 + drawn() / 1048576.0;
        add(to, x, y, 0);
        add(to, x + DBL_EPSILON, y, 0);
    }
}

/* What is asked of a mesh that has a result. */
static void ask(const nm_mesh *mesh, const input *of)
{
    static double doubles[200000];
    static uint32_t ids[200000], found[500];
    nm_counts counts = NM_COUNTS_INIT;
    nm_report certificate = NM_REPORT_INIT;
    nm_quality quality = NM_QUALITY_INIT;
    uint64_t needed = 0, capacity = 200000, asked = of->count;
    int calls = 0;
    OK(nm_mesh_counts(mesh, &counts));
    mix(&counts, sizeof counts);
    OK(nm_mesh_get_points(mesh, doubles, capacity, &needed));
    mix(doubles, (size_t)needed * sizeof *doubles);
    OK(nm_mesh_get_simplices(mesh, ids, capacity, &needed));
    mix(ids, (size_t)needed * sizeof *ids);
    OK(nm_mesh_get_circumcenters(mesh, NULL, doubles, capacity, &needed));
    mix(doubles, (size_t)needed * sizeof *doubles);
    OK(nm_mesh_get_volumes(mesh, NULL, doubles, capacity, &needed));
    mix(doubles, (size_t)needed * sizeof *doubles);
    OK(nm_mesh_quality(mesh, &quality));
    mix(&quality, sizeof quality);
    OK(nm_mesh_validate(mesh, 3, &certificate));
    mix(&certificate, sizeof certificate);
    CHECK(certificate.level == 3 && certificate.violations == 0);
    OK(nm_mesh_locate(mesh, asked, of->points, 2, found));
    mix(found, (size_t)asked * sizeof *found);
    OK(nm_mesh_nearest(mesh, asked, of->points, 2, found, doubles));
    mix(found, (size_t)asked * sizeof *found);
    mix(doubles, (size_t)asked * sizeof *doubles);
    OK(nm_export_write(mesh, NM_FORMAT_XYZ, append, &calls));
    OK(nm_export_write(mesh, NM_FORMAT_OFF, append, &calls));
    CHECK(calls >= 2);
}

static void fill(nm_options *options, int *calls)
{
    OK(nm_options_init(options, sizeof *options));
    options->progress = report;
    options->user_data = calls;
    options->threads = 2;
}

/* Runs an input in three ways, from memory and from a file. */
static uint64_t job(const input *of, const char *path)
{
    nm_mesh *mesh = NULL;
    nm_options options;
    double alpha = 0;
    int calls = 0;
    digest = 0xcbf29ce484222325u;
    OK(nm_mesh_create(of->dim, of->count, of->points, 0, &mesh));
    fill(&options, &calls);
    OK(nm_run(mesh, &options));
    ask(mesh, of);
    options.output = NM_OUTPUT_WELL_SPACED;
    options.size = size_at;
    memcpy(&options.size_user_data, &(const void *){ &of->size }, sizeof(void *));
    OK(nm_run(mesh, &options));
    ask(mesh, of);
    OK(nm_export(mesh, path, NM_FORMAT_XYZ));
    nm_mesh_free(mesh);
    CHECK(is_as(of_mode));
    OK(nm_mesh_create_from_file(path, NM_FORMAT_XYZ, &mesh));
    fill(&options, &calls);
    options.algorithm = NM_ALGORITHM_DELAUNAY;
    OK(nm_run(mesh, &options));
    ask(mesh, of);
    OK(nm_mesh_connecting_alpha(mesh, &alpha));
    mix(&alpha, sizeof alpha);
    /* A call that is refused restores the environment, too. */
    expect(__LINE__, nm_run(NULL, &options), NM_NULL_ARGUMENT, "nm_run without a mesh");
    options.quality_bound = -1;
    expect(__LINE__, nm_run(mesh, &options), NM_INVALID_ARGUMENT, "nm_run with a wrong option");
    nm_mesh_free(mesh);
    CHECK(is_as(of_mode));
    CHECK(calls >= 3);
    return digest;
}

enum { MODES = 9 };

static const char *const names[MODES] = {
    "default",         "rounding upwards",   "rounding downwards",           "rounding to zero",
    "flush to zero",   "denormals are zero", "as a program made by -Ofast", "traps",
    "all of it"
};

/* Sets a mode, with a flag that must stay. */
static void enter(int at)
{
    static const int roundings[] = { FE_TONEAREST, FE_UPWARD, FE_DOWNWARD, FE_TOWARDZERO };
    registers now;
    if (at < 4)
        fesetround(roundings[at]);
    if (at == 8)
        fesetround(FE_UPWARD);
#if defined(__GLIBC__)
    if (at >= 7)
        feenableexcept(FE_DIVBYZERO | FE_INEXACT | FE_INVALID | FE_OVERFLOW | FE_UNDERFLOW);
#endif
    now = get();
    if (at == 4 || at == 6 || at == 8)
        now.control |= FLUSH_TO_ZERO;
    if (at == 5 || at == 6 || at == 8)
        now.control |= DENORMALS_ARE_ZERO;
    now.flags |= INEXACT;
    set(now);
    mode = names[at];
    of_mode = get();
}

static void leave(void)
{
    fesetenv(FE_DFL_ENV);
    set(usual_registers);
    mode = "";
    of_mode = usual_registers;
}

/* Whether the mode that is set does what it is called by. Traps would end the program. */
static int is_on(int at)
{
    volatile double one = 1, little = DBL_EPSILON / 8, least = DBL_MIN, tiny = DBL_MIN / 4;
    if (at >= 7)
        return !is_as(usual_registers);
    switch (at) {
    case 1:
        return one + little > 1;
    case 2:
        return -one - little < -1;
    case 3:
        return one - little < 1 && -one - little == -1;
    case 4:
        return least / 2 == 0;
    case 5:
        return tiny == 0;
    case 6:
        return least / 2 == 0 && tiny == 0;
    default:
        return one + little == 1 && one - little == 1 && least / 2 != 0 && tiny != 0;
    }
}

int main(int argc, char **argv)
{
    char path[1000];
    uint64_t usual[INPUTS] = { 0 };
    if (argc != 2)
        return 2;
    sprintf(path, "%.900s/vertices.xyz", argv[1]);
    usual_registers = get();
    usual_registers.flags = 0;
    leave();
    make_inputs();
    for (int at = 0; at < MODES; ++at) {
        for (int i = 0; i < INPUTS; ++i) {
            uint64_t made;
            enter(at);
            CHECK(is_on(at));
            set(of_mode);
            made = job(&inputs[i], path);
            if (at == 0)
                usual[i] = made;
            if (made != usual[i])
                complain(__LINE__, inputs[i].name);
            leave();
        }
    }
    if (failures > 0)
        return 1;
    puts("every environment made the same");
    return 0;
}
#endif
