#include <CGAL/Delaunay_triangulation.h>
#include <CGAL/Epick_d.h>
#include <CGAL/Spatial_sort_traits_adapter_d.h>
#include <CGAL/property_map.h>
#include <CGAL/spatial_sort.h>

#include <array>
#include <numeric>

#include "reference.hpp"

namespace {

constexpr unsigned dim = 4;
using Kernel = CGAL::Epick_d<CGAL::Dimension_tag<dim>>;
using Vertex = CGAL::Triangulation_vertex<Kernel, std::uint32_t>;
using Structure = CGAL::Triangulation_data_structure<CGAL::Dimension_tag<dim>, Vertex>;
using Delaunay = CGAL::Delaunay_triangulation<Kernel, Structure>;
using Point = Kernel::Point_d;

class Reference4 final : public Reference {
public:
    Reference4(const double* points, std::size_t n) {
        for (std::size_t i = 0; i < n; ++i) points_.emplace_back(points + dim * i, points + dim * (i + 1));
    }

    int orientation(const std::uint32_t* simplex) const override {
        const auto vertices = vertices_of(simplex);
        return kernel_.orientation_d_object()(vertices.begin(), vertices.end());
    }

    int side_of_sphere(const std::uint32_t* simplex, std::uint32_t query) const override {
        const auto vertices = vertices_of(simplex);
        return kernel_.side_of_oriented_sphere_d_object()(vertices.begin(), vertices.end(),
                                                          points_[query]);
    }

    std::vector<std::uint32_t> delaunay() const override {
        // insert(range) would lose the ids: the same spatial sort, over indices.
        std::vector<std::size_t> order(points_.size());
        std::iota(order.begin(), order.end(), std::size_t{0});
        using Map = CGAL::Pointer_property_map<Point>::const_type;
        using Traits = CGAL::Spatial_sort_traits_adapter_d<Kernel, Map>;
        CGAL::spatial_sort(order.begin(), order.end(), Traits(CGAL::make_property_map(points_)));
        Delaunay triangulation(static_cast<int>(dim));
        Delaunay::Full_cell_handle hint;
        for (const std::size_t i : order) {
            const auto vertex = triangulation.insert(points_[i], hint);
            vertex->data() = static_cast<std::uint32_t>(i);
            hint = vertex->full_cell();
        }
        std::vector<std::uint32_t> out;
        if (triangulation.current_dimension() < static_cast<int>(dim)) return out;
        for (auto cell = triangulation.finite_full_cells_begin();
             cell != triangulation.finite_full_cells_end(); ++cell) {
            for (unsigned i = 0; i <= dim; ++i) out.push_back(cell->vertex(static_cast<int>(i))->data());
        }
        return out;
    }

private:
    std::array<Point, dim + 1> vertices_of(const std::uint32_t* v) const {
        return {points_[v[0]], points_[v[1]], points_[v[2]], points_[v[3]], points_[v[4]]};
    }

    Kernel kernel_;
    std::vector<Point> points_;
};

}  // namespace

std::unique_ptr<Reference> make_reference_4(const double* points, std::size_t n) {
    return std::make_unique<Reference4>(points, n);
}
