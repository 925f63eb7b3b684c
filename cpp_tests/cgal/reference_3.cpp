#include <CGAL/Delaunay_triangulation_3.h>
#include <CGAL/Delaunay_triangulation_cell_base_3.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Triangulation_vertex_base_with_info_3.h>

#include <utility>

#include "reference.hpp"

namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Vertex = CGAL::Triangulation_vertex_base_with_info_3<std::uint32_t, Kernel>;
using Structure =
    CGAL::Triangulation_data_structure_3<Vertex, CGAL::Delaunay_triangulation_cell_base_3<Kernel>>;
using Delaunay = CGAL::Delaunay_triangulation_3<Kernel, Structure>;

class Reference3 final : public Reference {
public:
    Reference3(const double* points, std::size_t n) {
        for (std::size_t i = 0; i < n; ++i) {
            const double* p = points + 3 * i;
            points_.emplace_back(Kernel::Point_3(p[0], p[1], p[2]), static_cast<std::uint32_t>(i));
        }
    }

    int orientation(const std::uint32_t* v) const override {
        return CGAL::orientation(at(v[0]), at(v[1]), at(v[2]), at(v[3]));
    }

    int side_of_sphere(const std::uint32_t* v, std::uint32_t query) const override {
        return CGAL::side_of_oriented_sphere(at(v[0]), at(v[1]), at(v[2]), at(v[3]), at(query));
    }

    std::vector<std::uint32_t> delaunay() const override {
        Delaunay triangulation(points_.begin(), points_.end());
        std::vector<std::uint32_t> out;
        if (triangulation.dimension() < 3) return out;
        for (const auto cell : triangulation.finite_cell_handles()) {
            for (int i = 0; i < 4; ++i) out.push_back(cell->vertex(i)->info());
        }
        return out;
    }

private:
    const Kernel::Point_3& at(std::uint32_t i) const { return points_[i].first; }

    std::vector<std::pair<Kernel::Point_3, std::uint32_t>> points_;
};

}  // namespace

std::unique_ptr<Reference> make_reference_3(const double* points, std::size_t n) {
    return std::make_unique<Reference3>(points, n);
}
