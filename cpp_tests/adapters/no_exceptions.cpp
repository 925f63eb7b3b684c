// netmesh.hpp under -fno-exceptions: a whole job with results.
#include <netmesh/strided.hpp>

#include <array>
#include <cstdio>
#include <sstream>
#include <string>
#include <vector>

static_assert(NETMESH_EXCEPTIONS == 0, "this is compiled with -fno-exceptions");

static int failures = 0;

static void check(bool holds, const char *what) {
    if (!holds) {
        std::fprintf(stderr, "no_exceptions.cpp: FAILED: %s\n", what);
        ++failures;
    }
}

int main() {
    std::vector<std::array<float, 2>> points;
    for (unsigned i = 0; i < 3000; ++i) {
        points.push_back({static_cast<float>(i * 7919u % 4001u), static_cast<float>(i * 104729u % 3001u)});
    }
    netmesh::result<netmesh::mesh> mesh = netmesh::try_make_mesh(netmesh::strided(points));
    check(mesh.has_value(), "a mesh is made");
    netmesh::result<netmesh::table<std::uint32_t>> early = mesh->try_simplices();
    check(!early && early.status() == NM_STATE && !early.message().empty(), "no simplices before the run");
    int reports = 0;
    netmesh::options options;
    options.progress = [&reports](const nm_progress &) { return ++reports < 1; };
    check(mesh->try_run(options).status() == NM_CANCELLED && reports == 1, "progress cancels");
    options.progress = {};
    check(mesh->try_run(options).has_value(), "the run");
    const netmesh::result<netmesh::table<std::uint32_t>> simplices = mesh->try_simplices();
    check(simplices && simplices->size() == mesh->try_counts()->simplices && simplices->width() == 3, "simplices");
    check(mesh->try_validate()->violations == 0, "the certificate");
    std::ostringstream stream;
    check(mesh->try_write(NM_FORMAT_OFF, stream).has_value(), "writing");
    check(*mesh->try_to_string(NM_FORMAT_OFF) == stream.str(), "text");
    const netmesh::result<netmesh::mesh> none = netmesh::mesh::try_create(9, nullptr, 0);
    check(!none && none.status() == NM_DIMENSION, "nine dimensions");
    std::printf("no_exceptions: %d failed\n", failures);
    return failures == 0 ? 0 : 1;
}
