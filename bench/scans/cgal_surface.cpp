// Surface through points by CGAL: advancing front on the Delaunay triangulation, or scale space.
// The seconds are those of the processor from points in memory to triangles, with the Delaunay
// triangulation, which is told apart too; files are not in them.
//
//   cmake --build <build> --target cgal_surface, then <build>/bench/scans/
//   cgal_surface front | scale-space POINTS.xyz OUT.off
#include <CGAL/Advancing_front_surface_reconstruction.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Scale_space_reconstruction_3/Advancing_front_mesher.h>
#include <CGAL/Scale_space_surface_reconstruction_3.h>

#include <array>
#include <cstdio>
#include <cstring>
#include <ctime>
#include <fstream>
#include <map>
#include <vector>

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Point = Kernel::Point_3;
using Triangle = std::array<std::size_t, 3>;

struct Surface {
    std::vector<Point> points;
    std::vector<Triangle> triangles;
    double delaunay_seconds = 0;
    double seconds = 0;
};

static double seconds_since(std::clock_t start) {
    return static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
}

static std::vector<Point> read_points(const char* path) {
    std::ifstream file(path);
    std::vector<Point> points;
    for (double x, y, z; file >> x >> y >> z;) points.emplace_back(x, y, z);
    return points;
}

static Surface by_advancing_front(const std::vector<Point>& points) {
    using Reconstruction = CGAL::Advancing_front_surface_reconstruction<>;
    Surface surface;
    const auto start = std::clock();
    Reconstruction::Triangulation_3 delaunay(points.begin(), points.end());
    surface.delaunay_seconds = seconds_since(start);
    Reconstruction reconstruction(delaunay);
    reconstruction.run();
    surface.seconds = seconds_since(start);

    using Structure = Reconstruction::Triangulation_data_structure_2;
    const Structure& structure = reconstruction.triangulation_data_structure_2();
    std::map<Reconstruction::Vertex_handle, std::size_t> numbers;
    for (auto face = structure.faces_begin(); face != structure.faces_end(); ++face) {
        if (!face->is_on_surface()) continue;
        Triangle triangle;
        for (int k = 0; k < 3; ++k) {
            const auto vertex = face->vertex(k)->vertex_3();
            const auto [found, is_new] = numbers.try_emplace(vertex, surface.points.size());
            if (is_new) surface.points.push_back(vertex->point());
            triangle[k] = found->second;
        }
        surface.triangles.push_back(triangle);
    }
    return surface;
}

// The front advances over points that are smoothed four times; its triangles join the points given.
static Surface by_scale_space(const std::vector<Point>& points) {
    Surface surface;
    surface.points = points;
    const auto start = std::clock();
    CGAL::Scale_space_surface_reconstruction_3<Kernel> reconstruction(points.begin(), points.end());
    reconstruction.increase_scale(4);
    reconstruction.reconstruct_surface(CGAL::Scale_space_reconstruction_3::Advancing_front_mesher<Kernel>());
    surface.seconds = seconds_since(start);
    surface.triangles.assign(reconstruction.facets_begin(), reconstruction.facets_end());
    return surface;
}

static void write_off(const char* path, const Surface& surface) {
    std::FILE* file = std::fopen(path, "w");
    std::fprintf(file, "OFF\n%zu %zu 0\n", surface.points.size(), surface.triangles.size());
    for (const Point& point : surface.points) {
        std::fprintf(file, "%.17g %.17g %.17g\n", point.x(), point.y(), point.z());
    }
    for (const Triangle& triangle : surface.triangles) {
        std::fprintf(file, "3 %zu %zu %zu\n", triangle[0], triangle[1], triangle[2]);
    }
    std::fclose(file);
}

int main(int count, char** arguments) {
    const bool is_front = count == 4 && std::strcmp(arguments[1], "front") == 0;
    if (count != 4 || (!is_front && std::strcmp(arguments[1], "scale-space") != 0)) {
        std::fprintf(stderr, "cgal_surface front | scale-space POINTS.xyz OUT.off\n");
        return 2;
    }
    const std::vector<Point> points = read_points(arguments[2]);
    const Surface surface = is_front ? by_advancing_front(points) : by_scale_space(points);
    write_off(arguments[3], surface);
    std::printf("{\"seconds\": %.4f, \"delaunay_seconds\": %.4f}\n", surface.seconds, surface.delaunay_seconds);
    return 0;
}
