#include "tetgen_box.hpp"

#include <tetgen.h>

#include <algorithm>
#include <chrono>

namespace {

// Corner c of the box: bit k of c says which end of axis k.
constexpr int faces[6][4] = {{0, 1, 3, 2}, {4, 5, 7, 6}, {0, 1, 5, 4},
                             {2, 3, 7, 6}, {0, 2, 6, 4}, {1, 3, 7, 5}};

void add_box(const PointSet& points, tetgenio& input) {
    double low[3];
    double high[3];
    for (int k = 0; k < 3; ++k) {
        low[k] = high[k] = points.coordinates[static_cast<std::size_t>(k)];
        for (std::size_t i = 0; i < points.size(); ++i) {
            low[k] = std::min(low[k], points.point(i)[k]);
            high[k] = std::max(high[k], points.point(i)[k]);
        }
    }
    for (int corner = 0; corner < 8; ++corner) {
        for (int k = 0; k < 3; ++k) {
            const double side = high[k] - low[k];
            input.pointlist[3 * corner + k] = (corner >> k & 1) != 0 ? high[k] + side : low[k] - side;
        }
    }
    // tetgenio frees these with delete[] in its destructor.
    input.numberoffacets = 6;
    input.facetlist = new tetgenio::facet[6];
    for (int f = 0; f < 6; ++f) {
        tetgenio::facet& facet = input.facetlist[f];
        tetgenio::init(&facet);
        facet.numberofpolygons = 1;
        facet.polygonlist = new tetgenio::polygon[1];
        tetgenio::polygon& polygon = facet.polygonlist[0];
        tetgenio::init(&polygon);
        polygon.numberofvertices = 4;
        polygon.vertexlist = new int[4];
        std::copy_n(faces[f], 4, polygon.vertexlist);
    }
}

}  // namespace

TetgenResult tetgen_in_box(const PointSet& points, const std::string& switches) {
    TetgenResult out;
    tetgenio input;
    tetgenio output;
    input.firstnumber = 0;
    input.numberofpoints = static_cast<int>(points.size()) + 8;
    input.pointlist = new REAL[3 * (points.size() + 8)];
    add_box(points, input);
    std::copy(points.coordinates.begin(), points.coordinates.end(), input.pointlist + 24);

    std::string writable = switches;
    const auto start = std::chrono::steady_clock::now();
    try {
        tetrahedralize(writable.data(), &input, &output);
    } catch (int error) {  // its way to fail
        out.error = error == 0 ? -1 : error;
    }
    out.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    if (out.error == 0) {
        out.points.assign(output.pointlist, output.pointlist + 3 * output.numberofpoints);
        const int vertices = output.numberofcorners;
        for (int t = 0; t < output.numberoftetrahedra; ++t) {
            for (int i = 0; i < 4; ++i) {
                out.tetrahedra.push_back(static_cast<std::uint32_t>(output.tetrahedronlist[vertices * t + i]));
            }
        }
    }
    return out;
}
