// netmesh/tetgen.hpp against TetGen: the same conventions, the same tetrahedralization where there is
// only one, the same switches.
//
//   tetgen_adapter          everything
//   tetgen_adapter brief    what valgrind watches
#include <netmesh/tetgen.hpp>

#include <algorithm>
#include <array>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "check.hpp"
#include "expect_error.hpp"
#include "point_sets.hpp"
#include "tetrahedron_quality.hpp"

namespace {

using Vertices = std::array<int, 4>;
using Face = std::array<int, 3>;

void put(const PointSet& points, tetgenio& in, int first_number = 0, bool markers = false) {
    in.firstnumber = first_number;
    in.numberofpoints = static_cast<int>(points.size());
    in.pointlist = new REAL[points.coordinates.size()];
    std::copy(points.coordinates.begin(), points.coordinates.end(), in.pointlist);
    if (markers) {
        in.pointmarkerlist = new int[points.size()];
        for (std::size_t i = 0; i < points.size(); ++i) in.pointmarkerlist[i] = 100 + static_cast<int>(i);
    }
}

// TetGen's own; its switches are not const.
void by_tetgen(std::string switches, tetgenio& in, tetgenio& out) {
    ::tetrahedralize((switches + "Q").data(), &in, &out);
}

Vertices vertices_of(const tetgenio& io, int tetrahedron) {
    const int* list = io.tetrahedronlist + 4 * tetrahedron;
    return {list[0], list[1], list[2], list[3]};
}

const REAL* point_of(const tetgenio& io, int number) { return io.pointlist + 3 * (number - io.firstnumber); }

double determinant(const REAL* a, const REAL* b, const REAL* c, const REAL* d) {
    const auto minus = [](const REAL* p, const REAL* q) {
        return tetrahedra::Vector{p[0] - q[0], p[1] - q[1], p[2] - q[2]};
    };
    return tetrahedra::dot(tetrahedra::cross(minus(b, a), minus(c, a)), minus(d, a));
}

// Promises of both for each output, as far as doubles can tell. exact: no determinant is so small
// that its sign as computed may be wrong.
void check_conventions(const tetgenio& io, bool exact) {
    CHECK_EQUAL(io.numberofcorners, 4);
    CHECK(io.numberoftetrahedra > 0 && io.numberofpoints > 3);
    const int first = io.firstnumber;
    std::map<Face, int> hull;  // sorted vertices: how often
    for (int t = 0; t < io.numberoftetrahedra; ++t) {
        const Vertices own = vertices_of(io, t);
        for (const int vertex : own) REQUIRE(vertex >= first && vertex < first + io.numberofpoints);
        if (exact) {
            CHECK(determinant(point_of(io, own[0]), point_of(io, own[1]), point_of(io, own[2]), point_of(io, own[3])) > 0);
        }
        for (std::size_t i = 0; i < 4 && io.neighborlist != nullptr; ++i) {
            const int neighbor = io.neighborlist[4 * static_cast<std::size_t>(t) + i];
            Face face{};
            std::copy_if(own.begin(), own.end(), face.begin(), [&](int vertex) { return vertex != own[i]; });
            if (neighbor == -1) {
                std::sort(face.begin(), face.end());
                ++hull[face];
                continue;
            }
            REQUIRE(neighbor >= first && neighbor < first + io.numberoftetrahedra);
            const Vertices other = vertices_of(io, neighbor - first);
            for (const int vertex : face) CHECK(std::count(other.begin(), other.end(), vertex) == 1);
            CHECK(std::count(other.begin(), other.end(), own[i]) == 0);
        }
    }
    if (io.neighborlist == nullptr || io.trifacelist == nullptr) return;
    CHECK_EQUAL(static_cast<std::size_t>(io.numberoftrifaces), hull.size());
    for (int f = 0; f < io.numberoftrifaces; ++f) {
        Face face{io.trifacelist[3 * f], io.trifacelist[3 * f + 1], io.trifacelist[3 * f + 2]};
        // Seen from outside: no vertex is on the side that the normal points to.
        for (int v = 0; exact && v < io.numberofpoints; ++v) {
            if (std::count(face.begin(), face.end(), v + first) != 0) continue;
            CHECK(determinant(point_of(io, face[0]), point_of(io, face[1]), point_of(io, face[2]), io.pointlist + 3 * v) <= 0);
        }
        std::sort(face.begin(), face.end());
        CHECK(hull[face] == 1);
        --hull[face];
    }
}

// Sorted vertices, and the sorted neighbours' vertices opposite each; the same for equal meshes.
std::vector<std::pair<Vertices, std::array<Vertices, 4>>> canonical(const tetgenio& io) {
    const auto sorted = [&](int number) {
        Vertices vertices{-1, -1, -1, -1};
        if (number == -1) return vertices;
        vertices = vertices_of(io, number - io.firstnumber);
        for (int& vertex : vertices) vertex -= io.firstnumber;
        std::sort(vertices.begin(), vertices.end());
        return vertices;
    };
    std::vector<std::pair<Vertices, std::array<Vertices, 4>>> all;
    for (int t = 0; t < io.numberoftetrahedra; ++t) {
        const int number = t + io.firstnumber;
        const Vertices in_order = vertices_of(io, t), vertices = sorted(number);
        std::array<Vertices, 4> neighbors{};
        for (std::size_t i = 0; i < 4; ++i) {
            const auto place = static_cast<std::size_t>(
                std::lower_bound(vertices.begin(), vertices.end(), in_order[i] - io.firstnumber) - vertices.begin());
            neighbors[place] = sorted(io.neighborlist[4 * static_cast<std::size_t>(t) + i]);
        }
        all.emplace_back(vertices, neighbors);
    }
    std::sort(all.begin(), all.end());
    return all;
}

void the_same_as_tetgen() {
    for (const NamedPoints& input : adapter_inputs(3)) {
        if (!input.full_rank) continue;
        for (const int first : {0, 1}) {
            check::context = input.name + ", firstnumber " + std::to_string(first);
            tetgenio in, ours, theirs;
            put(input.points, in, first, true);
            netmesh::tetgen::tetrahedralize("n", &in, &ours);
            CHECK_EQUAL(ours.firstnumber, first);
            const bool plain = input.name != "ulp_pairs" && input.name != "clusters" && input.name != "two_skew_lines";
            check_conventions(ours, plain);
            CHECK(ours.pointmarkerlist != nullptr);
            if (!plain) continue;  // TetGen merges points that are near each other
            by_tetgen("n", in, theirs);
            check_conventions(theirs, plain);
            CHECK_EQUAL(ours.numberofpoints, theirs.numberofpoints);
            CHECK((ours.trifacelist != nullptr) == (theirs.trifacelist != nullptr));
            CHECK((ours.trifacemarkerlist != nullptr) == (theirs.trifacemarkerlist != nullptr));
            CHECK((ours.pointmarkerlist != nullptr) == (theirs.pointmarkerlist != nullptr));
            CHECK((ours.edgelist != nullptr) == (theirs.edgelist != nullptr));
            if (input.name == "uniform" || input.name == "gaussian") {
                CHECK_EQUAL(ours.numberoftrifaces, theirs.numberoftrifaces);
                CHECK(std::equal(ours.pointlist, ours.pointlist + 3 * ours.numberofpoints, theirs.pointlist));
                CHECK(std::equal(ours.pointmarkerlist, ours.pointmarkerlist + ours.numberofpoints, theirs.pointmarkerlist));
                CHECK(canonical(ours) == canonical(theirs));
            }
        }
    }
    check::context.clear();
}

void markers_and_duplicates() {
    PointSet points = generate("uniform", 3, 20);
    points.coordinates.insert(points.coordinates.end(), points.point(3), points.point(3) + 3);  // 20 is 3
    points.coordinates.insert(points.coordinates.end(), {0.5, 0.25, 0.125});
    tetgenio in, out;
    put(points, in, 1, true);
    netmesh::tetgen::tetrahedralize("q2", &in, &out);
    CHECK(out.numberofpoints > 21);
    CHECK_EQUAL(out.pointmarkerlist[3], 103);
    CHECK_EQUAL(out.pointmarkerlist[20], 121);  // the 21st distinct one
    CHECK(std::equal(out.pointlist + 60, out.pointlist + 63, points.point(21)));
    for (int v = 21; v < out.numberofpoints; ++v) CHECK_EQUAL(out.pointmarkerlist[v], 0);
}

void quality() {
    for (const double ratio : {1.25, 2.0}) {
        tetgenio in, out;
        put(generate("gaussian", 3, 200), in);
        // Without a number it is TetGen's 2.
        netmesh::tetgen::tetrahedralize(ratio == 2.0 ? "q" : "-q1.25", &in, &out);
        check_conventions(out, false);
        double worst = 0;
        for (int t = 0; t < out.numberoftetrahedra; ++t) {
            tetrahedra::Vector p[4];
            for (std::size_t i = 0; i < 4; ++i) {
                const REAL* x = point_of(out, vertices_of(out, t)[i]);
                p[i] = {x[0], x[1], x[2]};
            }
            worst = std::max(worst, tetrahedra::radius_edge(p));
        }
        CHECK_AT_MOST(worst, ratio * (1 + 1e-9));
        CHECK(worst > 1.2);  // the bound is what ends the refinement
        if (ratio == 2.0) CHECK(worst > 1.25 * (1 + 1e-9));
        CHECK(std::equal(in.pointlist, in.pointlist + 600, out.pointlist));
    }
}

void lists_that_are_asked_for() {
    const PointSet points = generate("uniform", 3, 30);
    tetgenio in, out;
    put(points, in, 1, true);
    netmesh::tetgen::tetrahedralize("FBz", &in, &out);
    CHECK(out.trifacelist == nullptr && out.numberoftrifaces == 0);
    CHECK(out.pointmarkerlist == nullptr && out.neighborlist == nullptr);
    CHECK_EQUAL(out.firstnumber, 0);
    CHECK_EQUAL(*std::min_element(out.tetrahedronlist, out.tetrahedronlist + 4 * out.numberoftetrahedra), 0);
    const int tetrahedra = out.numberoftetrahedra;
    // The arrays that out held are replaced and freed.
    netmesh::tetgen::tetrahedralize("-nIQV", &in, &out);
    CHECK_EQUAL(out.numberoftetrahedra, tetrahedra);
    CHECK(out.trifacelist != nullptr && out.neighborlist != nullptr && out.pointmarkerlist != nullptr);
    CHECK_EQUAL(*std::min_element(out.tetrahedronlist, out.tetrahedronlist + 4 * out.numberoftetrahedra), 1);
    check_conventions(out, true);
    netmesh::tetgen::tetrahedralize(static_cast<const char*>(nullptr), &in, &out);
    CHECK_EQUAL(out.numberoftetrahedra, tetrahedra);
}

// Switches that TetGen parses are refused or understood as the same text is.
void behaviors() {
    tetgenio in, from_text, from_behavior;
    put(generate("uniform", 3, 60), in, 1, true);
    for (const std::string text : {"", "n", "q1.5n", "qz", "FB", "nz"}) {
        check::context = text;
        tetgenbehavior behavior;
        REQUIRE(behavior.parse_commandline((text + "Q").data()));
        netmesh::tetgen::tetrahedralize(text.c_str(), &in, &from_text);
        netmesh::tetgen::tetrahedralize(&behavior, &in, &from_behavior);
        CHECK_EQUAL(from_text.numberofpoints, from_behavior.numberofpoints);
        CHECK_EQUAL(from_text.numberoftetrahedra, from_behavior.numberoftetrahedra);
        CHECK(std::equal(from_text.tetrahedronlist, from_text.tetrahedronlist + 4 * from_text.numberoftetrahedra,
                         from_behavior.tetrahedronlist));
        CHECK_EQUAL(from_text.firstnumber, from_behavior.firstnumber);
        CHECK((from_text.neighborlist == nullptr) == (from_behavior.neighborlist == nullptr));
        CHECK((from_text.trifacelist == nullptr) == (from_behavior.trifacelist == nullptr));
        CHECK((from_text.pointmarkerlist == nullptr) == (from_behavior.pointmarkerlist == nullptr));
    }
    using Refused = std::pair<std::string, std::string>;
    // TetGen's parser sets p for Y and d.
    for (const auto& [text, name] : {Refused{"p", "p"}, {"r", "r"}, {"Y", "p"}, {"rY", "r"}, {"R", "R"}, {"w", "w"},
                                     {"m", "m"}, {"a0.1", "a"}, {"pA", "p"}, {"i", "i"}, {"d", "p"}, {"c", "c"},
                                     {"f", "f"}, {"e", "e"}, {"v", "v"}, {"J", "J"}, {"C", "C"}, {"N", "N"},
                                     {"E", "E"}, {"g", "g"}, {"k", "k"}, {"nn", "nn"}, {"o2", "o"}, {"S9", "S"},
                                     {"q1.5/12", "q/"}}) {
        check::context = text;
        tetgenbehavior behavior;
        REQUIRE(behavior.parse_commandline((text + "Q").data()));
        const auto& said = name;
        expect_error(__LINE__, NM_INVALID_ARGUMENT, "'" + said + "'",
                     [&] { netmesh::tetgen::tetrahedralize(&behavior, &in, &from_behavior); });
    }
    check::context.clear();
}

void refused_switches() {
    tetgenio in, out;
    put(generate("uniform", 3, 20), in);
    netmesh::tetgen::tetrahedralize("", &in, &out);
    const int tetrahedra = out.numberoftetrahedra;
    const int* list = out.tetrahedronlist;
    for (const char letter : std::string("prYaAmiwcdsSoOTXMbxlLDfevgkJNECRGhHtuPUW1/ ")) {
        const std::string name(1, letter);
        expect_error(__LINE__, NM_INVALID_ARGUMENT, "'" + name + "'",
                     [&] { netmesh::tetgen::tetrahedralize(("Qn" + name).c_str(), &in, &out); });
    }
    for (const char* text : {"nn", "q1.4/10", "q1..5", "Q-n", "q1.5.2"}) {
        expect_error(__LINE__, NM_INVALID_ARGUMENT, "switch", [&] { netmesh::tetgen::tetrahedralize(text, &in, &out); });
    }
    expect_error(__LINE__, NM_INVALID_ARGUMENT, "quality_bound",
                 [&] { netmesh::tetgen::tetrahedralize("q0.9", &in, &out); });
    CHECK(out.numberoftetrahedra == tetrahedra && out.tetrahedronlist == list);  // as it was
}

void refused_inputs() {
    tetgenio in, out;
    put(generate("uniform", 3, 20), in);
    const auto refused = [&](int line, const char* word, nm_status status = NM_INVALID_ARGUMENT) {
        expect_error(line, status, word, [&] { netmesh::tetgen::tetrahedralize("", &in, &out); });
    };
    const auto counted = [&](int line, int& count, const char* name) {
        count = 1;
        refused(line, name);
        count = 0;
    };
    counted(__LINE__, in.numberofpointattributes, "numberofpointattributes");
    counted(__LINE__, in.numberofpointmtrs, "numberofpointmtrs");
    counted(__LINE__, in.numberoffacets, "numberoffacets");
    counted(__LINE__, in.numberoftetrahedra, "numberoftetrahedra");
    counted(__LINE__, in.numberoftrifaces, "numberoftrifaces");
    counted(__LINE__, in.numberofedges, "numberofedges");
    counted(__LINE__, in.numberofholes, "numberofholes");
    counted(__LINE__, in.numberofregions, "numberofregions");
    tetgenio::pointparam parameter;
    in.pointparamlist = &parameter;
    refused(__LINE__, "pointparamlist");
    in.pointparamlist = nullptr;
    in.mesh_dim = 2;
    refused(__LINE__, "mesh_dim");
    in.mesh_dim = 3;
    in.firstnumber = 2;
    refused(__LINE__, "firstnumber");
    in.firstnumber = 0;
    in.numberofpoints = -1;
    refused(__LINE__, "numberofpoints");
    in.numberofpoints = 1;
    refused(__LINE__, "two", NM_DEGENERATE_INPUT);
    in.numberofpoints = 20;
    REAL* points = std::exchange(in.pointlist, nullptr);
    refused(__LINE__, "points", NM_NULL_ARGUMENT);
    in.pointlist = points;
    namespace adapter = netmesh::tetgen;
    expect_error(__LINE__, NM_NULL_ARGUMENT, "in is", [&] { adapter::tetrahedralize("", nullptr, &out); });
    expect_error(__LINE__, NM_NULL_ARGUMENT, "out is", [&] { adapter::tetrahedralize("", &in, nullptr); });
    expect_error(__LINE__, NM_INVALID_ARGUMENT, "same", [&] { adapter::tetrahedralize("", &in, &in); });
    expect_error(__LINE__, NM_INVALID_ARGUMENT, "addin", [&] { adapter::tetrahedralize("", &in, &out, &in); });
    expect_error(__LINE__, NM_INVALID_ARGUMENT, "bgmin",
                 [&] { adapter::tetrahedralize("", &in, &out, nullptr, &in); });
    expect_error(__LINE__, NM_NULL_ARGUMENT, "behavior",
                 [&] { adapter::tetrahedralize(static_cast<tetgenbehavior*>(nullptr), &in, &out); });
    netmesh::mesh plane(2, generate("uniform", 2, 20).coordinates), unmeshed = netmesh::tetgen::make_mesh(in);
    plane.run();
    expect_error(__LINE__, NM_DIMENSION, "dim = 2", [&] { netmesh::tetgen::fill(plane, out); });
    expect_error(__LINE__, NM_STATE, "run", [&] { netmesh::tetgen::fill(unmeshed, out); });
    CHECK(out.pointlist == nullptr && out.numberofpoints == 0);
}

// TetGen reads what was made: it refines our mesh of the same points.
void tetgen_goes_on() {
    tetgenio in, out, again;
    put(generate("uniform", 3, 200), in);
    netmesh::tetgen::tetrahedralize("", &in, &out);
    by_tetgen("rnF", out, again);
    CHECK_EQUAL(again.numberofpoints, out.numberofpoints);
    CHECK_EQUAL(again.numberoftetrahedra, out.numberoftetrahedra);
    check_conventions(again, true);
}

}  // namespace

int main(int count, char** arguments) {
    const bool brief = count == 2 && std::string(arguments[1]) == "brief";
    markers_and_duplicates();
    lists_that_are_asked_for();
    refused_switches();
    refused_inputs();
    if (!brief) {
        the_same_as_tetgen();
        quality();
        behaviors();
        tetgen_goes_on();
    }
    return check::result("tetgen_adapter");
}
