// netmesh/tetgen.hpp - netmesh behind TetGen's interface: tetgenio in and out, and a tetrahedralize
// for point sets (TetGen 1.5 or later). License of this file: MIT OR Apache-2.0. tetgen.h, which it
// includes, is AGPL (or commercial): a program that uses this file is under its terms. TetGen's library
// is not needed.
//
//     tetgenio in, out;                                     // in.pointlist, in.numberofpoints
//     netmesh::tetgen::tetrahedralize("q1.5n", &in, &out);  // for ::tetrahedralize
//
// (with its namespace: a using declaration does not hide TetGen's function, which C++ finds through
// its arguments), or in steps, for netmesh's options, domains and so on:
//
//     netmesh::mesh mesh = netmesh::tetgen::make_mesh(in);
//     mesh.run(options);
//     netmesh::tetgen::fill(mesh, out);
//
// SWITCHES, with or without a leading '-':
//   (none)   the Delaunay tetrahedralization of the points (NM_ALGORITHM_DELAUNAY), as TetGen's
//   q        Steiner points until no tetrahedron's circumradius is more than 2 times its shortest
//   q1.5     edge, or that many times (NM_CRITERION_RADIUS_EDGE, NM_OUTPUT_WELL_SPACED). TetGen
//            knows q for bounded domains only. Here the mesh reaches beyond the points' hull, with a
//            cage round it; the ratio is in the range of nm_options.quality_bound
//   n        neighborlist
//   z        numbers start at 0 whatever in->firstnumber is, and out->firstnumber is 0
//   F, B     no trifacelist; no pointmarkerlist
//   I Q V    accepted: no files are written and nothing is printed anyway
// Every other switch is an error (NM_INVALID_ARGUMENT) whose message names it, and so is what in
// holds besides points and their markers, an addin and a bgmin.
//
// OUT is what TetGen makes of points: pointlist, tetrahedronlist with four vertices, det[v1-v0, v2-v0,
// v3-v0] > 0; neighborlist (n), the i-th opposite vertex i, -1 beyond the hull; trifacelist, the facets
// of the hull, counterclockwise seen from outside; pointmarkerlist where in has one. Numbers start
// at in->firstnumber. Exact duplicates are left out, as TetGen does; the first one stays (TetGen
// keeps any). Points keep their order; Steiner points follow, with marker 0. Memory is what
// tetgenio's destructor frees; what out held before is freed.
//
// Errors are thrown as netmesh::error, and leave out as it was.

#ifndef NETMESH_TETGEN_HPP
#define NETMESH_TETGEN_HPP

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <locale>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include <tetgen.h>

#include "strided.hpp"

#if !NETMESH_EXCEPTIONS
#error "netmesh/tetgen.hpp needs exceptions"
#endif

namespace netmesh {
namespace tetgen {

// Arrays that fill() writes beside points and tetrahedra.
struct layout {
    int first_number = 0;                // of points and tetrahedra
    bool neighbors = false;              // neighborlist
    bool faces = true;                   // trifacelist
    const int *input_markers = nullptr;  // one per input: pointmarkerlist
};

// Switches that are understood.
struct switches {
    bool quality = false;
    double ratio = 2;
    bool neighbors = false;
    bool from_zero = false;
    bool faces = true;
    bool markers = true;
};

namespace detail {

[[noreturn]] inline void refuse(const std::string &what) { throw error(NM_INVALID_ARGUMENT, what); }

[[noreturn]] inline void refuse_switch(const std::string &name) {
    refuse("the switch '" + name + "' is not understood; for point sets there are q n z F B I Q V");
}

// Reads the digits and points of text from place on; place moves behind them.
inline std::string number_at(const std::string &text, std::size_t &place) {
    const std::size_t start = place;
    place = text.find_first_not_of("0123456789.", start);
    place = place == std::string::npos ? text.size() : place;
    return text.substr(start, place - start);
}

// Reads a number, whatever the locale.
inline double number(const std::string &digits) {
    std::istringstream stream(digits);
    stream.imbue(std::locale::classic());
    double value = 0;
    if (!(stream >> value) || !(stream >> std::ws).eof()) {
        refuse("the switch 'q" + digits + "' has no number");
    }
    return value;
}

inline void refuse_unless_null(const void *pointer, const char *name) {
    if (pointer != nullptr) {
        refuse(std::string(name) + " is not NULL: only points are meshed");
    }
}

inline void refuse_unless_zero(int number, const char *name) {
    if (number != 0) {
        refuse(std::string(name) + " = " + std::to_string(number) + ": only points are meshed");
    }
}

inline int to_int(std::uint64_t number, const char *what) {
    if (number > static_cast<std::uint64_t>(std::numeric_limits<int>::max())) {
        throw error(NM_CAPACITY, std::to_string(number) + " " + what + " are more than int holds");
    }
    return static_cast<int>(number);
}

inline void copy_points(const mesh &mesh, tetgenio &out) {
    const table<double> points = mesh.points();
    out.numberofpoints = to_int(points.size(), "points");
    out.pointlist = new REAL[points.flat().size()];
    for (std::size_t i = 0; i < points.flat().size(); ++i) {
        out.pointlist[i] = points.data()[i];
    }
}

// Returns the markers of inputs, the first duplicate's; 0 for other vertices.
inline void copy_markers(const mesh &mesh, const int *input_markers, tetgenio &out) {
    const auto count = static_cast<std::size_t>(out.numberofpoints);
    out.pointmarkerlist = new int[count]();
    const std::vector<std::uint32_t> vertices = mesh.input_vertices();
    for (std::size_t i = vertices.size(); i-- > 0;) {
        out.pointmarkerlist[vertices[i]] = input_markers[i];
    }
}

inline int *numbered(const table<std::uint32_t> &ids, int first) {
    int *list = new int[ids.flat().size()];
    for (std::size_t i = 0; i < ids.flat().size(); ++i) {
        const std::uint32_t id = ids.data()[i];
        list[i] = id == NM_NONE ? -1 : static_cast<int>(id) + first;
    }
    return list;
}

// Returns the facets without a neighbour, each seen from outside.
inline void copy_hull(const table<std::uint32_t> &simplices, const table<std::uint32_t> &neighbors,
                      int first, tetgenio &out) {
    constexpr std::array<std::array<std::size_t, 3>, 4> outward{
        {{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}}};
    std::vector<int> faces;
    for (std::size_t s = 0; s < simplices.size(); ++s) {
        for (std::size_t i = 0; i < 4; ++i) {
            if (neighbors[s][i] != NM_NONE) {
                continue;
            }
            for (const std::size_t vertex : outward[i]) {
                faces.push_back(static_cast<int>(simplices[s][vertex]) + first);
            }
        }
    }
    out.numberoftrifaces = to_int(faces.size() / 3, "faces");
    out.trifacelist = new int[faces.size()];
    for (std::size_t i = 0; i < faces.size(); ++i) {
        out.trifacelist[i] = faces[i];
    }
}

// A tetgenio copies as a struct of pointers: the lists change their owner.
inline void move_lists(tetgenio &from, tetgenio &to) noexcept {
    to.deinitialize();
    to = from;
    from.initialize();
}

}  // namespace detail

// Reads switches; NULL is "".
inline switches parse(const char *text) {
    const std::string given = text == nullptr ? "" : text;
    switches parsed;
    for (std::size_t i = 0; i < given.size();) {
        const char letter = given[i++];
        switch (letter) {
            case 'q':
                parsed.quality = true;
                if (const std::string digits = detail::number_at(given, i); !digits.empty()) {
                    parsed.ratio = detail::number(digits);
                }
                break;
            case 'n':
                if (parsed.neighbors) {
                    detail::refuse_switch("nn");
                }
                parsed.neighbors = true;
                break;
            case 'z': parsed.from_zero = true; break;
            case 'F': parsed.faces = false; break;
            case 'B': parsed.markers = false; break;
            case 'I': case 'Q': case 'V': break;
            case '-':
                if (i == 1) {
                    break;
                }
                [[fallthrough]];
            default: detail::refuse_switch(std::string(1, letter));
        }
    }
    return parsed;
}

// Reads TetGen's parsed switches, each of which must be understood. Parameters of
// TetGen's own work (-b, -l, -x, -X, -T, -M) are not looked at, nor is -p beside -q, which TetGen's
// parser sets itself.
inline switches parse(const tetgenbehavior &behavior) {
    const std::array<std::pair<bool, const char *>, 26> refused{{
        {behavior.plc != 0 && behavior.quality == 0, "p"},
        {behavior.quality != 0 && behavior.mindihedral > 0, "q/"},
        {behavior.neighout > 1, "nn"},        {behavior.order != 1, "o"},
        {behavior.steinerleft >= 0, "S"},     {behavior.psc != 0, "s"},
        {behavior.refine != 0, "r"},          {behavior.nobisect != 0, "Y"},
        {behavior.coarsen != 0, "R"},         {behavior.weighted != 0, "w"},
        {behavior.metric != 0, "m"},          {behavior.varvolume != 0, "a"},
        {behavior.fixedvolume != 0, "a"},     {behavior.regionattrib != 0, "A"},
        {behavior.insertaddpoints != 0, "i"}, {behavior.diagnose != 0, "d"},
        {behavior.convex != 0, "c"},          {behavior.facesout != 0, "f"},
        {behavior.edgesout != 0, "e"},        {behavior.voroout != 0, "v"},
        {behavior.nojettison != 0, "J"},      {behavior.docheck != 0, "C"},
        {behavior.nonodewritten != 0, "N"},   {behavior.noelewritten != 0, "E"},
        {behavior.meditview != 0, "g"},       {behavior.vtkview != 0, "k"},
    }};
    for (const auto &[given, name] : refused) {
        if (given) {
            detail::refuse_switch(name);
        }
    }
    switches parsed;
    parsed.quality = behavior.quality != 0;
    parsed.ratio = behavior.minratio;
    parsed.neighbors = behavior.neighout != 0;
    parsed.from_zero = behavior.zeroindex != 0;
    parsed.faces = behavior.nofacewritten == 0;
    parsed.markers = behavior.nobound == 0;
    return parsed;
}

// Makes a mesh of the points of in, which must hold nothing but points and their markers. Fails
// where mesh() does.
inline mesh make_mesh(const tetgenio &in) {
    if (in.mesh_dim != 3 || in.numberofpoints < 0) {
        detail::refuse("in.mesh_dim = " + std::to_string(in.mesh_dim) + ", in.numberofpoints = " +
                       std::to_string(in.numberofpoints) + ": points in 3D are meshed");
    }
    detail::refuse_unless_zero(in.numberofpointattributes, "in.numberofpointattributes");
    detail::refuse_unless_zero(in.numberofpointmtrs, "in.numberofpointmtrs");
    detail::refuse_unless_zero(in.numberoffacets, "in.numberoffacets");
    detail::refuse_unless_zero(in.numberoftetrahedra, "in.numberoftetrahedra");
    detail::refuse_unless_zero(in.numberoftrifaces, "in.numberoftrifaces");
    detail::refuse_unless_zero(in.numberofedges, "in.numberofedges");
    detail::refuse_unless_zero(in.numberofholes, "in.numberofholes");
    detail::refuse_unless_zero(in.numberofregions, "in.numberofregions");
    detail::refuse_unless_null(in.pointparamlist, "in.pointparamlist");
    return netmesh::make_mesh(strided_points<REAL>{
        in.pointlist, static_cast<std::size_t>(in.numberofpoints), 3, 3, 1});
}

// Replaces what out holds by a mesh in 3D that has been run. Errors: NM_STATE (no result yet),
// NM_DIMENSION, NM_CAPACITY (more than int holds); std::bad_alloc. O(vertices + simplices).
inline void fill(const mesh &mesh, tetgenio &out, const layout &wanted = {}) {
    const nm_counts counts = mesh.counts();
    if (counts.dim != 3) {
        throw error(NM_DIMENSION, "the mesh has dim = " + std::to_string(counts.dim) +
                                      ", tetgenio holds 3");
    }
    const table<std::uint32_t> simplices = mesh.simplices();
    const table<std::uint32_t> neighbors = mesh.neighbors();
    const std::uint64_t offset = wanted.first_number == 0 ? 0 : 1;
    if (wanted.first_number < 0 || wanted.first_number > 1) {
        detail::refuse("firstnumber = " + std::to_string(wanted.first_number) + " is neither 0 nor 1");
    }
    detail::to_int(counts.vertices + offset, "points");
    detail::to_int(counts.simplices * 4, "vertices of tetrahedra");
    tetgenio built;
    built.firstnumber = wanted.first_number;
    detail::copy_points(mesh, built);
    if (wanted.input_markers != nullptr) {
        detail::copy_markers(mesh, wanted.input_markers, built);
    }
    built.numberofcorners = 4;
    built.numberoftetrahedra = detail::to_int(simplices.size(), "tetrahedra");
    built.tetrahedronlist = detail::numbered(simplices, wanted.first_number);
    if (wanted.neighbors) {
        built.neighborlist = detail::numbered(neighbors, wanted.first_number);
    }
    if (wanted.faces) {
        detail::copy_hull(simplices, neighbors, wanted.first_number, built);
    }
    detail::move_lists(built, out);
}

// Does the work of tetrahedralize, for switches that are parsed.
inline void tetrahedralize(const switches &wanted, tetgenio *in, tetgenio *out,
                           tetgenio *addin = nullptr, tetgenio *bgmin = nullptr) {
    if (in == nullptr || out == nullptr) {
        throw error(NM_NULL_ARGUMENT, in == nullptr ? "in is NULL" : "out is NULL");
    }
    if (in == out) {
        detail::refuse("in and out are the same object");
    }
    detail::refuse_unless_null(addin, "addin");
    detail::refuse_unless_null(bgmin, "bgmin");
    mesh mesh = make_mesh(*in);
    options options;
    options.algorithm = wanted.quality ? NM_ALGORITHM_NETMESH : NM_ALGORITHM_DELAUNAY;
    if (wanted.quality) {
        options.output = NM_OUTPUT_WELL_SPACED;
        options.criterion = NM_CRITERION_RADIUS_EDGE;
        options.quality_bound = wanted.ratio;
    }
    mesh.run(options);
    layout layout;
    layout.first_number = wanted.from_zero ? 0 : in->firstnumber;
    layout.neighbors = wanted.neighbors;
    layout.faces = wanted.faces;
    layout.input_markers = wanted.markers ? in->pointmarkerlist : nullptr;
    fill(mesh, *out, layout);
}

// Meshes the points of in into out. Errors: those of make_mesh, mesh::run and fill.
inline void tetrahedralize(const char *text, tetgenio *in, tetgenio *out, tetgenio *addin = nullptr,
                           tetgenio *bgmin = nullptr) {
    tetrahedralize(parse(text), in, out, addin, bgmin);
}

inline void tetrahedralize(const tetgenbehavior *behavior, tetgenio *in, tetgenio *out,
                           tetgenio *addin = nullptr, tetgenio *bgmin = nullptr) {
    if (behavior == nullptr) {
        throw error(NM_NULL_ARGUMENT, "behavior is NULL");
    }
    tetrahedralize(parse(*behavior), in, out, addin, bgmin);
}

}  // namespace tetgen
}  // namespace netmesh

#endif  // NETMESH_TETGEN_HPP
