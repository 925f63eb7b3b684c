#include <cstdio>
#include <cstdlib>
#include <fstream>

#include "inputs.hpp"

std::string data_directory() {
    const char* given = std::getenv("NETMESH_DATA");
    return given != nullptr && *given != '\0' ? given : NETMESH_SOURCE_DIR "/../shared/data";
}

std::optional<PointSet> read_data_file(const std::string& file_name, unsigned dim) {
    std::ifstream file(data_directory() + "/" + file_name);
    if (!file) return std::nullopt;
    PointSet points{dim, {}, false};
    std::string line;
    for (std::size_t number = 1; std::getline(file, line); ++number) {
        const char* rest = line.c_str();
        unsigned found = 0;
        for (;;) {
            while (*rest == ' ' || *rest == '\t' || *rest == ',' || *rest == '\r') ++rest;
            if (*rest == '\0') break;
            char* end = nullptr;
            points.coordinates.push_back(std::strtod(rest, &end));
            if (end == rest) break;
            rest = end;
            ++found;
        }
        if (found == 0 && *rest == '\0') continue;
        if (found != dim || *rest != '\0') {
            std::fprintf(stderr, "%s:%zu: not a point of %u coordinates: %s\n", file_name.c_str(),
                         number, dim, line.c_str());
            std::exit(1);
        }
    }
    return points;
}
