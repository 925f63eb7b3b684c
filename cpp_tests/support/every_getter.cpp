#include "every_getter.hpp"

#include <cstdint>

#include "check.hpp"
#include "mesh.hpp"

namespace {

// The size of an array is asked for only: its content is the business of other checks.
template <class Item, nm_status (*getter)(const nm_mesh*, Item*, std::uint64_t, std::uint64_t*)>
nm_status size_of(const nm_mesh* mesh) {
    std::uint64_t needed = 0;
    return getter(mesh, nullptr, 0, &needed);
}

template <class Item, nm_status (*getter)(const nm_mesh*, const nm_selection*, Item*, std::uint64_t,
                                          std::uint64_t*)>
nm_status size_of_selected(const nm_mesh* mesh) {
    std::uint64_t needed = 0;
    return getter(mesh, nullptr, nullptr, 0, &needed);
}

template <class Struct, nm_status (*getter)(const nm_mesh*, Struct*)>
nm_status filled(const nm_mesh* mesh) {
    auto value = sized<Struct>();
    return getter(mesh, &value);
}

nm_status spread(const nm_mesh* mesh) {
    const double edge = 1;
    std::uint64_t counts[2];
    return nm_mesh_quality_histogram(mesh, NM_MEASURE_RADIUS_EDGE, 1, 1, &edge, counts, nullptr);
}

nm_status validated(const nm_mesh* mesh) {
    auto report = sized<nm_report>();
    return nm_mesh_validate(mesh, 1, &report);
}

nm_status written(const nm_mesh* mesh) {
    const nm_write_fn drop = [](const void*, std::size_t, void*) -> std::int32_t { return 0; };
    return nm_export_write(mesh, NM_FORMAT_OFF, drop, nullptr);
}

nm_status placed(const nm_mesh* mesh) {
    std::uint64_t needed = 0;
    return nm_mesh_get_placements(mesh, NM_EXTENT_HULL, nullptr, 0, &needed);
}

nm_status indexed(const nm_mesh* mesh) { return nm_mesh_index(mesh, nullptr); }

nm_status saved(const nm_mesh* mesh) { return nm_export(mesh, "/dev/null", NM_FORMAT_XYZ); }

}  // namespace

void every_getter(const nm_mesh* mesh, nm_status expected, int first) {
    using Getter = nm_status (*)(const nm_mesh*);
    static constexpr Getter getters[] = {
        filled<nm_counts, nm_mesh_counts>,
        filled<nm_left_out, nm_mesh_left_out>,
        size_of<double, nm_mesh_get_points>,
        size_of<std::uint32_t, nm_mesh_get_simplices>,
        size_of<std::uint32_t, nm_mesh_get_neighbors>,
        size_of<std::uint8_t, nm_mesh_get_vertex_kinds>,
        size_of<std::uint32_t, nm_mesh_get_vertex_domains>,
        size_of<std::uint8_t, nm_mesh_get_precision_limited>,
        size_of<std::uint32_t, nm_mesh_get_input_vertices>,
        size_of<std::uint32_t, nm_mesh_get_vertex_inputs>,
        size_of<double, nm_mesh_get_sizes>,
        size_of<nm_domain, nm_mesh_get_domains>,
        size_of<std::uint32_t, nm_mesh_get_facet_triangles>,
        size_of<std::uint32_t, nm_mesh_get_facet_parents>,
        size_of<std::uint32_t, nm_mesh_get_facet_triangle_simplices>,
        size_of_selected<std::uint32_t, nm_mesh_get_selected>,
        size_of_selected<std::uint32_t, nm_mesh_get_edges>,
        size_of_selected<std::uint32_t, nm_mesh_get_facets>,
        size_of_selected<std::uint32_t, nm_mesh_get_facet_simplices>,
        size_of_selected<std::uint32_t, nm_mesh_get_hull>,
        size_of_selected<std::uint32_t, nm_mesh_get_hull_simplices>,
        size_of_selected<std::uint32_t, nm_mesh_get_vertex_simplices>,
        size_of_selected<std::uint64_t, nm_mesh_get_vertex_simplex_starts>,
        size_of_selected<std::uint32_t, nm_mesh_get_vertex_neighbors>,
        size_of_selected<std::uint64_t, nm_mesh_get_vertex_neighbor_starts>,
        size_of_selected<double, nm_mesh_get_circumcenters>,
        size_of_selected<double, nm_mesh_get_circumradii>,
        size_of_selected<double, nm_mesh_get_volumes>,
        size_of_selected<std::uint32_t, nm_mesh_get_regions>,
        size_of_selected<std::uint64_t, nm_mesh_get_region_starts>,
        size_of_selected<double, nm_mesh_get_region_volumes>,
        size_of_selected<double, nm_mesh_get_region_shares>,
        size_of_selected<std::uint32_t, nm_mesh_get_ridge_corners>,
        size_of_selected<std::uint64_t, nm_mesh_get_ridge_starts>,
        size_of_selected<std::uint8_t, nm_mesh_get_ridge_bounded>,
        placed,
        indexed,
        filled<nm_quality, nm_mesh_quality>,
        spread,
        filled<nm_stats, nm_mesh_stats>,
        validated,
        written,
        saved,
    };
    constexpr int count = sizeof getters / sizeof *getters;
    for (int k = 0; k < count; ++k) {
        const int number = (first + k) % count;
        check::status(getters[number](mesh), expected, __FILE__, __LINE__,
                      ("getter " + std::to_string(number)).c_str());
    }
}
