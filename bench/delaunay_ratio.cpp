// Cost of the plain Delaunay triangulation over that of CGAL's, of the same points. nm_run with
// NM_ALGORITHM_DELAUNAY and CGAL take turns in one process, as in cgal_ratio.
//
//   cmake --build <build> --target delaunay_ratio, then <build>/bench/
//   delaunay_ratio                          uniform, gaussian, clusters, sphere, grid: 100,000 in 2D and
//                                           3D, and 1,000,000 uniform, 3 turns; ends with all medians
//   delaunay_ratio <dim> <n> <turns> [uniform | gaussian | clusters | sphere | grid | ...]
#include <vector>

#include "cgal_turns.hpp"

int main(int count, char** arguments) {
    nm_options options = NM_OPTIONS_INIT;
    options.algorithm = NM_ALGORITHM_DELAUNAY;
    if (count > 1) return compare_by_arguments(count, arguments, "delaunay_ratio", &options);
    std::vector<Medians> all;
    for (unsigned dim = 2; dim <= 3; ++dim) {
        for (const char* distribution : {"uniform", "gaussian", "clusters", "sphere", "grid"}) {
            all.push_back(compare_with_cgal(dim, 100000, 3, distribution, &options));
        }
        all.push_back(compare_with_cgal(dim, 1000000, 3, "uniform", &options));
    }
    print_medians(all);
    return 0;
}
