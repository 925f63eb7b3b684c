#include <CGAL/Delaunay_triangulation_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>

#include <utility>

#include "reference.hpp"

namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Vertex = CGAL::Triangulation_vertex_base_with_info_2<std::uint32_t, Kernel>;
using Structure = CGAL::Triangulation_data_structure_2<Vertex>;
using Delaunay = CGAL::Delaunay_triangulation_2<Kernel, Structure>;

class Reference2 final : public Reference {
public:
    Reference2(const double* points, std::size_t n) {
        for (std::size_t i = 0; i < n; ++i) {
            points_.emplace_back(Kernel::Point_2(points[2 * i], points[2 * i + 1]), static_cast<std::uint32_t>(i));
        }
    }

    int orientation(const std::uint32_t* v) const override {
        return CGAL::orientation(at(v[0]), at(v[1]), at(v[2]));
    }

    int side_of_sphere(const std::uint32_t* v, std::uint32_t query) const override {
        return CGAL::side_of_oriented_circle(at(v[0]), at(v[1]), at(v[2]), at(query));
    }

    std::vector<std::uint32_t> delaunay() const override {
        Delaunay triangulation(points_.begin(), points_.end());
        std::vector<std::uint32_t> out;
        if (triangulation.dimension() < 2) return out;
        for (const auto face : triangulation.finite_face_handles()) {
            for (int i = 0; i < 3; ++i) out.push_back(face->vertex(i)->info());
        }
        return out;
    }

private:
    const Kernel::Point_2& at(std::uint32_t i) const { return points_[i].first; }

    std::vector<std::pair<Kernel::Point_2, std::uint32_t>> points_;
};

}  // namespace

std::unique_ptr<Reference> make_reference_2(const double* points, std::size_t n) {
    return std::make_unique<Reference2>(points, n);
}
