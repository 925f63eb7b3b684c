// One input, one dimension, one kind of output: netmesh's own certificate, its promise of quality,
// and CGAL's word on the same mesh.
//
//   cgal_cross_check <generator or data file> <dim> <hierarchical | well_spaced | delaunay>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <iostream>
#include <string>

#include "certify.hpp"
#include "check.hpp"
#include "inputs.hpp"
#include "mesh.hpp"
#include "reference.hpp"

namespace {

// Times the parts of a test.
class Stopwatch {
public:
    void lap(const char* what) {
        const auto now = std::chrono::steady_clock::now();
        std::cout << what << ": " << std::chrono::duration<double>(now - start_).count() << " s" << std::endl;
        start_ = now;
    }

private:
    std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

void check_against_cgal(const ExportedMesh& mesh, bool generic_input_only) {
    Stopwatch stopwatch;
    REQUIRE(within_exact_range(mesh.points));
    const auto reference = make_reference(mesh.dim, mesh.points.data(), mesh.vertex_count());
    const Certificate certificate = certify(mesh, *reference);
    for (const std::string& violation : certificate.violations) CHECK_SAYING(false, violation);
    CHECK(certificate.violations.empty());
    stopwatch.lap("certification by CGAL's predicates");
    const Comparison comparison = compare(mesh, certificate, *reference);
    stopwatch.lap("comparison with CGAL's triangulation");
    std::cout << "facets " << certificate.facets << " (" << certificate.hull_facets << " on the hull, "
              << certificate.ties << " cospherical ties), simplices " << comparison.ours << ", CGAL's "
              << comparison.theirs << ", differing " << comparison.differing << std::endl;
    // Outside ties the Delaunay triangulation is unique: there the sets must be equal.
    CHECK_EQUAL(comparison.inexcusable, 0u);
    if (certificate.ties == 0) {
        CHECK_EQUAL(comparison.differing, 0u);
        CHECK_EQUAL(comparison.ours, comparison.theirs);
    }
    if (generic_input_only) CHECK_EQUAL(certificate.ties, 0u);
    // In the plane even ties leave the number of triangles alone.
    if (mesh.dim == 2) CHECK_EQUAL(comparison.ours, comparison.theirs);
    CHECK_AT_MOST(std::fabs(comparison.volume_ratio - 1.0), 1e-9);
}

void check_quality(const nm_mesh* mesh, unsigned dim, bool generic) {
    const nm_quality quality = quality_of(mesh);
    const double bound = default_aspect_bound(dim);
    std::cout << "aspect " << quality.worst_aspect << " (bound " << bound << ", anywhere "
              << quality.worst_aspect_anywhere << ", cages " << quality.worst_cage_aspect
              << "), degree " << quality.max_degree << ", precision-limited "
              << quality.precision_limited << std::endl;
    CHECK(quality.worst_aspect >= 1.0);
    CHECK_AT_MOST(quality.worst_aspect, bound * (1 + 1e-7));
    if (generic) {
        CHECK_EQUAL(quality.precision_limited, 0u);
        CHECK_EQUAL(stats_of(mesh).precision_limited, 0u);
    }
}

}  // namespace

int main(int count, char** arguments) {
    if (count != 4) {
        std::cerr << "usage: cgal_cross_check <input> <dim> <hierarchical|well_spaced|delaunay>\n";
        return 2;
    }
    const std::string input = arguments[1];
    const auto dim = static_cast<unsigned>(std::atoi(arguments[2]));
    const std::string output = arguments[3];

    PointSet points;
    if (input.find('.') == std::string::npos) {
        // Lines in space, and planes in 4D, fill up with Steiner points, many to an input.
        const bool is_line = dim > 2 && (input == "collinear" || input == "two_skew_lines");
        const bool is_plane = dim == 4 && input == "coplanar";
        points = generate(input, dim, (dim == 4 ? 1000 : 10000) / (is_line ? 6 : is_plane ? 2 : 1));
    } else if (auto read = read_data_file(input, dim)) {
        points = *read;
        // The scan has 38,000 points, all of a kind.
        const std::size_t most = dim == 3 ? 15000 : points.size();
        if (points.size() > most) points.coordinates.resize(most * dim);
    } else {
        return check::skip(input + " is not in the data directory (set NETMESH_DATA to it)");
    }

    nm_options options = default_options();
    if (output == "well_spaced") {
        options.output = NM_OUTPUT_WELL_SPACED;
    } else if (output == "delaunay") {
        options.algorithm = NM_ALGORITHM_DELAUNAY;
    } else {
        REQUIRE(output == "hierarchical");
    }
    const bool plain = output == "delaunay";

    const MeshHandle mesh = create(points);
    REQUIRE_OK(nm_run(mesh.get(), &options));
    const ExportedMesh exported = export_mesh(mesh.get());
    const nm_counts counts = counts_of(mesh.get());
    std::cout << input << " " << dim << "D " << output << ": " << counts.inputs << " inputs ("
              << counts.duplicates << " duplicates), " << counts.vertices << " vertices, m/n "
              << static_cast<double>(counts.vertices) / static_cast<double>(counts.inputs) << ", "
              << counts.domains << " domains, " << stats_of(mesh.get()).seconds << " s" << std::endl;

    check_inputs_kept(points, mesh.get(), exported);
    Stopwatch stopwatch;
    check_certificate(mesh.get(), plain ? 2 : 3);
    stopwatch.lap("netmesh's own certificate");
    if (plain) {
        CHECK_EQUAL(counts.vertices, counts.inputs - counts.duplicates);
    } else {
        check_quality(mesh.get(), dim, points.generic);
        stopwatch.lap("quality");
    }
    if (output == "well_spaced") CHECK_EQUAL(counts.domains, 1u);
    if (input == "duplicates") CHECK_EQUAL(counts.duplicates, points.size() / 2);
    check_against_cgal(exported, plain && points.generic);
    return check::result("cgal_cross_check");
}
