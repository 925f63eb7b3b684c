// Cost of a quality mesh over that of a plain Delaunay triangulation of the same vertices. nm_run
// and CGAL take turns in one process; the ratio of each turn is robust against a machine whose speed
// drifts, its median against a disturbed turn.
//
//   cmake --build <build> --target cgal_ratio, then <build>/bench/
//   cgal_ratio                              uniform, gaussian, clusters, sphere: 100,000 in 2D and
//                                           3D, 10,000 in 4D, 3 turns; ends with all medians
//   cgal_ratio <dim> <n> <turns> [uniform | gaussian | clusters | sphere | grid | ...]
#include <vector>

#include "cgal_turns.hpp"

int main(int count, char** arguments) {
    if (count > 1) return compare_by_arguments(count, arguments, "cgal_ratio", nullptr);
    std::vector<Medians> all;
    for (unsigned dim = 2; dim <= 4; ++dim) {
        for (const char* distribution : {"uniform", "gaussian", "clusters", "sphere"}) {
            all.push_back(compare_with_cgal(dim, dim == 4 ? 10000 : 100000, 3, distribution, nullptr));
        }
    }
    print_medians(all);
    return 0;
}
