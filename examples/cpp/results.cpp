// Arrays, quality, certificate, domains and exports.
#include "must.hpp"

#include <cmath>
#include <sstream>

// Fifty points in a square, fifty in one a thousand times smaller in its middle.
static std::vector<double> two_scales() {
    std::vector<double> points = uniform_points(100, 2);
    for (std::size_t i = 0; i < points.size(); ++i) {
        points[i] = (points[i] - 0.5) * (i < 100 ? 1 : 1e-3);
    }
    return points;
}

// Area by Green's theorem, from the edges that have no neighbour.
static double area_inside_the_hull(const netmesh::mesh &mesh) {
    const auto points = mesh.points();
    const auto simplices = mesh.simplices(), neighbors = mesh.neighbors();
    double area = 0;
    for (std::size_t s = 0; s < simplices.size(); ++s) {
        for (std::size_t i = 0; i < 3; ++i) {
            if (neighbors[s][i] == NM_NONE) {
                const auto a = points[simplices[s][(i + 1) % 3]], b = points[simplices[s][(i + 2) % 3]];
                area += (a[0] * b[1] - b[0] * a[1]) / 2;
            }
        }
    }
    return area;
}

static void read_arrays(const netmesh::mesh &mesh, const std::vector<double> &inputs) {
    // [arrays]
    const auto points = mesh.points();
    double area = 0;
    for (const auto vertices : mesh.simplices()) {
        const auto a = points[vertices[0]], b = points[vertices[1]], c = points[vertices[2]];
        area += ((b[0] - a[0]) * (c[1] - a[1]) - (c[0] - a[0]) * (b[1] - a[1])) / 2;
    }
    // [end]
    expect(area > 1, "the mesh covers the square of the inputs");
    expect(std::abs(area - area_inside_the_hull(mesh)) < 1e-9, "the triangles fill the hull");
    for (std::size_t i = 0; i < inputs.size(); ++i) {
        expect(points[i / 2][i % 2] == inputs[i], "the inputs are the first vertices, bit for bit");
    }
}

static void judge(const netmesh::mesh &mesh) {
    // [quality]
    const nm_quality quality = mesh.quality();
    std::cout << "Voronoi aspect at most " << quality.worst_aspect_anywhere << '\n';

    const nm_report report = mesh.validate();  // level 3
    std::cout << report.checked << " checks, " << report.violations << " violations\n";
    // [end]
    expect(quality.worst_aspect_anywhere <= 3, "every cell keeps the default bound");
    expect(report.violations == 0 && report.level == 3, "the certificate holds");
}

static void list_domains(const netmesh::mesh &mesh) {
    // [domains]
    const auto points = mesh.points();
    for (const nm_domain &domain : mesh.domains()) {
        const auto center = points[domain.center];
        std::cout << "radius " << domain.radius << " around (" << center[0] << ", " << center[1] << ")\n";
    }
    // [end]
    const std::vector<nm_domain> domains = mesh.domains();
    const std::vector<std::uint32_t> domain_of = mesh.vertex_domains();
    expect(domains.size() >= 2 && domains[0].parent == NM_NONE, "the small square has a domain");
    expect(domains[domain_of[99]].radius < domains[0].radius / 100, "its inputs are in it");
}

static void write(const netmesh::mesh &mesh, const std::string &directory) {
    // [exports]
    mesh.save(directory + "/results.vtu");
    const std::string bytes = mesh.to_string(NM_FORMAT_VTU);
    std::ostringstream stream;
    mesh.write(NM_FORMAT_TETGEN_NODE, stream);  // the .node part, then the .ele part
    // [end]
    mesh.save(directory + "/results.xyz");
    const netmesh::mesh again = netmesh::mesh::from_file(directory + "/results.xyz");
    expect(again.counts().vertices == mesh.counts().vertices, "the file has every vertex");
    expect(bytes.find("UnstructuredGrid") != std::string::npos, "the text is a VTU file");
    expect(stream.str().size() > 100, "the stream has been written");
}

int main(int argc, char **argv) {
    if (argc != 2) {
        std::cerr << "usage: " << argv[0] << " DIRECTORY\n";
        return 2;
    }
    return run_example([&] {
        const std::vector<double> inputs = two_scales();
        netmesh::mesh mesh(2, inputs);
        mesh.run();
        read_arrays(mesh, inputs);
        judge(mesh);
        list_domains(mesh);
        write(mesh, argv[1]);
    });
}
