// Every status the library can be driven to, with a message that helps: it names the argument, the
// index, the value or the line. After a failed run the mesh is as it was.
//
//   api_misuse <directory for its files>
#include <sys/mman.h>
#include <sys/resource.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <initializer_list>
#include <iostream>
#include <limits>
#include <set>
#include <string>
#include <vector>

#include "check.hpp"
#include "inputs.hpp"
#include "mesh.hpp"

namespace {

std::set<int> provoked;

// Letter case aside: whether a message says NM_FORMAT_VTU or Vtu is its own affair.
bool contains(const std::string& text, const std::string& word) {
    const auto same = [](unsigned char a, unsigned char b) { return std::tolower(a) == std::tolower(b); };
    return std::search(text.begin(), text.end(), word.begin(), word.end(), same) != text.end();
}

void expect_at(int line, const char* call, nm_status actual, nm_status expected,
               std::initializer_list<const char*> words) {
    provoked.insert(actual);
    check::status(actual, expected, __FILE__, line, call);
    const std::string message = check::last_error();
    check::that(message.size() > 5, __FILE__, line, "there is a message");
    for (const char* word : words) {
        check::that(contains(message, word), __FILE__, line, call,
                    "no '" + std::string(word) + "' in the message: " + message);
    }
}

#define EXPECT(call, status, ...) expect_at(__LINE__, #call, (call), (status), {__VA_ARGS__})

const std::vector<double> square = {0, 0, 1, 0, 1, 1, 0, 1, 0.4, 0.6};

nm_status create_status(std::uint32_t dim, std::size_t n, const double* points, std::size_t stride = 0) {
    nm_mesh* mesh = reinterpret_cast<nm_mesh*>(alignof(std::max_align_t));
    const nm_status status = nm_mesh_create(dim, n, points, stride, &mesh);
    if (status == NM_OK) {
        nm_mesh_free(mesh);
    } else {
        CHECK(mesh == nullptr);  // a failed create leaves nothing to free
    }
    return status;
}

void creation() {
    CHECK_STATUS(create_status(2, 5, square.data()), NM_OK);
    EXPECT(nm_mesh_create(2, 5, square.data(), 0, nullptr), NM_NULL_ARGUMENT, "out");
    EXPECT(create_status(2, 5, nullptr), NM_NULL_ARGUMENT, "points");
    EXPECT(create_status(1, 5, square.data()), NM_DIMENSION, "dim", "1");
    EXPECT(create_status(9, 1, square.data()), NM_DIMENSION, "dim", "9");
    EXPECT(create_status(0, 5, square.data()), NM_DIMENSION, "dim");
    EXPECT(create_status(3, 2, square.data(), 2), NM_INVALID_ARGUMENT, "stride", "2");
    EXPECT(create_status(2, 0, square.data()), NM_DEGENERATE_INPUT, "two");
    EXPECT(create_status(2, 1, square.data()), NM_DEGENERATE_INPUT, "two");
    EXPECT(create_status(2, std::numeric_limits<std::uint32_t>::max(), square.data()), NM_CAPACITY, "4294967295");
    EXPECT(create_status(2, 3, square.data(), std::numeric_limits<std::size_t>::max() / 2),
           NM_INVALID_ARGUMENT, "stride");

    std::vector<double> bad = square;
    bad[7] = std::nan("");
    EXPECT(create_status(2, 5, bad.data()), NM_NON_FINITE, "3", "1", "NaN");
    bad[7] = -HUGE_VAL;
    EXPECT(create_status(2, 5, bad.data()), NM_NON_FINITE, "3", "inf");

    const double equal[] = {0.0, 2, -0.0, 2, 0.0, 2};
    EXPECT(create_status(2, 3, equal), NM_DEGENERATE_INPUT, "distinct");
    nm_mesh_free(nullptr);
}

class Files {
public:
    explicit Files(std::string directory) : directory_(std::move(directory)) {}

    std::string path(const std::string& name) const { return directory_ + "/misuse_" + name; }

    std::string write(const std::string& name, const std::string& text) const {
        std::ofstream(path(name), std::ios::binary) << text;
        return path(name);
    }

    static bool exists(const std::string& path) { return std::ifstream(path).good(); }

private:
    std::string directory_;
};

nm_status read_status(const std::string& path, nm_format format = NM_FORMAT_AUTO) {
    nm_mesh* mesh = nullptr;
    const nm_status status = nm_mesh_create_from_file(path.c_str(), format, &mesh);
    CHECK((status == NM_OK) == (mesh != nullptr));
    nm_mesh_free(mesh);
    return status;
}

void reading(const Files& files) {
    nm_mesh* mesh = nullptr;
    EXPECT(nm_mesh_create_from_file(nullptr, NM_FORMAT_AUTO, &mesh), NM_NULL_ARGUMENT, "path");
    EXPECT(nm_mesh_create_from_file("a.xyz", NM_FORMAT_AUTO, nullptr), NM_NULL_ARGUMENT, "out");
    EXPECT(read_status(files.path("missing.xyz")), NM_IO, "missing.xyz");
    EXPECT(read_status(files.path("missing.surprise")), NM_INVALID_ARGUMENT, "surprise");
    EXPECT(read_status("\xff\xfe.xyz"), NM_INVALID_ARGUMENT, "path_utf8");
    EXPECT(read_status(files.path("missing.xyz"), static_cast<nm_format>(77)), NM_INVALID_ARGUMENT, "77");
    EXPECT(read_status(files.path("missing.vtu")), NM_INVALID_ARGUMENT, "VTU");
    EXPECT(read_status(files.path("missing.voronoi.json")), NM_INVALID_ARGUMENT, "the Voronoi diagram");
    EXPECT(read_status(files.path("missing.npy")), NM_IO, "missing.npy");

    CHECK_STATUS(read_status(files.write("good.xyz", "0 0 0\n1 0 0\n0 1 0\n0 0 1\n")), NM_OK);
    CHECK_STATUS(read_status(files.write("good.csv", "0,0\n1,0\n0,1\n")), NM_OK);
    EXPECT(read_status(files.write("empty.xyz", "")), NM_FORMAT_ERROR, "empty.xyz");
    EXPECT(read_status(files.write("text.npy", "0 0\n1 0\n")), NM_FORMAT_ERROR, "text.npy", "byte 1");
    EXPECT(read_status(files.write("cut.ply", "ply\nformat ascii 1.0\n")), NM_FORMAT_ERROR, "line 2");
    EXPECT(read_status(files.write("cut.msh", "$MeshFormat\n4.1 0 8\n")), NM_FORMAT_ERROR, "$MeshFormat");
    EXPECT(read_status(files.write("cut.mesh", "MeshVersionFormatted 2\n")), NM_FORMAT_ERROR, "Vertices");
    EXPECT(read_status(files.write("ragged.xyz", "0 0 0\n1 0 0\n0 1\n")), NM_FORMAT_ERROR, "3");
    EXPECT(read_status(files.write("words.csv", "0,0\n1,0\n1,1\n0,one\n")), NM_FORMAT_ERROR, "4", "one");
    EXPECT(read_status(files.write("line.csv", "1\n2\n")), NM_DIMENSION, "1");
    EXPECT(read_status(files.write("same.csv", "1,2\n1,2\n")), NM_DEGENERATE_INPUT, "distinct");
}

void writing(const Files& files) {
    const MeshHandle mesh = create(generate("uniform", 2, 50));
    const std::string target = files.path("out.vtu");
    std::remove(target.c_str());
    EXPECT(nm_export(mesh.get(), target.c_str(), NM_FORMAT_AUTO), NM_STATE, "run");
    CHECK(!Files::exists(target));
    REQUIRE_OK(nm_run(mesh.get(), nullptr));

    EXPECT(nm_export(nullptr, target.c_str(), NM_FORMAT_AUTO), NM_NULL_ARGUMENT, "mesh");
    EXPECT(nm_export(mesh.get(), nullptr, NM_FORMAT_AUTO), NM_NULL_ARGUMENT, "path");
    EXPECT(nm_export(mesh.get(), "", NM_FORMAT_AUTO), NM_INVALID_ARGUMENT, "path");
    EXPECT(nm_export(mesh.get(), files.path("a.surprise").c_str(), NM_FORMAT_AUTO), NM_INVALID_ARGUMENT,
           "surprise");
    EXPECT(nm_export(mesh.get(), target.c_str(), static_cast<nm_format>(-1)), NM_INVALID_ARGUMENT, "-1");
    EXPECT(nm_export(mesh.get(), files.path("no/such/place.vtu").c_str(), NM_FORMAT_AUTO), NM_IO, "place.vtu");
    const MeshHandle four = create(generate("uniform", 4, 20));
    for (const nm_format low : {NM_FORMAT_VTU, NM_FORMAT_GMSH, NM_FORMAT_MEDIT, NM_FORMAT_PLY}) {
        EXPECT(nm_export(four.get(), files.path("four").c_str(), low), NM_INVALID_ARGUMENT, "holds meshes of dimension 2 and 3", "nOFF");
    }
    CHECK(!Files::exists(files.path("four")));

    const nm_write_fn stop = [](const void*, std::size_t, void*) -> std::int32_t { return 42; };
    EXPECT(nm_export_write(mesh.get(), NM_FORMAT_OFF, nullptr, nullptr), NM_NULL_ARGUMENT, "write");
    EXPECT(nm_export_write(mesh.get(), NM_FORMAT_AUTO, stop, nullptr), NM_INVALID_ARGUMENT, "name a format");
    EXPECT(nm_export_write(mesh.get(), NM_FORMAT_OFF, stop, nullptr), NM_IO, "42");
}

void before_a_run() {
    const MeshHandle mesh = create(generate("uniform", 3, 20));
    const nm_counts counts = counts_of(mesh.get());
    CHECK_EQUAL(counts.inputs, 20u);
    CHECK_EQUAL(counts.vertices, 20u);
    CHECK_EQUAL(counts.simplices, 0u);
    std::uint64_t needed = 0;
    EXPECT(nm_mesh_get_simplices(mesh.get(), nullptr, 0, &needed), NM_STATE, "nm_run");
    EXPECT(nm_mesh_get_neighbors(mesh.get(), nullptr, 0, &needed), NM_STATE, "nm_run");
    auto quality = sized<nm_quality>();
    auto stats = sized<nm_stats>();
    auto report = sized<nm_report>();
    EXPECT(nm_mesh_quality(mesh.get(), &quality), NM_STATE, "nm_run");
    EXPECT(nm_mesh_stats(mesh.get(), &stats), NM_STATE, "nm_run");
    EXPECT(nm_mesh_validate(mesh.get(), 3, &report), NM_STATE, "nm_run");
}

void getters() {
    const MeshHandle mesh = create(generate("uniform", 2, 50));
    REQUIRE_OK(nm_run(mesh.get(), nullptr));
    std::uint64_t needed = 0;
    std::vector<double> points(3, -7.0);
    EXPECT(nm_mesh_get_points(nullptr, nullptr, 0, &needed), NM_NULL_ARGUMENT, "mesh");
    EXPECT(nm_mesh_get_points(mesh.get(), points.data(), 3, &needed), NM_CAPACITY, "3");
    CHECK_EQUAL(needed, counts_of(mesh.get()).vertices * 2);
    CHECK(points == std::vector<double>(3, -7.0));

    EXPECT(nm_mesh_counts(mesh.get(), nullptr), NM_NULL_ARGUMENT, "counts");
    nm_counts unsized{};
    EXPECT(nm_mesh_counts(mesh.get(), &unsized), NM_INVALID_ARGUMENT, "struct_size");
    // An older program's smaller struct: only what it has is written.
    nm_counts older{};
    older.struct_size = offsetof(nm_counts, vertices);
    older.vertices = 1234567;
    CHECK_STATUS(nm_mesh_counts(mesh.get(), &older), NM_OK);
    CHECK_EQUAL(older.inputs, 50u);
    CHECK_EQUAL(older.vertices, 1234567u);

    auto report = sized<nm_report>();
    EXPECT(nm_mesh_validate(mesh.get(), 0, &report), NM_INVALID_ARGUMENT, "level", "0");
    EXPECT(nm_mesh_validate(mesh.get(), 4, &report), NM_INVALID_ARGUMENT, "level", "4");
    EXPECT(nm_mesh_validate(mesh.get(), 3, nullptr), NM_NULL_ARGUMENT, "report");
}

// State that a failed call must not touch.
struct Snapshot {
    ExportedMesh mesh;
    nm_counts counts;
    nm_stats stats;

    explicit Snapshot(const nm_mesh* source)
        : mesh(export_mesh(source)), counts(counts_of(source)), stats(stats_of(source)) {}

    bool operator==(const Snapshot& other) const {
        return mesh == other.mesh && std::memcmp(&counts, &other.counts, sizeof counts) == 0
               && std::memcmp(&stats, &other.stats, sizeof stats) == 0;
    }
};

void options() {
    const MeshHandle mesh = create(generate("gaussian", 2, 500));
    REQUIRE_OK(nm_run(mesh.get(), nullptr));
    const Snapshot before(mesh.get());
    const auto refuse = [&](int line, nm_status expected, std::initializer_list<const char*> words, auto change) {
        nm_options changed = default_options();
        change(changed);
        expect_at(line, "nm_run", nm_run(mesh.get(), &changed), expected, words);
        check::that(Snapshot(mesh.get()) == before, __FILE__, line, "the mesh is as it was");
    };
#define REFUSE(status, change, ...) \
    refuse(__LINE__, status, {__VA_ARGS__}, [](nm_options& options) { change; })

    EXPECT(nm_options_init(nullptr, sizeof(nm_options)), NM_NULL_ARGUMENT, "options");
    EXPECT(nm_run(nullptr, nullptr), NM_NULL_ARGUMENT, "mesh");
    REFUSE(NM_INVALID_ARGUMENT, options.struct_size = 0, "struct_size");
    REFUSE(NM_INVALID_ARGUMENT, options.output = static_cast<nm_output>(7), "output", "7");
    REFUSE(NM_INVALID_ARGUMENT, options.algorithm = static_cast<nm_algorithm>(-3), "algorithm", "-3");
    REFUSE(NM_INVALID_ARGUMENT, options.ordering = static_cast<nm_ordering>(9), "ordering", "9");
    REFUSE(NM_INVALID_ARGUMENT, options.criterion = static_cast<nm_criterion>(2), "criterion", "2");
    REFUSE(NM_INVALID_ARGUMENT, options.quality_bound = 1.0, "quality_bound", "2.2");
    REFUSE(NM_INVALID_ARGUMENT, options.quality_bound = std::nan(""), "quality_bound", "NaN");
    REFUSE(NM_INVALID_ARGUMENT, options.epsilon = -0.5, "epsilon", "-0.5");
    REFUSE(NM_INVALID_ARGUMENT, options.delta = 7.5, "delta", "7.5");
    REFUSE(NM_INVALID_ARGUMENT, options.gamma = 7.5, "gamma", "7.5");
    REFUSE(NM_INVALID_ARGUMENT, options.yield_radius = 7.5, "yield_radius", "7.5");
    REFUSE(NM_INVALID_ARGUMENT, options.encroachment = 7.5, "encroachment", "7.5");
    REFUSE(NM_INVALID_ARGUMENT, options.cage_scale = 7.5, "cage_scale", "7.5");
    REFUSE(NM_INVALID_ARGUMENT, options.root_scale = 1e9, "root_scale");
    REFUSE(NM_INVALID_ARGUMENT, options.min_angle = 99, "min_angle", "99");
    REFUSE(NM_INVALID_ARGUMENT, options.instruments = 2, "instruments", "2");
    REFUSE(NM_INVALID_ARGUMENT, options.reserved = 1, "reserved", "1");
    REFUSE(NM_LIMIT, options.max_vertices = 600, "600");
#undef REFUSE

    // A newer program's larger struct is welcome while its tail is zero.
    struct Newer {
        nm_options options;
        double tail;
    };
    Newer newer{};
    REQUIRE_OK(nm_options_init(&newer.options, sizeof newer));
    CHECK_STATUS(nm_run(mesh.get(), &newer.options), NM_OK);
    newer.tail = 1.0;
    EXPECT(nm_run(mesh.get(), &newer.options), NM_INVALID_ARGUMENT, "struct_size");
}

// Runs of about a second: the callback comes some 20 times in one, and may never in a short run.
PointSet long_job() { return generate("uniform", 3, 8000); }

// Cancelled at the first report, and in the midst of the work.
void cancelled() {
    const MeshHandle mesh = create(long_job());
    nm_options options = default_options();
    options.output = NM_OUTPUT_WELL_SPACED;
    int countdown = 0;
    options.user_data = &countdown;
    options.progress = [](const nm_progress*, void* user_data) -> std::int32_t {
        return --*static_cast<int*>(user_data) < 0 ? 1 : 0;
    };
    EXPECT(nm_run(mesh.get(), &options), NM_CANCELLED, "cancel");
    CHECK_EQUAL(counts_of(mesh.get()).simplices, 0u);  // it had no result before
    REQUIRE_OK(nm_run(mesh.get(), nullptr));
    const Snapshot before(mesh.get());
    for (const int reports : {0, 3}) {
        countdown = reports;
        EXPECT(nm_run(mesh.get(), &options), NM_CANCELLED, "cancel");
        CHECK(Snapshot(mesh.get()) == before);
    }
}

// The progress callback tries to use the mesh that is being run.
void state() {
    const MeshHandle mesh = create(long_job());
    nm_options options = default_options();
    struct Attempt {
        nm_mesh* mesh;
        int calls;
    } attempt{mesh.get(), 0};
    options.user_data = &attempt;
    options.progress = [](const nm_progress* progress, void* user_data) -> std::int32_t {
        auto& data = *static_cast<Attempt*>(user_data);
        ++data.calls;
        CHECK(progress->struct_size >= sizeof(nm_progress));
        auto counts = sized<nm_counts>();
        EXPECT(nm_run(data.mesh, nullptr), NM_STATE, "mesh");
        EXPECT(nm_mesh_counts(data.mesh, &counts), NM_STATE, "nm_run");
        return 0;
    };
    CHECK_STATUS(nm_run(mesh.get(), &options), NM_OK);
    CHECK(attempt.calls > 0);
    CHECK_STATUS(nm_run(mesh.get(), nullptr), NM_OK);
}

void degenerate() {
    nm_options options = default_options();
    options.algorithm = NM_ALGORITHM_DELAUNAY;
    const MeshHandle line = create(generate("collinear", 3, 100));
    EXPECT(nm_run(line.get(), &options), NM_DEGENERATE_INPUT, "rank", "1");
    const MeshHandle plane = create(generate("coplanar", 3, 100));
    EXPECT(nm_run(plane.get(), &options), NM_DEGENERATE_INPUT, "rank", "2");
    CHECK_EQUAL(counts_of(plane.get()).simplices, 0u);
    CHECK_STATUS(nm_run(plane.get(), nullptr), NM_OK);  // an ordinary input for NETMESH
}

// Points that need more memory than the process may have. Last: the limit stays. A sanitizer's
// allocator has its own limit, which the test's environment sets.
void out_of_memory() {
    const std::size_t n = std::size_t{1} << 26;
    const std::size_t bytes = n * 2 * sizeof(double);
    void* zeros = mmap(nullptr, bytes, PROT_READ, MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
    REQUIRE(zeros != MAP_FAILED);
    const rlimit limit = {bytes + bytes / 2, bytes + bytes / 2};
    if (!check::address_sanitizer) REQUIRE(setrlimit(RLIMIT_AS, &limit) == 0);
    EXPECT(create_status(2, n, static_cast<const double*>(zeros)), NM_OUT_OF_MEMORY, "bytes");
    CHECK_STATUS(create_status(2, 5, square.data()), NM_OK);
}

void names() {
    const char* const expected[] = {"NM_OK", "NM_NULL_ARGUMENT", "NM_INVALID_ARGUMENT", "NM_NON_FINITE",
                                    "NM_DIMENSION", "NM_CAPACITY", "NM_DEGENERATE_INPUT", "NM_LIMIT",
                                    "NM_CANCELLED", "NM_IO", "NM_FORMAT_ERROR", "NM_STATE",
                                    "NM_OUT_OF_MEMORY", "NM_PANIC"};
    for (int value = 0; value < 14; ++value) {
        CHECK_EQUAL(std::string(nm_status_name(static_cast<nm_status>(value))), expected[value]);
    }
    CHECK_EQUAL(std::string(nm_status_name(static_cast<nm_status>(999))), "NM_UNKNOWN");
}

}  // namespace

int main(int count, char** arguments) {
    if (count != 2) {
        std::cerr << "usage: api_misuse <directory>\n";
        return 2;
    }
    const Files files(arguments[1]);
    CHECK_EQUAL(check::last_error(), "");  // nothing has failed yet
    names();
    creation();
    reading(files);
    before_a_run();
    getters();
    options();
    cancelled();
    state();
    degenerate();
    writing(files);
    out_of_memory();
    // NM_PANIC is a defect of the library: no call provokes it.
    for (int status = NM_NULL_ARGUMENT; status <= NM_OUT_OF_MEMORY; ++status) {
        CHECK_SAYING(provoked.count(status) == 1, nm_status_name(static_cast<nm_status>(status)));
    }
    return check::result("api_misuse");
}
