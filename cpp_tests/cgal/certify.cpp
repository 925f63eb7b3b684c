#include "certify.hpp"

#include <algorithm>
#include <array>
#include <utility>

namespace {

constexpr std::size_t most_reported = 20;

class Certifier {
public:
    Certifier(const ExportedMesh& mesh, const Reference& reference)
        : mesh_(mesh), reference_(reference), per_simplex_(mesh.dim + 1) {}

    Certificate run() {
        const std::size_t simplices = mesh_.simplex_count();
        out_.has_tie.assign(simplices, false);
        if (simplices == 0) say("there is no simplex");
        for (std::size_t s = 0; s < simplices; ++s) {
            if (!ids_in_range(s)) return std::move(out_);
        }
        for (std::size_t s = 0; s < simplices; ++s) {
            if (reference_.orientation(mesh_.simplex(s)) != 1) {
                say("simplex " + std::to_string(s) + " is not positively oriented");
            }
            for (unsigned i = 0; i < per_simplex_; ++i) facet(static_cast<std::uint32_t>(s), i);
        }
        if (out_.violations.empty()) convexity();
        euler_characteristic();
        return std::move(out_);
    }

private:
    void say(std::string what) {
        if (out_.violations.size() < most_reported) out_.violations.push_back(std::move(what));
    }

    static std::string name(std::uint32_t simplex, unsigned i) {
        return "facet " + std::to_string(i) + " of simplex " + std::to_string(simplex);
    }

    bool ids_in_range(std::size_t s) {
        for (unsigned i = 0; i < per_simplex_; ++i) {
            const std::uint32_t neighbor = mesh_.neighbors_of(s)[i];
            if (mesh_.simplex(s)[i] >= mesh_.vertex_count()
                || (neighbor != NM_NONE && neighbor >= mesh_.simplex_count())) {
                say("simplex " + std::to_string(s) + " names what does not exist");
                return false;
            }
        }
        return true;
    }

    // The position in a simplex of its vertex that the facet (simplex, i) does not have; per_simplex_
    // if the two do not share that facet.
    unsigned opposite(std::uint32_t neighbor, std::uint32_t simplex, unsigned i) const {
        const std::uint32_t* theirs = mesh_.simplex(neighbor);
        const std::uint32_t* ours = mesh_.simplex(simplex);
        unsigned found = per_simplex_;
        unsigned missing = 0;
        for (unsigned j = 0; j < per_simplex_; ++j) {
            const std::uint32_t* at = std::find(ours, ours + per_simplex_, theirs[j]);
            if (at == ours + per_simplex_ || at == ours + i) {
                found = j;
                ++missing;
            }
        }
        return missing == 1 ? found : per_simplex_;
    }

    void facet(std::uint32_t simplex, unsigned i) {
        const std::uint32_t neighbor = mesh_.neighbors_of(simplex)[i];
        if (neighbor == NM_NONE) {
            ++out_.facets;
            ++out_.hull_facets;
            return;
        }
        const unsigned j = opposite(neighbor, simplex, i);
        if (j == per_simplex_ || mesh_.neighbors_of(neighbor)[j] != simplex) {
            say(name(simplex, i) + ": the neighbour does not answer");
            return;
        }
        if (simplex > neighbor) return;
        ++out_.facets;
        const int side = reference_.side_of_sphere(mesh_.simplex(simplex), mesh_.simplex(neighbor)[j]);
        if (side > 0) say(name(simplex, i) + " is not locally Delaunay");
        if (side == 0) {
            ++out_.ties;
            out_.has_tie[simplex] = true;
            out_.has_tie[neighbor] = true;
        }
    }

    // At each ridge of the hull, the next hull facet's far vertex is not beyond this one.
    void convexity() {
        for (std::uint32_t s = 0; s < mesh_.simplex_count(); ++s) {
            for (unsigned i = 0; i < per_simplex_; ++i) {
                if (mesh_.neighbors_of(s)[i] != NM_NONE) continue;
                for (unsigned j = 0; j < per_simplex_; ++j) {
                    if (j != i) ridge(s, i, j);
                }
            }
        }
    }

    // The ridge of simplex s without its vertices i (opposite the hull facet) and j. Turns about
    // it, simplex by simplex, to the other hull facet that has it.
    void ridge(std::uint32_t s, unsigned i, unsigned j) {
        std::uint32_t simplex = s;
        unsigned kept = i;     // shared with the next simplex
        unsigned dropped = j;  // opposite the facet to cross
        for (std::size_t steps = 0;; ++steps) {
            const std::uint32_t next = mesh_.neighbors_of(simplex)[dropped];
            if (next == NM_NONE) break;
            if (steps > mesh_.simplex_count()) return say("the walk about a ridge does not end");
            const std::uint32_t shared = mesh_.simplex(simplex)[kept];
            kept = opposite(next, simplex, dropped);
            const std::uint32_t* vertices = mesh_.simplex(next);
            dropped = static_cast<unsigned>(std::find(vertices, vertices + per_simplex_, shared) - vertices);
            simplex = next;
        }
        const std::uint32_t far = mesh_.simplex(simplex)[kept];
        std::array<std::uint32_t, 9> probe{};
        std::copy_n(mesh_.simplex(s), per_simplex_, probe.begin());
        if (far == probe[i]) return;  // both facets belong to s
        probe[i] = far;
        if (reference_.orientation(probe.data()) < 0) say(name(s, i) + ": the hull is not convex");
    }

    // Vertices - edges + triangles - ... = 1, and no vertex stands alone.
    void euler_characteristic() {
        long long sum = 0;
        for (unsigned size = 1; size <= per_simplex_; ++size) {
            const auto count = static_cast<long long>(faces(size));
            sum += size % 2 == 1 ? count : -count;
            if (size == 1 && count != static_cast<long long>(mesh_.vertex_count())) {
                say(std::to_string(static_cast<long long>(mesh_.vertex_count()) - count)
                    + " vertices are in no simplex");
            }
        }
        if (sum != 1) say("the Euler characteristic is " + std::to_string(sum) + " instead of 1");
    }

    // The number of faces with `size` vertices.
    std::size_t faces(unsigned size) const {
        if (size == per_simplex_) return mesh_.simplex_count();
        if (size == per_simplex_ - 1) return out_.facets;  // counted, with its adjacency, by facet()
        using Face = std::array<std::uint32_t, 3>;     // all that is left up to dimension 4
        std::vector<unsigned> subsets;
        for (unsigned subset = 0; subset < (1u << per_simplex_); ++subset) {
            if (members(subset) == size) subsets.push_back(subset);
        }
        std::vector<Face> all;
        all.reserve(mesh_.simplex_count() * subsets.size());
        for (std::size_t s = 0; s < mesh_.simplex_count(); ++s) {
            for (const unsigned subset : subsets) {
                Face face = {NM_NONE, NM_NONE, NM_NONE};
                unsigned used = 0;
                for (unsigned i = 0; i < per_simplex_; ++i) {
                    if ((subset >> i & 1u) != 0) face[used++] = mesh_.simplex(s)[i];
                }
                std::sort(face.begin(), face.end());
                all.push_back(face);
            }
        }
        std::sort(all.begin(), all.end());
        return static_cast<std::size_t>(std::unique(all.begin(), all.end()) - all.begin());
    }

    static unsigned members(unsigned subset) {
        unsigned count = 0;
        for (; subset != 0; subset &= subset - 1) ++count;
        return count;
    }

    const ExportedMesh& mesh_;
    const Reference& reference_;
    const unsigned per_simplex_;
    Certificate out_;
};

using Tuple = std::array<std::uint32_t, 5>;

Tuple sorted_tuple(const std::uint32_t* simplex, unsigned per_simplex) {
    Tuple tuple;
    tuple.fill(NM_NONE);
    std::copy_n(simplex, per_simplex, tuple.begin());
    std::sort(tuple.begin(), tuple.end());
    return tuple;
}

// |det[v1 - v0, ...]|, by elimination with pivoting.
long double volume(const ExportedMesh& mesh, const std::uint32_t* simplex) {
    const unsigned dim = mesh.dim;
    long double rows[4][4];
    for (unsigned r = 0; r < dim; ++r) {
        for (unsigned k = 0; k < dim; ++k) {
            rows[r][k] = static_cast<long double>(mesh.point(simplex[r + 1])[k]) - mesh.point(simplex[0])[k];
        }
    }
    long double product = 1.0L;
    for (unsigned k = 0; k < dim; ++k) {
        unsigned pivot = k;
        for (unsigned r = k + 1; r < dim; ++r) {
            if (std::abs(rows[r][k]) > std::abs(rows[pivot][k])) pivot = r;
        }
        if (rows[pivot][k] == 0.0L) return 0.0L;
        std::swap(rows[pivot], rows[k]);
        product *= std::abs(rows[k][k]);
        for (unsigned r = k + 1; r < dim; ++r) {
            const long double factor = rows[r][k] / rows[k][k];
            for (unsigned c = k; c < dim; ++c) rows[r][c] -= factor * rows[k][c];
        }
    }
    return product;
}

}  // namespace

Certificate certify(const ExportedMesh& mesh, const Reference& reference) {
    return Certifier(mesh, reference).run();
}

Comparison compare(const ExportedMesh& mesh, const Certificate& certificate,
                   const Reference& reference) {
    const unsigned per_simplex = mesh.dim + 1;
    const std::vector<std::uint32_t> flat = reference.delaunay();
    Comparison out;
    out.ours = mesh.simplex_count();
    out.theirs = flat.size() / per_simplex;
    std::vector<Tuple> theirs;
    long double their_volume = 0.0L;
    for (std::size_t s = 0; s < out.theirs; ++s) {
        theirs.push_back(sorted_tuple(flat.data() + s * per_simplex, per_simplex));
        their_volume += volume(mesh, flat.data() + s * per_simplex);
    }
    std::sort(theirs.begin(), theirs.end());
    long double our_volume = 0.0L;
    for (std::size_t s = 0; s < out.ours; ++s) {
        our_volume += volume(mesh, mesh.simplex(s));
        if (!std::binary_search(theirs.begin(), theirs.end(), sorted_tuple(mesh.simplex(s), per_simplex))) {
            ++out.differing;
            if (!certificate.has_tie[s]) ++out.inexcusable;
        }
    }
    out.volume_ratio = static_cast<double>(our_volume / their_volume);
    return out;
}
