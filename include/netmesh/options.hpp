// netmesh/options.hpp - options of a run and selections of simplices, for netmesh.hpp. Included by it.
// License: MIT OR Apache-2.0.

#ifndef NETMESH_OPTIONS_HPP
#define NETMESH_OPTIONS_HPP

#include <cstddef>
#include <cstdint>
#include <functional>

#include "../netmesh.h"

namespace netmesh {

// Sees a run's progress on the thread that called run(), about every 30 ms and where a round or a
// stage ends; false cancels the run, which then fails with NM_CANCELLED.
using progress_function = std::function<bool(const nm_progress &)>;

// The size that is asked for at a point: x has dim doubles. Called on the thread that called run().
using size_function = std::function<double(const double *x)>;

// Receives an export piece by piece; false stops it, and it fails with NM_IO.
using write_function = std::function<bool(const char *data, std::size_t size)>;

// Options of a run: the fields of nm_options in its groups, 0 the default for the dimension.
struct options {
    // Quality.
    nm_criterion criterion = NM_CRITERION_VORONOI_ASPECT;
    double quality_bound = 0;
    double min_angle = 0;  // 2D only, in place of criterion and quality_bound
    double min_dihedral = 0;
    nm_gives_way gives_way = NM_GIVES_WAY_ANGLE;  // to min_dihedral, or to quality_bound
    // Domain.
    nm_extent extent = NM_EXTENT_AUTO;
    nm_interior interior = NM_INTERIOR_AUTO;  // with NM_EXTENT_BOUNDARY and NM_EXTENT_AUTO
    nm_crossings crossings = NM_CROSSINGS_REFUSE;
    double coplanar = 0;  // 3D only
    nm_labels labels = NM_LABELS_SEEDS;
    // Sizes.
    double max_edge = 0;
    double size_from_curvature = 0;  // 3D only
    double distance_ratio = 0;
    size_function size = {};  // empty: none
    // Algorithm.
    nm_output output = NM_OUTPUT_AUTO;
    nm_algorithm algorithm = NM_ALGORITHM_NETMESH;
    // Run.
    std::uint32_t threads = 1;  // 0: all cores
    bool instruments = false;
    std::uint64_t seed = 0;
    std::uint64_t max_vertices = 0;
    progress_function progress = {};  // empty: none
    // Constants of the paper.
    nm_ordering ordering = NM_ORDERING_SAMPLED_NET;
    double epsilon = 0;
    double delta = 0;
    double gamma = 0;
    double yield_radius = 0;
    double encroachment = 0;
    double cage_scale = 0;
    double root_scale = 0;
};

// Selection of simplices: those that fulfil all conditions. The fields are those of nm_selection.
struct selection {
    nm_extent extent = NM_EXTENT_ALL;
    bool across = false;
    std::uint32_t domain = NM_NONE;
};

namespace detail {

// Copies options to nm_options or the other way, all but the functions.
template <typename From, typename To>
void copy(const From &from, To &to) noexcept {
    to.criterion = from.criterion;
    to.quality_bound = from.quality_bound;
    to.min_angle = from.min_angle;
    to.min_dihedral = from.min_dihedral;
    to.gives_way = from.gives_way;
    to.extent = from.extent;
    to.interior = from.interior;
    to.crossings = from.crossings;
    to.coplanar = from.coplanar;
    to.labels = from.labels;
    to.max_edge = from.max_edge;
    to.size_from_curvature = from.size_from_curvature;
    to.distance_ratio = from.distance_ratio;
    to.output = from.output;
    to.algorithm = from.algorithm;
    to.threads = from.threads;
    to.instruments = static_cast<decltype(to.instruments)>(from.instruments ? 1 : 0);
    to.seed = from.seed;
    to.max_vertices = from.max_vertices;
    to.ordering = from.ordering;
    to.epsilon = from.epsilon;
    to.delta = from.delta;
    to.gamma = from.gamma;
    to.yield_radius = from.yield_radius;
    to.encroachment = from.encroachment;
    to.cage_scale = from.cage_scale;
    to.root_scale = from.root_scale;
}

inline nm_selection raw(const selection &wanted) noexcept {
    nm_selection which = NM_SELECTION_INIT;
    which.extent = wanted.extent;
    which.across = wanted.across ? 1 : 0;
    which.domain = wanted.domain;
    return which;
}

}  // namespace detail
}  // namespace netmesh

#endif  // NETMESH_OPTIONS_HPP
