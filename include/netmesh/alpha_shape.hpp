// netmesh/alpha_shape.hpp - alpha shapes of a Delaunay triangulation of points: what is round them up to
// a squared radius, its topology, volume and boundary. License: MIT OR Apache-2.0.
//
//     netmesh::mesh mesh(3, points);
//     netmesh::options options;
//     options.algorithm = NM_ALGORITHM_DELAUNAY;
//     mesh.run(options);
//     netmesh::alpha_shape shape(mesh, netmesh::optimal_alpha(mesh));
//     shape.measures().volume, shape.boundary(), shape.save("surface.ply");
//
// netmesh.h is the manual: definitions, costs, errors. As in netmesh.hpp each function that can fail is
// there twice; those that begin with try_ answer a netmesh::result.

#ifndef NETMESH_ALPHA_SHAPE_HPP
#define NETMESH_ALPHA_SHAPE_HPP

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "../netmesh.hpp"

namespace netmesh {

// Returns the least alpha whose shape is connected.
inline result<double> try_connecting_alpha(const mesh &of) {
    double alpha = 0;
    nm_status status = nm_mesh_connecting_alpha(of.get(), &alpha);
    return status == NM_OK ? result<double>(alpha) : detail::failed(status);
}

// Returns the least alpha for which each input is a vertex of a simplex of the shape, whose simplices
// make at most so many pieces.
inline result<double> try_optimal_alpha(const mesh &of, std::uint64_t components = 1) {
    double alpha = 0;
    nm_status status = nm_mesh_optimal_alpha(of.get(), components, &alpha);
    return status == NM_OK ? result<double>(alpha) : detail::failed(status);
}

// Alpha shape: all faces whose alpha value is at most alpha, a squared radius. It refers to the
// mesh, which must live and keep its place as long.
class alpha_shape {
public:
    alpha_shape(const mesh &of, double alpha) noexcept : mesh_(&of), alpha_(alpha) {}

    double alpha() const noexcept { return alpha_; }

    // Measures the shape: faces, pieces, voids, Betti numbers and volume.
    result<nm_alpha_shape> try_measures() const {
        nm_alpha_shape shape = detail::sized<nm_alpha_shape>();
        nm_status status = nm_mesh_alpha_shape(mesh_->get(), alpha_, &shape);
        return status == NM_OK ? result<nm_alpha_shape>(shape) : detail::failed(status);
    }

    // Returns an nm_face_class for each face of dimension k, in the order of mesh.faces(k).
    result<std::vector<std::uint8_t>> try_classes(std::uint32_t k) const {
        return detail::fetched<std::uint8_t>(
            [this, k](std::uint8_t *buf, std::uint64_t capacity, std::uint64_t *needed) {
                return nm_mesh_get_alpha_shape_classes(mesh_->get(), alpha_, k, buf, capacity,
                                                       needed);
            });
    }

    // Returns the boundary of the simplices, oriented outwards: facets x dim inputs, by their
    // numbers among the caller's points and of equal ones the first.
    result<table<std::uint32_t>> try_boundary() const {
        result<nm_counts> counted = mesh_->try_counts();
        if (!counted) {
            return failure{counted.status(), counted.message()};
        }
        return detail::in_rows(
            detail::fetched<std::uint32_t>(
                [this](std::uint32_t *buf, std::uint64_t capacity, std::uint64_t *needed) {
                    return nm_mesh_get_alpha_shape_boundary(mesh_->get(), alpha_, buf, capacity,
                                                            needed);
                }),
            static_cast<std::size_t>(counted->dim));
    }

    // Writes the boundary to a file that ends with .ply, .off, .stl or .obj.
    result<void> try_save(const std::string &path_utf8) const {
        return detail::outcome(nm_export_alpha_shape(mesh_->get(), alpha_, path_utf8.c_str()));
    }

#if NETMESH_EXCEPTIONS
    nm_alpha_shape measures() const { return try_measures().value(); }
    std::vector<std::uint8_t> classes(std::uint32_t k) const { return try_classes(k).value(); }
    table<std::uint32_t> boundary() const { return try_boundary().value(); }
    void save(const std::string &path_utf8) const { try_save(path_utf8).value(); }
#endif

private:
    const mesh *mesh_;
    double alpha_;
};

#if NETMESH_EXCEPTIONS
inline double connecting_alpha(const mesh &of) { return try_connecting_alpha(of).value(); }
inline double optimal_alpha(const mesh &of, std::uint64_t components = 1) {
    return try_optimal_alpha(of, components).value();
}
#endif

}  // namespace netmesh

#endif  // NETMESH_ALPHA_SHAPE_HPP
