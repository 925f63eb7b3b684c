// One run of a peer, as a process of its own: it may crash, hang or exit.
//
//   peers <tetgen | mesh_2 | delaunay> <dim> <radius-edge bound> <memory in MiB> <input> <output>
//
// input: n x dim doubles. output: seconds as a double; the number of vertices as 64 bits and their
// coordinates; the number of simplices and their 32-bit ids. Little-endian. Ends with 3 where the
// peer says that it failed.
#include <sys/resource.h>

#include <cstdio>
#include <cstdlib>
#include <exception>
#include <fstream>
#include <iterator>
#include <string>

#include "peers.hpp"
#ifdef NETMESH_WITH_TETGEN
#include "tetgen_box.hpp"
#endif

namespace {

constexpr int peer_failed = 3;

void limit(int resource, rlim_t most) {
    const rlimit both{most, most};
    setrlimit(resource, &both);
}

PointSet read_points(const char* path, unsigned dim) {
    std::ifstream file(path, std::ios::binary);
    const std::vector<char> bytes{std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
    PointSet points{dim, std::vector<double>(bytes.size() / sizeof(double)), false};
    std::copy(bytes.begin(), bytes.end(), reinterpret_cast<char*>(points.coordinates.data()));
    return points;
}

template <class T>
void put(std::ofstream& file, const T* data, std::size_t count) {
    file.write(reinterpret_cast<const char*>(data), static_cast<std::streamsize>(count * sizeof(T)));
}

bool write_mesh(const char* path, unsigned dim, const PeerMesh& mesh) {
    std::ofstream file(path, std::ios::binary);
    const std::uint64_t vertices = mesh.points.size() / dim;
    const std::uint64_t simplices = mesh.simplices.size() / (dim + 1);
    put(file, &mesh.seconds, 1);
    put(file, &vertices, 1);
    put(file, mesh.points.data(), mesh.points.size());
    put(file, &simplices, 1);
    put(file, mesh.simplices.data(), mesh.simplices.size());
    file.close();
    return !file.fail();
}

PeerMesh tetgen(const PointSet& points, double bound) {
#ifdef NETMESH_WITH_TETGEN
    // p: the box; q: the bound, and no bound on dihedral angles; O0/0: no optimisation afterwards,
    // as netmesh has none; Q: quiet.
    TetgenResult result = tetgen_in_box(points, "pq" + std::to_string(bound) + "/0O0/0Q");
    if (result.error != 0) std::exit(peer_failed);
    return {result.seconds, std::move(result.points), std::move(result.tetrahedra)};
#else
    (void)points;
    (void)bound;
    std::exit(peer_failed);
#endif
}

PeerMesh run(const std::string& mesher, const PointSet& points, double bound) {
    if (mesher == "tetgen") return tetgen(points, bound);
    if (mesher == "mesh_2") return refine_2(points, bound);
    if (mesher == "delaunay") return delaunay(points);
    std::fprintf(stderr, "no mesher '%s'\n", mesher.c_str());
    std::exit(2);
}

}  // namespace

int main(int count, char** arguments) {
    if (count != 7) {
        std::fprintf(stderr, "usage: peers <mesher> <dim> <bound> <MiB> <input> <output>\n");
        return 2;
    }
    limit(RLIMIT_AS, static_cast<rlim_t>(std::strtoull(arguments[4], nullptr, 10)) << 20);
    limit(RLIMIT_CORE, 0);
    const auto dim = static_cast<unsigned>(std::atoi(arguments[2]));
    try {
        const PointSet points = read_points(arguments[5], dim);
        const PeerMesh mesh = run(arguments[1], points, std::strtod(arguments[3], nullptr));
        return write_mesh(arguments[6], dim, mesh) ? 0 : peer_failed;
    } catch (const std::exception& error) {
        std::fprintf(stderr, "%s\n", error.what());
        return peer_failed;
    }
}
