// One point a line, coordinates as C writes hexadecimal floats; lines that begin with # say what
// the points were found to break, and "# doubles suffice" that no cell may be precision-limited.
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "cases.hpp"

namespace {

Case read_case(const std::filesystem::path& path) {
    std::ifstream file(path);
    PointSet points;
    Expected expected = Expected::mesh;
    std::string line;
    while (std::getline(file, line)) {
        if (line == "# doubles suffice") expected = Expected::mesh_without_limit;
        if (line.empty() || line[0] == '#') continue;
        std::istringstream words(line);
        unsigned dim = 0;
        for (std::string word; words >> word; ++dim) {
            points.coordinates.push_back(std::strtod(word.c_str(), nullptr));
        }
        if (points.dim == 0) points.dim = dim;
        if (dim != points.dim) {
            std::fprintf(stderr, "%s: lines of different lengths\n", path.c_str());
            std::exit(2);
        }
    }
    return {"found: " + path.stem().string(), points.dim, expected, [=] { return points; }, ""};
}

}  // namespace

std::vector<Case> found_cases(const std::string& directory) {
    std::vector<std::filesystem::path> paths;
    if (std::filesystem::is_directory(directory)) {
        for (const auto& entry : std::filesystem::directory_iterator(directory)) {
            if (entry.path().extension() == ".points") paths.push_back(entry.path());
        }
    }
    std::sort(paths.begin(), paths.end());
    std::vector<Case> cases;
    for (const auto& path : paths) cases.push_back(read_case(path));
    return cases;
}
