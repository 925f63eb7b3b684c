// netmesh/surface.hpp - the surface that points were sampled from, closed or open: its facets, topology,
// volume, sampling and certificate. License: MIT OR Apache-2.0.
//
//     netmesh::mesh mesh(3, points);
//     netmesh::options options;
//     options.algorithm = NM_ALGORITHM_DELAUNAY;
//     mesh.run(options);
//     netmesh::surface surface(mesh);
//     surface.measures().handles, surface.facets(), surface.save("surface.stl");
//
// netmesh.h is the manual: definitions, costs, errors. As in netmesh.hpp each function that can fail is
// there twice; those that begin with try_ answer a netmesh::result.

#ifndef NETMESH_SURFACE_HPP
#define NETMESH_SURFACE_HPP

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "../netmesh.hpp"

namespace netmesh {

// The surface through the inputs of a Delaunay triangulation. It refers to the mesh, which must live
// and keep its place as long.
class surface {
public:
    // NM_SURFACE_OPEN asks for one that may end.
    explicit surface(const mesh &of, nm_surface_kind kind = NM_SURFACE_CLOSED) noexcept
        : mesh_(&of), kind_(kind) {}

    // Measures the surface: facets, vertices, shells, handles, ends and volume.
    result<nm_surface> try_measures() const {
        nm_surface measures = detail::sized<nm_surface>();
        nm_status status = nm_mesh_surface(mesh_->get(), kind_, &measures);
        return status == NM_OK ? result<nm_surface>(measures) : detail::failed(status);
    }

    // Returns the facets, those of closed shells oriented outwards: facets x dim inputs, by their numbers among the caller's
    // points and of equal ones the first.
    result<table<std::uint32_t>> try_facets() const {
        result<nm_counts> counted = mesh_->try_counts();
        if (!counted) {
            return failure{counted.status(), counted.message()};
        }
        return detail::in_rows(
            detail::fetched<std::uint32_t>(
                [this](std::uint32_t *buf, std::uint64_t capacity, std::uint64_t *needed) {
                    return nm_mesh_get_surface_facets(mesh_->get(), kind_, buf, capacity, needed);
                }),
            static_cast<std::size_t>(counted->dim));
    }

    // Returns the inputs that are not on the surface, ascending.
    result<std::vector<std::uint32_t>> try_left_out() const {
        return detail::fetched<std::uint32_t>(
            [this](std::uint32_t *buf, std::uint64_t capacity, std::uint64_t *needed) {
                return nm_mesh_get_surface_left_out(mesh_->get(), kind_, buf, capacity, needed);
            });
    }

    // Returns the number of handles of each shell.
    result<std::vector<std::uint64_t>> try_genera() const {
        return detail::fetched<std::uint64_t>(
            [this](std::uint64_t *buf, std::uint64_t capacity, std::uint64_t *needed) {
                return nm_mesh_get_surface_genera(mesh_->get(), kind_, buf, capacity, needed);
            });
    }

    // Returns for each vertex how sparse the inputs are there, NaN where it is left out.
    result<std::vector<double>> try_sampling() const {
        return detail::fetched<double>([this](double *buf, std::uint64_t capacity, std::uint64_t *needed) {
            return nm_mesh_get_surface_sampling(mesh_->get(), kind_, buf, capacity, needed);
        });
    }

    // Returns 1 for each simplex that is inside the closed surface, else 0.
    result<std::vector<std::uint8_t>> try_insides() const {
        return detail::fetched<std::uint8_t>(
            [this](std::uint8_t *buf, std::uint64_t capacity, std::uint64_t *needed) {
                return nm_mesh_get_surface_insides(mesh_->get(), buf, capacity, needed);
            });
    }

    // Checks the triangulation and the surface.
    result<nm_report> try_validate() const {
        nm_report report = detail::sized<nm_report>();
        nm_status status = nm_mesh_validate_surface(mesh_->get(), kind_, &report);
        return status == NM_OK ? result<nm_report>(report) : detail::failed(status);
    }

    // Writes the surface to a file that ends with .ply, .off, .stl or .obj.
    result<void> try_save(const std::string &path_utf8) const {
        return detail::outcome(nm_export_surface(mesh_->get(), kind_, path_utf8.c_str()));
    }

#if NETMESH_EXCEPTIONS
    nm_surface measures() const { return try_measures().value(); }
    table<std::uint32_t> facets() const { return try_facets().value(); }
    std::vector<std::uint32_t> left_out() const { return try_left_out().value(); }
    std::vector<std::uint64_t> genera() const { return try_genera().value(); }
    std::vector<double> sampling() const { return try_sampling().value(); }
    std::vector<std::uint8_t> insides() const { return try_insides().value(); }
    nm_report validate() const { return try_validate().value(); }
    void save(const std::string &path_utf8) const { try_save(path_utf8).value(); }
#endif

private:
    const mesh *mesh_;
    nm_surface_kind kind_;
};

}  // namespace netmesh

#endif  // NETMESH_SURFACE_HPP
