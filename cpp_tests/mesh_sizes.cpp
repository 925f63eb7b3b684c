// Sizes of meshes. The promised sizes at the default bound; then TetGen and netmesh on the
// same inputs with the same criterion, as a table on the screen and in the given file.
//
//   mesh_sizes <table.md>
#include <cstdio>
#include <fstream>
#include <iostream>
#include <string>

#include "check.hpp"
#include "inputs.hpp"
#include "mesh.hpp"
#include "tetgen_box.hpp"
#include "tetrahedron_quality.hpp"

namespace {

constexpr double radius_edge_bound = 2.0;
// p: the box; q2.0/0: radius-edge 2, no dihedral bound; O0/0: no optimisation afterwards, as ours
// has none; Q: quiet.
const char* const tetgen_switches = "pq2.0/0O0/0Q";

double per_input(std::size_t vertices, std::size_t inputs) {
    return static_cast<double>(vertices) / static_cast<double>(inputs);
}

void check_default_size(unsigned dim, double most) {
    const PointSet points = generate("uniform", dim, 10000);
    const MeshHandle mesh = create(points);
    REQUIRE_OK(nm_run(mesh.get(), nullptr));
    const nm_counts counts = counts_of(mesh.get());
    const double ratio = per_input(counts.vertices, counts.inputs);
    std::printf("uniform 10000, %uD, hierarchical, default bound: m/n %.3f (at most %g), %.3f s\n", dim,
                ratio, most, stats_of(mesh.get()).seconds);
    CHECK_AT_MOST(ratio, most);
    check_certificate(mesh.get());
}

class Table {
public:
    Table() {
        text_ = "# Mesh sizes, 3D, radius-edge bound 2.0\n\n"
                "TetGen 1.5 with `" + std::string(tetgen_switches) + "` in a box of three times the "
                "bounding box; netmesh with\n`NM_CRITERION_RADIUS_EDGE` and `NM_OUTPUT_WELL_SPACED`. "
                "m/n: vertices per input, those of the box or\nof the root cage included. Quality: over "
                "the tetrahedra that have an input as a vertex.\n\n"
                "| input | n | mesher | vertices | m/n | tetrahedra | worst radius-edge | mean | least "
                "dihedral | seconds |\n|---|---|---|---|---|---|---|---|---|---|\n";
    }

    void row(const std::string& input, std::size_t n, const char* mesher, std::size_t vertices,
             std::size_t tetrahedra, const TetrahedronQuality& quality, double seconds) {
        char line[256];
        std::snprintf(line, sizeof line, "| %s | %zu | %s | %zu | %.3f | %zu | %.3f | %.3f | %.2f | %.3f |\n",
                      input.c_str(), n, mesher, vertices, per_input(vertices, n), tetrahedra,
                      quality.worst_radius_edge, quality.mean_radius_edge,
                      quality.least_dihedral_degrees, seconds);
        text_ += line;
    }

    const std::string& text() const { return text_; }

private:
    std::string text_;
};

void tetgen_row(Table& table, const std::string& name, const PointSet& points) {
    const TetgenResult result = tetgen_in_box(points, tetgen_switches);
    if (!CHECK_EQUAL(result.error, 0)) return;
    // The box takes the ids 0 to 7, the inputs the next n.
    const auto touches_input = [&](const std::uint32_t* ids) {
        for (int i = 0; i < 4; ++i) {
            if (ids[i] >= 8 && ids[i] < 8 + points.size()) return true;
        }
        return false;
    };
    const auto quality = tetrahedra::measure(result.points, result.tetrahedra, touches_input);
    CHECK_AT_MOST(quality.worst_radius_edge, radius_edge_bound * (1 + 1e-6));
    table.row(name, points.size(), "TetGen", result.points.size() / 3, result.tetrahedra.size() / 4,
              quality, result.seconds);
}

void netmesh_row(Table& table, const std::string& name, const PointSet& points) {
    const MeshHandle mesh = create(points);
    nm_options options = default_options();
    options.output = NM_OUTPUT_WELL_SPACED;
    options.criterion = NM_CRITERION_RADIUS_EDGE;
    options.quality_bound = radius_edge_bound;
    REQUIRE_OK(nm_run(mesh.get(), &options));
    check_certificate(mesh.get());
    const ExportedMesh exported = export_mesh(mesh.get());
    check_inputs_kept(points, mesh.get(), exported);
    const auto touches_input = [&](const std::uint32_t* ids) {
        for (int i = 0; i < 4; ++i) {
            if (exported.kinds[ids[i]] == NM_VERTEX_INPUT) return true;
        }
        return false;
    };
    const auto quality = tetrahedra::measure(exported.points, exported.simplices, touches_input);
    CHECK_AT_MOST(quality.worst_radius_edge, radius_edge_bound * (1 + 1e-6));
    table.row(name, points.size(), "netmesh", exported.vertex_count(), exported.simplex_count(), quality,
              stats_of(mesh.get()).seconds);
}

void compare(Table& table, const std::string& name, const PointSet& points) {
    check::context = name;
    tetgen_row(table, name, points);
    netmesh_row(table, name, points);
}

}  // namespace

int main(int count, char** arguments) {
    if (count != 2) {
        std::cerr << "usage: mesh_sizes <table.md>\n";
        return 2;
    }
    check_default_size(2, 3.6);
    check_default_size(3, 3.4);

    Table table;
    for (const char* name : {"uniform", "gaussian", "sphere", "grid"}) {
        compare(table, name, generate(name, 3, 10000));
    }
    for (const char* file : {"pdb_4hhb_protein.xyz", "usgs_quakes_week.xyz"}) {
        if (const auto points = read_data_file(file, 3)) {
            compare(table, file, *points);
        } else {
            std::cout << "left out, not in the data directory: " << file << std::endl;
        }
    }
    std::cout << "\n" << table.text() << std::endl;
    std::ofstream file(arguments[1]);
    file << table.text();
    file.close();
    CHECK_SAYING(!file.fail(), arguments[1]);
    return check::result("mesh_sizes");
}
