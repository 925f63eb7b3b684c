// netmesh/topology.hpp - faces of a mesh, and filtrations of them. A base of the class
// netmesh::mesh, for netmesh.hpp, which includes it. License: MIT OR Apache-2.0.

#ifndef NETMESH_TOPOLOGY_HPP
#define NETMESH_TOPOLOGY_HPP

#include <cstdint>
#include <string>
#include <vector>

#include "../netmesh.h"
#include "arrays.hpp"
#include "fetch.hpp"
#include "result.hpp"
#include "table.hpp"

namespace netmesh {
namespace detail {

// Faces of a mesh, and filtrations of them.
class topology : public arrays {
public:
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
        return status == NM_OK ? result<void>() : failed(status);
    }

    // Returns the values of the faces of dimension k.
    result<std::vector<double>> try_filtration(nm_filtration filtration, std::uint32_t k) const {
        return fetched<double>(
            [this, filtration, k](double *buf, std::uint64_t capacity, std::uint64_t *needed) {
                return nm_mesh_filtration(handle_, filtration, k, buf, capacity, needed);
            });
    }

    // Writes a filtration to a file that ends with .filtration or .dipha. Its numbers are those of
    // inputs for NM_FILTRATION_ALPHA, of vertices for NM_FILTRATION_MESH.
    result<void> try_save_filtration(const std::string &path_utf8,
                                     nm_filtration filtration) const {
        nm_status status = nm_export_filtration(handle_, filtration, path_utf8.c_str());
        return status == NM_OK ? result<void>() : failed(status);
    }

    // Returns the factor between a filtration and that of the balls round the inputs.
    result<double> try_filtration_factor(nm_filtration filtration) const {
        double factor = 0;
        nm_status status = nm_mesh_filtration_factor(handle_, filtration, &factor);
        return status == NM_OK ? result<double>(factor) : failed(status);
    }

#if NETMESH_EXCEPTIONS
    // Each function below does what the try_ function of its name does, and throws netmesh::error.
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
#endif

protected:
    explicit topology(nm_mesh *handle) noexcept : arrays(handle) {}
};

}  // namespace detail
}  // namespace netmesh

#endif  // NETMESH_TOPOLOGY_HPP
