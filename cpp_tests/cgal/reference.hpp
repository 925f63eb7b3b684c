// CGAL as the referee: its Delaunay triangulation and its exact predicates behind one interface,
// a translation unit per dimension.
#ifndef NETMESH_TESTS_CGAL_REFERENCE_HPP
#define NETMESH_TESTS_CGAL_REFERENCE_HPP

#include <cstdint>
#include <memory>
#include <vector>

class Reference {
public:
    virtual ~Reference() = default;

    // Sign of det[v1 - v0, ..., vd - v0], exact.
    virtual int orientation(const std::uint32_t* simplex) const = 0;

    // 1 if the query is inside the circumsphere of a positively oriented simplex, 0 on it, -1
    // outside; exact.
    virtual int side_of_sphere(const std::uint32_t* simplex, std::uint32_t query) const = 0;

    // The finite simplices of CGAL's Delaunay triangulation, dim + 1 vertex ids each.
    virtual std::vector<std::uint32_t> delaunay() const = 0;
};

// Copies the points.
std::unique_ptr<Reference> make_reference_2(const double* points, std::size_t n);
std::unique_ptr<Reference> make_reference_3(const double* points, std::size_t n);
std::unique_ptr<Reference> make_reference_4(const double* points, std::size_t n);
std::unique_ptr<Reference> make_reference(unsigned dim, const double* points, std::size_t n);

// CGAL's filters and their exact fallback hold for coordinates in this range, and for 0.
bool within_exact_range(const std::vector<double>& points);

#endif
