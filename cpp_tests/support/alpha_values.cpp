#include "alpha_values.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "check.hpp"

namespace {

// Solves a small system with a regular matrix.
std::vector<long double> solved(std::vector<std::vector<long double>> rows) {
    const std::size_t size = rows.size();
    for (std::size_t k = 0; k < size; ++k) {
        std::size_t pivot = k;
        for (std::size_t row = k; row < size; ++row) {
            if (std::abs(rows[row][k]) > std::abs(rows[pivot][k])) {
                pivot = row;
            }
        }
        std::swap(rows[k], rows[pivot]);
        for (std::size_t row = 0; row < size; ++row) {
            const long double share = row == k ? 0 : rows[row][k] / rows[k][k];
            for (std::size_t column = k; column <= size; ++column) {
                rows[row][column] -= share * rows[k][column];
            }
        }
    }
    std::vector<long double> found;
    for (std::size_t k = 0; k < size; ++k) {
        found.push_back(rows[k][size] / rows[k][k]);
    }
    return found;
}

bool is_gabriel(const ExportedMesh& mesh, const Face& face, const Ball& ball) {
    for (std::uint32_t vertex = 0; vertex < mesh.vertex_count(); ++vertex) {
        long double square = 0;
        for (unsigned axis = 0; axis < mesh.dim; ++axis) {
            square += std::pow(mesh.point(vertex)[axis] - ball.center[axis], 2.0L);
        }
        if (square < ball.square && std::find(face.begin(), face.end(), vertex) == face.end()) {
            return false;
        }
    }
    return true;
}

}  // namespace

Faces faces_of(const ExportedMesh& mesh) {
    Faces faces(mesh.dim + 1);
    for (std::size_t s = 0; s < mesh.simplex_count(); ++s) {
        Face all(mesh.simplex(s), mesh.simplex(s) + mesh.dim + 1);
        std::sort(all.begin(), all.end());
        for (unsigned chosen = 1; chosen < 1u << all.size(); ++chosen) {
            Face face;
            for (std::size_t i = 0; i < all.size(); ++i) {
                if (chosen >> i & 1) {
                    face.push_back(all[i]);
                }
            }
            faces[face.size() - 1].emplace(std::move(face), 0);
        }
    }
    for (auto& of_dimension : faces) {
        std::size_t number = 0;
        for (auto& face : of_dimension) {
            face.second = number++;
        }
    }
    return faces;
}

Face without(const Face& face, std::size_t index) {
    Face rest = face;
    rest.erase(rest.begin() + static_cast<std::ptrdiff_t>(index));
    return rest;
}

// The centre is the first point plus a sum of edges, equally far from all points.
Ball circumscribed(const ExportedMesh& mesh, const Face& face) {
    const double* first = mesh.point(face[0]);
    std::vector<std::vector<long double>> edges, rows;
    for (std::size_t i = 1; i < face.size(); ++i) {
        edges.emplace_back();
        for (unsigned axis = 0; axis < mesh.dim; ++axis) {
            edges.back().push_back(static_cast<long double>(mesh.point(face[i])[axis]) - first[axis]);
        }
    }
    const auto product = [](const std::vector<long double>& a, const std::vector<long double>& b) {
        long double sum = 0;
        for (std::size_t axis = 0; axis < a.size(); ++axis) {
            sum += a[axis] * b[axis];
        }
        return sum;
    };
    for (const auto& edge : edges) {
        rows.emplace_back();
        for (const auto& other : edges) {
            rows.back().push_back(product(edge, other));
        }
        rows.back().push_back(product(edge, edge) / 2);
    }
    const std::vector<long double> shares = solved(rows);
    std::vector<long double> reach(mesh.dim);
    for (std::size_t i = 0; i < edges.size(); ++i) {
        for (unsigned axis = 0; axis < mesh.dim; ++axis) {
            reach[axis] += shares[i] * edges[i][axis];
        }
    }
    Ball ball{reach, product(reach, reach)};
    for (unsigned axis = 0; axis < mesh.dim; ++axis) {
        ball.center[axis] += first[axis];
    }
    return ball;
}

std::vector<std::vector<long double>> alpha_values(const ExportedMesh& mesh, const Faces& faces) {
    std::vector<std::vector<long double>> values(mesh.dim + 1);
    // Values that the faces of one more dimension give to their facets.
    std::vector<long double> from_above;
    for (std::size_t k = mesh.dim + 1; k-- > 0;) {
        std::vector<long double> to_below(k == 0 ? 0 : faces[k - 1].size(),
                                          std::numeric_limits<long double>::infinity());
        for (const auto& [face, number] : faces[k]) {
            const Ball ball = circumscribed(mesh, face);
            values[k].push_back(is_gabriel(mesh, face, ball) ? ball.square : from_above[number]);
            for (std::size_t i = 0; k > 0 && i < face.size(); ++i) {
                long double& below = to_below[faces[k - 1].at(without(face, i))];
                below = std::min(below, values[k].back());
            }
        }
        from_above = std::move(to_below);
    }
    return values;
}

MeshHandle delaunay_of(const PointSet& points) {
    MeshHandle mesh = create(points);
    nm_options options = default_options();
    options.algorithm = NM_ALGORITHM_DELAUNAY;
    REQUIRE_OK(nm_run(mesh.get(), &options));
    return mesh;
}
