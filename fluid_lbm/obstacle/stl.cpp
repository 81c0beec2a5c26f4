#include "fluid_lbm/obstacle/stl.h"

#include <cmath>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <iterator>
#include <sstream>
#include <stdexcept>
#include <string>

namespace magfsi::fluid {

namespace {

constexpr std::size_t header_bytes = 80, count_bytes = 4, triangle_bytes = 50;
constexpr std::size_t normal_bytes = 12;

[[noreturn]] void refuse(const std::filesystem::path& file, const std::string& what) {
    throw std::invalid_argument("STL file " + file.string() + " " + what);
}

std::string contents(const std::filesystem::path& file) {
    std::ifstream in(file, std::ios::binary);
    if (!in) refuse(file, "cannot be opened");
    return {std::istreambuf_iterator<char>(in), {}};
}

std::uint32_t binary_count(const std::string& bytes) {
    std::uint32_t count = 0;
    if (bytes.size() >= header_bytes + count_bytes) {
        std::memcpy(&count, bytes.data() + header_bytes, count_bytes);
    }
    return count;
}

bool is_binary(const std::string& bytes) {
    return bytes.size() >= header_bytes + count_bytes &&
           bytes.size() == header_bytes + count_bytes +
                               triangle_bytes * std::size_t{binary_count(bytes)};
}

std::vector<Triangle> read_binary(const std::string& bytes) {
    std::vector<Triangle> triangles(binary_count(bytes));
    const char* at = bytes.data() + header_bytes + count_bytes;
    for (Triangle& triangle : triangles) {
        float corners[9];
        std::memcpy(corners, at + normal_bytes, sizeof corners);
        for (int i = 0; i < 9; ++i) triangle[i / 3][i % 3] = corners[i];
        at += triangle_bytes;
    }
    return triangles;
}

std::vector<Triangle> read_ascii(const std::string& text,
                                 const std::filesystem::path& file) {
    std::istringstream in(text);
    std::vector<Triangle> triangles;
    std::string word;
    int corner = 0;
    while (in >> word) {
        if (word == "endfacet" && corner != 0) {
            refuse(file, "has a facet whose number of vertices is not 3");
        }
        if (word != "vertex") continue;
        if (corner == 0) triangles.emplace_back();
        auto& x = triangles.back()[corner];
        if (!(in >> x[0] >> x[1] >> x[2])) {
            refuse(file, "has a vertex that is not three numbers, after " +
                             std::to_string(triangles.size() - 1) + " whole triangles");
        }
        corner = (corner + 1) % 3;
    }
    if (corner != 0) refuse(file, "ends inside a triangle");
    return triangles;
}

}  // namespace

std::vector<Triangle> read_stl(const std::filesystem::path& file) {
    const std::string bytes = contents(file);
    const bool binary = is_binary(bytes);
    if (!binary && bytes.compare(0, 5, "solid") != 0) {
        refuse(file,
               "has " + std::to_string(bytes.size()) +
                   " bytes; it neither begins with \"solid\" (ASCII) nor has the 84 "
                   "+ 50 bytes a triangle of its count (binary)");
    }
    std::vector<Triangle> triangles =
        binary ? read_binary(bytes) : read_ascii(bytes, file);
    if (triangles.empty()) refuse(file, "has no triangle");
    for (const Triangle& triangle : triangles) {
        for (const auto& corner : triangle) {
            for (const double x : corner) {
                if (!std::isfinite(x)) refuse(file, "has a vertex that is not finite");
            }
        }
    }
    return triangles;
}

}  // namespace magfsi::fluid
