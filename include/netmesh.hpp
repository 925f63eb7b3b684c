// netmesh.hpp - netmesh for C++17 and later: meshes that free themselves, errors as exceptions or as
// values, arrays as ranges. Header-only, over netmesh.h, which is the manual for everything that is
// only named here: shapes, units, ranges, costs. License: MIT OR Apache-2.0.
//
//     std::vector<double> points = ...;                        // n x 3
//     netmesh::mesh mesh(3, points);
//     netmesh::options options;
//     options.quality_bound = 4;
//     mesh.run(options);
//     for (netmesh::span<const std::uint32_t> vertices : mesh.simplices()) { ... vertices[0] ... }
//     mesh.save("mesh.vtu");
//
// ERRORS. Each function that can fail is there twice. mesh(), run(), points() and so on throw
// netmesh::error, with status() and the library's sentence as what(). try_create(), try_run(),
// try_points() and so on answer a netmesh::result, which has a value, or status() and message():
//
//     netmesh::result<netmesh::mesh> mesh = netmesh::mesh::try_create(3, points);
//     if (!mesh) return report(mesh.status(), mesh.message());
//     if (netmesh::result<void> done = mesh->try_run(); !done) ...
//
// After either failure the mesh is as it was before the call. Without exceptions (-fno-exceptions)
// there are only the latter; a vector that finds no memory then ends the program, as C++ has it, and
// whoever cannot bear that gives buffers of their own to the C interface through get().
//
// CALLBACKS may be anything callable. What they throw stops the call, crosses the library safely and
// leaves the function that was called, try_ or not.
//
// THREADS. Const member functions of one mesh may run at the same time in several threads; run()
// needs the mesh for itself and fails with NM_STATE where it does not have it.
//
// ALPHA SHAPES: netmesh/alpha_shape.hpp.
//
// ADAPTERS. Points from other layouts: netmesh/strided.hpp. CGAL, TetGen and Eigen: netmesh/cgal.hpp,
// netmesh/tetgen.hpp, netmesh/eigen.hpp.

#ifndef NETMESH_HPP
#define NETMESH_HPP

#include <cstddef>
#include <cstdint>
#include <ostream>
#include <string>
#include <utility>
#include <vector>

#include "netmesh.h"
#include "netmesh/callbacks.hpp"
#include "netmesh/fetch.hpp"
#include "netmesh/getters.hpp"
#include "netmesh/options.hpp"
#include "netmesh/result.hpp"
#include "netmesh/table.hpp"

namespace netmesh {

// Returns the version of the library that is linked, "major.minor.patch".
inline std::string version() { return nm_version(); }

// Points, and after run() their mesh. A mesh moves and does not copy; with a moved-from mesh
// everything but assignment and destruction fails with NM_NULL_ARGUMENT.
class mesh : detail::getters {
public:
    // Takes over a handle of the C interface, and frees it at the end.
    explicit mesh(nm_mesh *handle) noexcept : getters(handle) {}

    mesh(mesh &&other) noexcept : getters(other.release()) {}

    mesh &operator=(mesh &&other) noexcept {
        nm_mesh *taken = other.release();
        nm_mesh_free(handle_);
        handle_ = taken;
        return *this;
    }

    mesh(const mesh &) = delete;
    mesh &operator=(const mesh &) = delete;

    ~mesh() { nm_mesh_free(handle_); }

    // Returns the handle for the C interface; it stays this object's.
    nm_mesh *get() noexcept { return handle_; }
    const nm_mesh *get() const noexcept { return handle_; }

    // Gives the handle away; it is the caller's to free from now on.
    nm_mesh *release() noexcept { return std::exchange(handle_, nullptr); }

    // Copies n points: coordinate k of point i is points[i * stride + k]; stride 0 means dim.
    static result<mesh> try_create(std::uint32_t dim, const double *points, std::size_t n,
                                   std::size_t stride = 0) {
        nm_mesh *handle = nullptr;
        nm_status status = nm_mesh_create(dim, n, points, stride, &handle);
        return made(status, handle);
    }

    // Copies points, dim coordinates each, one point after the other.
    static result<mesh> try_create(std::uint32_t dim, span<const double> points) {
        if (dim != 0 && points.size() % dim != 0) {
            return failure{NM_INVALID_ARGUMENT, "points holds " + std::to_string(points.size()) +
                                                    " coordinates, not a multiple of dim = " +
                                                    std::to_string(dim)};
        }
        return try_create(dim, points.data(), dim == 0 ? 0 : points.size() / dim);
    }

    // Reads the points of a file, and the segments and regions that it has; the path is UTF-8.
    static result<mesh> try_from_file(const std::string &path_utf8,
                                      nm_format format = NM_FORMAT_AUTO) {
        nm_mesh *handle = nullptr;
        nm_status status = nm_mesh_create_from_file(path_utf8.c_str(), format, &handle);
        return made(status, handle);
    }

    // Reads the points of a file from chosen columns, and further columns as attributes of the
    // points, chosen as by nm_mesh_create_from_columns; an empty choice is the format's own, or
    // none.
    static result<mesh> try_from_columns(const std::string &path_utf8, const std::string &columns,
                                         const std::string &attributes,
                                         nm_format format = NM_FORMAT_AUTO) {
        nm_mesh *handle = nullptr;
        nm_status status = nm_mesh_create_from_columns(
            path_utf8.c_str(), format, columns.empty() ? nullptr : columns.c_str(),
            attributes.empty() ? nullptr : attributes.c_str(), &handle);
        return made(status, handle);
    }

    // Meshes the points. A second run replaces the first one's result.
    result<void> try_run(const options &wanted = {}) {
        detail::progress_call call{wanted.progress, nullptr};
        nm_options values = NM_OPTIONS_INIT;
        detail::copy(wanted, values);
        values.progress = wanted.progress ? &detail::progress_call::invoke : nullptr;
        values.user_data = &call;
        detail::size_call asked{wanted.size, nullptr};
        values.size = wanted.size ? &detail::size_call::invoke : nullptr;
        values.size_user_data = &asked;
        nm_status status = nm_run(handle_, &values);
        return detail::finished(status, call.thrown ? call.thrown : asked.thrown);
    }

    // Returns the options that the last run had, with every default filled in, NM_OUTPUT_AUTO and
    // NM_EXTENT_AUTO among them. Functions are empty.
    result<options> try_options_of_run() const {
        result<nm_options> found = filled<nm_options>(nm_mesh_options);
        if (!found) {
            return failure{found.status(), found.message()};
        }
        options values;
        detail::copy(*found, values);
        return values;
    }

    result<nm_counts> try_counts() const { return filled<nm_counts>(nm_mesh_counts); }

    // Counts the edges, faces and cells that the points' file has and that were left out.
    result<nm_left_out> try_left_out() const { return filled<nm_left_out>(nm_mesh_left_out); }

    // Returns vertices x dim coordinates; the distinct inputs come first.
    result<table<double>> try_points() const { return rows<double>(nm_mesh_get_points, 0); }

    // Returns simplices x (dim + 1) vertex ids, positively oriented.
    result<table<std::uint32_t>> try_simplices() const {
        return rows<std::uint32_t>(nm_mesh_get_simplices, 1);
    }

    // Returns simplices x (dim + 1) simplex ids, the i-th opposite vertex i; NM_NONE on the hull.
    result<table<std::uint32_t>> try_neighbors() const {
        return rows<std::uint32_t>(nm_mesh_get_neighbors, 1);
    }

    // Returns an nm_vertex_kind per vertex.
    result<std::vector<std::uint8_t>> try_vertex_kinds() const {
        return array<std::uint8_t>(nm_mesh_get_vertex_kinds);
    }

    // Returns the innermost domain of each vertex; NM_NONE where there are no domains.
    result<std::vector<std::uint32_t>> try_vertex_domains() const {
        return array<std::uint32_t>(nm_mesh_get_vertex_domains);
    }

    // Returns 1 for each vertex whose cell doubles are too coarse for, 0 for the others.
    result<std::vector<std::uint8_t>> try_precision_limited() const {
        return array<std::uint8_t>(nm_mesh_get_precision_limited);
    }

    // Returns the vertex of each input; equal inputs share one.
    result<std::vector<std::uint32_t>> try_input_vertices() const {
        return array<std::uint32_t>(nm_mesh_get_input_vertices);
    }

    // Returns the input that each vertex is, by its number among the caller's points and of equal
    // ones the first; NM_NONE for vertices that are no inputs.
    result<std::vector<std::uint32_t>> try_vertex_inputs() const {
        return array<std::uint32_t>(nm_mesh_get_vertex_inputs);
    }

    // Returns the tree of domains, the root first, every parent before its children.
    result<std::vector<nm_domain>> try_domains() const {
        return array<nm_domain>(nm_mesh_get_domains);
    }

    // Returns the ids of a selection's simplices; arrays of the selection with a row for each
    // simplex are in this order. Arrays of a selection are not stored, and have the ids of the
    // whole mesh.
    result<std::vector<std::uint32_t>> try_selected(const selection &wanted = {}) const {
        return array<std::uint32_t>(nm_mesh_get_selected, wanted);
    }

    // Returns edges x 2 vertex ids, the lesser first.
    result<table<std::uint32_t>> try_edges(const selection &wanted = {}) const {
        return detail::in_rows(array<std::uint32_t>(nm_mesh_get_edges, wanted), 2);
    }

    // Returns facets and the two simplices of each; NM_NONE in place of the second on the hull.
    result<facet_tables> try_facets(const selection &wanted = {}) const {
        return facets_of(nm_mesh_get_facets, nm_mesh_get_facet_simplices, wanted, 2);
    }

    // Returns the facets on the hull, oriented outwards, and the simplex of each.
    result<facet_tables> try_hull(const selection &wanted = {}) const {
        return facets_of(nm_mesh_get_hull, nm_mesh_get_hull_simplices, wanted, 1);
    }

    // Lists for each vertex the simplices that have it.
    result<lists<std::uint32_t>> try_vertex_simplices(const selection &wanted = {}) const {
        return lists_of(nm_mesh_get_vertex_simplices, nm_mesh_get_vertex_simplex_starts, wanted);
    }

    // Lists for each vertex those that share an edge with it.
    result<lists<std::uint32_t>> try_vertex_neighbors(const selection &wanted = {}) const {
        return lists_of(nm_mesh_get_vertex_neighbors, nm_mesh_get_vertex_neighbor_starts, wanted);
    }

    // Returns the centres of the circumscribed balls, simplices x dim coordinates.
    result<table<double>> try_circumcenters(const selection &wanted = {}) const {
        return points_of<double>(nm_mesh_get_circumcenters, wanted);
    }

    // Returns the radii of the circumscribed balls.
    result<std::vector<double>> try_circumradii(const selection &wanted = {}) const {
        return array<double>(nm_mesh_get_circumradii, wanted);
    }

    // Returns the volumes of simplices, in 2D their areas.
    result<std::vector<double>> try_volumes(const selection &wanted = {}) const {
        return array<double>(nm_mesh_get_volumes, wanted);
    }

    // Lists for each vertex the simplices whose circumcentres are the corners of its Voronoi cell.
    result<lists<std::uint32_t>> try_regions(const selection &wanted = {}) const {
        return lists_of(nm_mesh_get_regions, nm_mesh_get_region_starts, wanted);
    }

    // Returns the volumes of Voronoi cells, infinite where a cell is unbounded.
    result<std::vector<double>> try_region_volumes(const selection &wanted = {}) const {
        return array<double>(nm_mesh_get_region_volumes, wanted);
    }

    // Returns the share of each Voronoi cell in the volume of the mesh.
    result<std::vector<double>> try_region_shares(const selection &wanted = {}) const {
        return array<double>(nm_mesh_get_region_shares, wanted);
    }

    // Lists for each edge the simplices whose circumcentres are the corners of the ridge between
    // its two Voronoi cells.
    result<lists<std::uint32_t>> try_ridge_corners(const selection &wanted = {}) const {
        return lists_of(nm_mesh_get_ridge_corners, nm_mesh_get_ridge_starts, wanted);
    }

    // Returns 1 for each ridge that is bounded, 0 for the others.
    result<std::vector<std::uint8_t>> try_ridge_bounded(const selection &wanted = {}) const {
        return array<std::uint8_t>(nm_mesh_get_ridge_bounded, wanted);
    }

    // Returns the faces of dimension k, each once: faces x (k + 1) vertex ids, not inputs.
    result<table<std::uint32_t>> try_faces(std::uint32_t k) const {
        return of_faces(nm_mesh_get_faces, k);
    }

    // Returns the boundary of the faces of dimension k: faces x (k + 1) faces of dimension k - 1.
    result<table<std::uint32_t>> try_face_facets(std::uint32_t k) const {
        return of_faces(nm_mesh_get_face_facets, k);
    }

    // Lists for each face of dimension k those of dimension k + 1 that have it as a facet.
    result<lists<std::uint32_t>> try_cofaces(std::uint32_t k) const {
        return lists_of(nm_mesh_get_cofaces, nm_mesh_get_coface_starts, k);
    }

    // Makes a filtration on some threads, which the first call that needs it does otherwise.
    result<void> try_make_filtration(nm_filtration filtration, std::uint32_t threads) const {
        nm_status status = nm_mesh_make_filtration(handle_, filtration, threads);
        return status == NM_OK ? result<void>() : detail::failed(status);
    }

    // Returns the values of the faces of dimension k.
    result<std::vector<double>> try_filtration(nm_filtration filtration, std::uint32_t k) const {
        return detail::fetched<double>(
            [this, filtration, k](double *buf, std::uint64_t capacity, std::uint64_t *needed) {
                return nm_mesh_filtration(handle_, filtration, k, buf, capacity, needed);
            });
    }

    // Writes a filtration to a file that ends with .filtration or .dipha. Its numbers are those of
    // inputs for NM_FILTRATION_ALPHA, of vertices for NM_FILTRATION_MESH.
    result<void> try_save_filtration(const std::string &path_utf8,
                                     nm_filtration filtration) const {
        nm_status status = nm_export_filtration(handle_, filtration, path_utf8.c_str());
        return status == NM_OK ? result<void>() : detail::failed(status);
    }

    // Returns the factor between a filtration and that of the balls round the inputs.
    result<double> try_filtration_factor(nm_filtration filtration) const {
        double factor = 0;
        nm_status status = nm_mesh_filtration_factor(handle_, filtration, &factor);
        return status == NM_OK ? result<double>(factor) : detail::failed(status);
    }

    // Returns an nm_placement per simplex.
    result<std::vector<std::uint8_t>> try_placements(nm_extent extent) const {
        return detail::fetched<std::uint8_t>(
            [this, extent](std::uint8_t *buf, std::uint64_t capacity, std::uint64_t *needed) {
                return nm_mesh_get_placements(handle_, extent, buf, capacity, needed);
            });
    }

    // Makes the index that queries need, which the first of them does otherwise; tells its bytes.
    result<std::uint64_t> try_index() const {
        std::uint64_t bytes = 0;
        nm_status status = nm_mesh_index(handle_, &bytes);
        return status == NM_OK ? result<std::uint64_t>(bytes) : detail::failed(status);
    }

    // Finds the simplex that holds each of the points, dim coordinates each; NM_NONE outside.
    result<std::vector<std::uint32_t>> try_locate(span<const double> points,
                                                  std::uint32_t threads = 1) const {
        result<std::size_t> count = count_of(points);
        if (!count) {
            return failure{count.status(), count.message()};
        }
        return detail::allocating("the ids", [&]() -> result<std::vector<std::uint32_t>> {
            std::vector<std::uint32_t> found(*count);
            nm_status status =
                nm_mesh_locate(handle_, *count, points.data(), threads, found.data());
            if (status != NM_OK) {
                return detail::failed(status);
            }
            return found;
        });
    }

    // Finds the vertex nearest to each of the points, and its distance.
    result<nearest_vertices> try_nearest(span<const double> points,
                                         std::uint32_t threads = 1) const {
        return nearest_by<nearest_vertices>(nm_mesh_nearest, points, threads);
    }

    // Finds the input nearest to each of the points, by its number among the caller's points and of
    // equal ones the first, and its distance.
    result<nearest_inputs> try_nearest_input(span<const double> points,
                                             std::uint32_t threads = 1) const {
        return nearest_by<nearest_inputs>(nm_mesh_nearest_input, points, threads);
    }

    // Interpolates values at the points, components each, from those at the vertices.
    result<table<double>> try_interpolate(nm_interpolation interpolation, std::uint32_t components,
                                          span<const double> values, span<const double> points,
                                          std::uint32_t threads = 1) const {
        result<std::size_t> count = count_of(points);
        if (!count) {
            return failure{count.status(), count.message()};
        }
        result<nm_counts> counted = try_counts();
        if (!counted) {
            return failure{counted.status(), counted.message()};
        }
        if (components == 0 || values.size() != counted->vertices * components) {
            return wrong_size("values", values.size(), "vertices x components",
                              counted->vertices * components);
        }
        return detail::allocating("the values", [&]() -> result<table<double>> {
            std::vector<double> out(*count * components);
            nm_status status =
                nm_mesh_interpolate(handle_, interpolation, components, values.data(), *count,
                                    points.data(), threads, out.data());
            if (status != NM_OK) {
                return detail::failed(status);
            }
            return table<double>(std::move(out), components);
        });
    }

    // Gives the inputs values under a name, components each, which files get at all vertices: as by
    // extend_values() where extended, else NaN at vertices that are no inputs. Empty values remove.
    result<void> try_set_attributes(const std::string &name, std::uint32_t components,
                                    span<const double> values, bool extended = true) {
        result<nm_counts> counted = try_counts();
        if (!counted) {
            return failure{counted.status(), counted.message()};
        }
        if (values.size() != counted->inputs * components && !values.empty()) {
            return wrong_size("values", values.size(), "inputs x components",
                              counted->inputs * components);
        }
        auto set = extended ? nm_mesh_set_attributes : nm_mesh_set_input_attributes;
        return detail::outcome(
            set(handle_, name.c_str(), values.empty() ? 0 : components, values.data()));
    }

    // Gives the inputs sizes for the runs that follow, one each; none removes them.
    result<void> try_set_sizes(span<const double> values) {
        return detail::outcome(nm_mesh_set_sizes(handle_, values.size(), values.data()));
    }

    // Gives sizes by those at the vertices of another mesh, or of this one's last result, for the
    // runs that follow.
    result<void> try_set_background(const mesh &background, span<const double> values) {
        return detail::outcome(nm_mesh_set_background(handle_, background.handle_, values.size(),
                                                      values.data()));
    }

    // Returns the size that the last run asked for at each vertex, infinite for none; the result is
    // empty if nothing told sizes.
    result<std::vector<double>> try_sizes() const { return array<double>(nm_mesh_get_sizes); }

    result<void> try_remove_background() {
        return detail::outcome(nm_mesh_set_background(handle_, nullptr, 0, nullptr));
    }

    // Returns the values of a name at all vertices, which files get: vertices x components.
    result<std::vector<double>> try_attributes(const std::string &name) const {
        return detail::fetched<double>(
            [this, &name](double *buf, std::uint64_t capacity, std::uint64_t *needed) {
                return nm_mesh_get_attributes(handle_, name.c_str(), buf, capacity, needed);
            });
    }

    // Sets the segments that run() keeps as chains of edges, in 2D and 3D: two numbers of inputs
    // each, and a number of the caller's for each or none. They replace those before.
    result<void> try_set_segments(span<const std::uint32_t> inputs,
                                  span<const std::int32_t> markers = {}) {
        const std::size_t count = inputs.size() / 2;
        if (inputs.size() % 2 != 0 || (!markers.empty() && markers.size() != count)) {
            return wrong_size("inputs and markers", inputs.size(), "two and one a segment", 2 * count);
        }
        return detail::outcome(nm_mesh_set_segments(handle_, count, inputs.data(),
                                                    markers.empty() ? nullptr : markers.data()));
    }

    // Sets the facets that run() keeps as triangles, in 3D: facet i has the loops loop_starts[i] to
    // loop_starts[i + 1], and loop j the inputs from input_starts[j] to input_starts[j + 1]. They
    // replace those before, and triangles. None at all: empty spans.
    result<void> try_set_facets(span<const std::uint64_t> loop_starts,
                                span<const std::uint64_t> input_starts,
                                span<const std::uint32_t> inputs,
                                span<const std::int32_t> markers = {}) {
        const std::size_t count = loop_starts.empty() ? 0 : loop_starts.size() - 1;
        if (!markers.empty() && markers.size() != count) {
            return wrong_size("markers", markers.size(), "one a facet", count);
        }
        const std::uint64_t loops = count == 0 ? 0 : loop_starts.back();
        if (input_starts.size() != (count == 0 ? input_starts.size() : loops + 1)) {
            return wrong_size("input_starts", input_starts.size(), "one more than loops", loops + 1);
        }
        const std::uint64_t length = loops == 0 || count == 0 ? 0 : input_starts.back();
        if (inputs.size() != length) {
            return wrong_size("inputs", inputs.size(), "the last of input_starts", length);
        }
        return detail::outcome(nm_mesh_set_facets(handle_, count, loop_starts.data(),
                                                  input_starts.data(), inputs.data(),
                                                  markers.empty() ? nullptr : markers.data()));
    }

    // Sets facets that are polygons without holes: the numbers of inputs round each.
    result<void> try_set_facets(const std::vector<std::vector<std::uint32_t>> &polygons,
                                span<const std::int32_t> markers = {}) {
        return detail::allocating("the facets", [&]() -> result<void> {
            std::vector<std::uint64_t> loops = {0}, starts = {0};
            std::vector<std::uint32_t> inputs;
            for (const std::vector<std::uint32_t> &polygon : polygons) {
                inputs.insert(inputs.end(), polygon.begin(), polygon.end());
                loops.push_back(loops.size());
                starts.push_back(inputs.size());
            }
            return try_set_facets(loops, starts, inputs, markers);
        });
    }

    // Sets the triangles of a surface that run() keeps, in 3D: three numbers of inputs each, and a
    // number of the caller's for each or none. They replace those before, and facets.
    result<void> try_set_triangles(span<const std::uint32_t> inputs,
                                   span<const std::int32_t> markers = {}) {
        const std::size_t count = inputs.size() / 3;
        if (inputs.size() % 3 != 0 || (!markers.empty() && markers.size() != count)) {
            return wrong_size("inputs and markers", inputs.size(), "three and one a triangle",
                              3 * count);
        }
        return detail::outcome(nm_mesh_set_triangles(handle_, count, inputs.data(),
                                                     markers.empty() ? nullptr : markers.data()));
    }

    // Returns all pairs of facets and segments in 3D that meet in more than they share.
    result<std::vector<nm_intersection>> try_intersections() const {
        return detail::fetched<nm_intersection>(
            [this](nm_intersection *buf, std::uint64_t capacity, std::uint64_t *needed) {
                if (buf != nullptr) {
                    buf->struct_size = sizeof *buf;
                }
                return nm_mesh_get_intersections(handle_, buf, capacity, needed);
            });
    }

    // Sets the regions between segments in 2D or facets in 3D; each is NM_REGION_INIT before its
    // fields are set. They replace those before.
    result<void> try_set_regions(span<const nm_region> regions) {
        return detail::outcome(nm_mesh_set_regions(handle_, regions.size(), regions.data()));
    }

    // Returns the edges that segments have become: two vertices each.
    result<table<std::uint32_t>> try_segments() const {
        result<std::vector<std::uint32_t>> ends = array<std::uint32_t>(nm_mesh_get_segments);
        if (!ends) {
            return failure{ends.status(), ends.message()};
        }
        return table<std::uint32_t>(std::move(*ends), 2);
    }

    // Returns the segment that each edge of segments() is a part of.
    result<std::vector<std::uint32_t>> try_segment_parents() const {
        return array<std::uint32_t>(nm_mesh_get_segment_parents);
    }

    // Returns the triangles that facets have become: three vertices each, counterclockwise where
    // the facet's normal points to.
    result<table<std::uint32_t>> try_facet_triangles() const {
        return detail::in_rows(array<std::uint32_t>(nm_mesh_get_facet_triangles), 3);
    }

    // Returns the facet that each of facet_triangles() is a part of.
    result<std::vector<std::uint32_t>> try_facet_parents() const {
        return array<std::uint32_t>(nm_mesh_get_facet_parents);
    }

    // Returns the simplices before and behind each of facet_triangles(); NM_NONE where the domain
    // ends.
    result<table<std::uint32_t>> try_facet_simplices() const {
        return detail::in_rows(array<std::uint32_t>(nm_mesh_get_facet_triangle_simplices), 2);
    }

    // Returns the label of each simplex's region; the result is empty without segments and facets.
    result<std::vector<std::int32_t>> try_simplex_regions() const {
        return array<std::int32_t>(nm_mesh_get_simplex_regions);
    }

    // Extends values at the inputs, components each, to all vertices.
    result<table<double>> try_extend_values(std::uint32_t components,
                                            span<const double> input_values) const {
        result<nm_counts> counted = try_counts();
        if (!counted) {
            return failure{counted.status(), counted.message()};
        }
        if (components == 0 || input_values.size() != counted->inputs * components) {
            return wrong_size("input_values", input_values.size(), "inputs x components",
                              counted->inputs * components);
        }
        return detail::allocating("the values", [&]() -> result<table<double>> {
            std::vector<double> out(static_cast<std::size_t>(counted->vertices) * components);
            nm_status status =
                nm_mesh_extend_values(handle_, components, input_values.data(), out.data());
            if (status != NM_OK) {
                return detail::failed(status);
            }
            return table<double>(std::move(out), components);
        });
    }

    result<nm_quality> try_quality() const { return filled<nm_quality>(nm_mesh_quality); }

    // Counts the values of a measure between edges, which ascend. Simplices at the hull count too
    // where at_hull.
    result<histogram> try_quality_histogram(nm_measure measure, span<const double> edges,
                                            bool at_hull = false) const {
        return detail::allocating("the counts", [&]() -> result<histogram> {
            histogram found;
            found.counts.resize(edges.size() + 1);
            double extremes[2] = {};
            nm_status status =
                nm_mesh_quality_histogram(handle_, measure, at_hull ? 1 : 0, edges.size(),
                                          edges.data(), found.counts.data(), extremes);
            if (status != NM_OK) {
                return detail::failed(status);
            }
            found.least = extremes[0];
            found.largest = extremes[1];
            return found;
        });
    }

    result<nm_stats> try_stats() const { return filled<nm_stats>(nm_mesh_stats); }

    // Checks the mesh independently of the code that built it: 1 topology, 2 geometry, 3 the
    // promises. The report says what was found; a broken mesh is not a failure of the call.
    result<nm_report> try_validate(std::uint32_t level = 3) const {
        nm_report report = detail::sized<nm_report>();
        nm_status status = nm_mesh_validate(handle_, level, &report);
        return status == NM_OK ? result<nm_report>(report) : detail::failed(status);
    }

    // Writes a file; the path is UTF-8.
    result<void> try_save(const std::string &path_utf8, nm_format format = NM_FORMAT_AUTO) const {
        return detail::outcome(nm_export(handle_, path_utf8.c_str(), format));
    }

    // Writes a file of a selection; the path is UTF-8.
    result<void> try_save(const std::string &path_utf8, const selection &wanted,
                          nm_format format = NM_FORMAT_AUTO) const {
        nm_selection which = detail::raw(wanted);
        return detail::outcome(nm_export_selected(handle_, &which, path_utf8.c_str(), format));
    }

    // Writes to a function, piece by piece.
    result<void> try_write(nm_format format, const write_function &sink) const {
        detail::write_call call{sink, nullptr};
        nm_write_fn invoke = sink ? &detail::write_call::invoke : nullptr;
        nm_status status = nm_export_write(handle_, format, invoke, &call);
        return detail::finished(status, call.thrown);
    }

    // Writes to a stream, which must be binary; NM_IO where the stream fails.
    result<void> try_write(nm_format format, std::ostream &stream) const {
        return try_write(format, [&stream](const char *data, std::size_t size) {
            return stream.write(data, static_cast<std::streamsize>(size)).good();
        });
    }

    // Returns the bytes that a file would hold; for NM_FORMAT_TETGEN_NODE the .node part, then the
    // .ele part.
    result<std::string> try_to_string(nm_format format) const {
        return detail::allocating("the text", [&]() -> result<std::string> {
            std::string text;
            result<void> written = try_write(format, [&text](const char *data, std::size_t size) {
                text.append(data, size);
                return true;
            });
            if (!written) {
                return failure{written.status(), written.message()};
            }
            return text;
        });
    }

#if NETMESH_EXCEPTIONS
    // Each function below does what the try_ function of its name does, and throws netmesh::error.
    mesh(std::uint32_t dim, const double *points, std::size_t n, std::size_t stride = 0)
        : mesh(try_create(dim, points, n, stride).value()) {}
    mesh(std::uint32_t dim, span<const double> points) : mesh(try_create(dim, points).value()) {}
    static mesh from_file(const std::string &path_utf8, nm_format format = NM_FORMAT_AUTO) {
        return try_from_file(path_utf8, format).value();
    }
    static mesh from_columns(const std::string &path_utf8, const std::string &columns,
                             const std::string &attributes, nm_format format = NM_FORMAT_AUTO) {
        return try_from_columns(path_utf8, columns, attributes, format).value();
    }
    void run(const options &wanted = {}) { try_run(wanted).value(); }
    options options_of_run() const { return try_options_of_run().value(); }
    nm_counts counts() const { return try_counts().value(); }
    nm_left_out left_out() const { return try_left_out().value(); }
    std::uint32_t dim() const { return counts().dim; }
    table<double> points() const { return try_points().value(); }
    table<std::uint32_t> simplices() const { return try_simplices().value(); }
    table<std::uint32_t> neighbors() const { return try_neighbors().value(); }
    std::vector<std::uint8_t> vertex_kinds() const { return try_vertex_kinds().value(); }
    std::vector<std::uint32_t> vertex_domains() const { return try_vertex_domains().value(); }
    std::vector<std::uint8_t> precision_limited() const { return try_precision_limited().value(); }
    std::vector<std::uint32_t> input_vertices() const { return try_input_vertices().value(); }
    std::vector<std::uint32_t> vertex_inputs() const { return try_vertex_inputs().value(); }
    std::vector<nm_domain> domains() const { return try_domains().value(); }
    std::vector<std::uint32_t> selected(const selection &wanted = {}) const {
        return try_selected(wanted).value();
    }
    table<std::uint32_t> edges(const selection &wanted = {}) const {
        return try_edges(wanted).value();
    }
    facet_tables facets(const selection &wanted = {}) const { return try_facets(wanted).value(); }
    facet_tables hull(const selection &wanted = {}) const { return try_hull(wanted).value(); }
    lists<std::uint32_t> vertex_simplices(const selection &wanted = {}) const {
        return try_vertex_simplices(wanted).value();
    }
    lists<std::uint32_t> vertex_neighbors(const selection &wanted = {}) const {
        return try_vertex_neighbors(wanted).value();
    }
    table<double> circumcenters(const selection &wanted = {}) const {
        return try_circumcenters(wanted).value();
    }
    std::vector<double> circumradii(const selection &wanted = {}) const {
        return try_circumradii(wanted).value();
    }
    std::vector<double> volumes(const selection &wanted = {}) const {
        return try_volumes(wanted).value();
    }
    lists<std::uint32_t> regions(const selection &wanted = {}) const {
        return try_regions(wanted).value();
    }
    std::vector<double> region_volumes(const selection &wanted = {}) const {
        return try_region_volumes(wanted).value();
    }
    std::vector<double> region_shares(const selection &wanted = {}) const {
        return try_region_shares(wanted).value();
    }
    lists<std::uint32_t> ridge_corners(const selection &wanted = {}) const {
        return try_ridge_corners(wanted).value();
    }
    std::vector<std::uint8_t> ridge_bounded(const selection &wanted = {}) const {
        return try_ridge_bounded(wanted).value();
    }
    table<std::uint32_t> faces(std::uint32_t k) const { return try_faces(k).value(); }
    table<std::uint32_t> face_facets(std::uint32_t k) const { return try_face_facets(k).value(); }
    lists<std::uint32_t> cofaces(std::uint32_t k) const { return try_cofaces(k).value(); }
    void make_filtration(nm_filtration filtration, std::uint32_t threads) const {
        try_make_filtration(filtration, threads).value();
    }
    std::vector<double> filtration(nm_filtration filtration, std::uint32_t k) const {
        return try_filtration(filtration, k).value();
    }
    void save_filtration(const std::string &path_utf8, nm_filtration filtration) const {
        try_save_filtration(path_utf8, filtration).value();
    }
    double filtration_factor(nm_filtration filtration) const {
        return try_filtration_factor(filtration).value();
    }
    std::vector<std::uint8_t> placements(nm_extent extent) const {
        return try_placements(extent).value();
    }
    std::uint64_t index() const { return try_index().value(); }
    std::vector<std::uint32_t> locate(span<const double> points, std::uint32_t threads = 1) const {
        return try_locate(points, threads).value();
    }
    nearest_vertices nearest(span<const double> points, std::uint32_t threads = 1) const {
        return try_nearest(points, threads).value();
    }
    nearest_inputs nearest_input(span<const double> points, std::uint32_t threads = 1) const {
        return try_nearest_input(points, threads).value();
    }
    table<double> interpolate(nm_interpolation interpolation, std::uint32_t components,
                              span<const double> values, span<const double> points,
                              std::uint32_t threads = 1) const {
        return try_interpolate(interpolation, components, values, points, threads).value();
    }
    table<double> extend_values(std::uint32_t components, span<const double> input_values) const {
        return try_extend_values(components, input_values).value();
    }
    void set_attributes(const std::string &name, std::uint32_t components,
                        span<const double> values, bool extended = true) {
        try_set_attributes(name, components, values, extended).value();
    }
    void set_sizes(span<const double> values) { try_set_sizes(values).value(); }
    void set_background(const mesh &background, span<const double> values) {
        try_set_background(background, values).value();
    }
    void remove_background() { try_remove_background().value(); }
    std::vector<double> sizes() const { return try_sizes().value(); }
    std::vector<double> attributes(const std::string &name) const {
        return try_attributes(name).value();
    }
    void set_segments(span<const std::uint32_t> inputs, span<const std::int32_t> markers = {}) {
        try_set_segments(inputs, markers).value();
    }
    void set_facets(span<const std::uint64_t> loop_starts, span<const std::uint64_t> input_starts,
                    span<const std::uint32_t> inputs, span<const std::int32_t> markers = {}) {
        try_set_facets(loop_starts, input_starts, inputs, markers).value();
    }
    void set_facets(const std::vector<std::vector<std::uint32_t>> &polygons,
                    span<const std::int32_t> markers = {}) {
        try_set_facets(polygons, markers).value();
    }
    void set_triangles(span<const std::uint32_t> inputs, span<const std::int32_t> markers = {}) {
        try_set_triangles(inputs, markers).value();
    }
    void set_regions(span<const nm_region> regions) { try_set_regions(regions).value(); }
    table<std::uint32_t> segments() const { return try_segments().value(); }
    std::vector<std::uint32_t> segment_parents() const { return try_segment_parents().value(); }
    table<std::uint32_t> facet_triangles() const { return try_facet_triangles().value(); }
    std::vector<std::uint32_t> facet_parents() const { return try_facet_parents().value(); }
    table<std::uint32_t> facet_simplices() const { return try_facet_simplices().value(); }
    std::vector<nm_intersection> intersections() const { return try_intersections().value(); }
    std::vector<std::int32_t> simplex_regions() const { return try_simplex_regions().value(); }
    nm_quality quality() const { return try_quality().value(); }
    histogram quality_histogram(nm_measure measure, span<const double> edges,
                                bool at_hull = false) const {
        return try_quality_histogram(measure, edges, at_hull).value();
    }
    nm_stats stats() const { return try_stats().value(); }
    nm_report validate(std::uint32_t level = 3) const { return try_validate(level).value(); }
    void save(const std::string &path_utf8, nm_format format = NM_FORMAT_AUTO) const {
        try_save(path_utf8, format).value();
    }
    void save(const std::string &path_utf8, const selection &wanted,
              nm_format format = NM_FORMAT_AUTO) const {
        try_save(path_utf8, wanted, format).value();
    }
    void write(nm_format format, const write_function &sink) const {
        try_write(format, sink).value();
    }
    void write(nm_format format, std::ostream &stream) const { try_write(format, stream).value(); }
    std::string to_string(nm_format format) const { return try_to_string(format).value(); }
#endif

private:
    static result<mesh> made(nm_status status, nm_mesh *handle) noexcept {
        return status == NM_OK ? result<mesh>(mesh(handle)) : detail::failed(status);
    }
};

}  // namespace netmesh

#endif  // NETMESH_HPP
