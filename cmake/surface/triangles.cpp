// SPDX-License-Identifier: GPL-2.0-or-later
#include "surface/triangles.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <iterator>
#include <map>
#include <sstream>
#include <stdexcept>
#include <utility>

namespace magfsi::surface {

namespace {

constexpr std::size_t header_bytes = 80, count_bytes = 4, triangle_bytes = 50;
constexpr std::size_t normal_bytes = 12;

template <class... What>
[[noreturn]] void refuse_file(const std::string& file, const What&... what) {
    std::ostringstream text;
    text << "is the STL file " << file << ", which ";
    (text << ... << what);
    throw std::invalid_argument(text.str());
}

std::string contents(const std::string& file) {
    std::ifstream in(file, std::ios::binary);
    if (!in) refuse_file(file, "cannot be opened");
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

std::vector<Triangle> read_ascii(const std::string& text, const std::string& file) {
    std::istringstream in(text);
    std::vector<Triangle> triangles;
    std::string word;
    int corner = 0;
    while (in >> word) {
        if (word == "endfacet" && corner != 0) {
            refuse_file(file, "has a facet whose number of vertices is not 3");
        }
        if (word != "vertex") continue;
        if (corner == 0) triangles.emplace_back();
        Point& x = triangles.back()[corner];
        if (!(in >> x[0] >> x[1] >> x[2])) {
            refuse_file(file, "has a vertex that is not three numbers, after ",
                        triangles.size() - 1, " whole triangles");
        }
        corner = (corner + 1) % 3;
    }
    if (corner != 0) refuse_file(file, "ends inside a triangle");
    return triangles;
}

// ASCII or binary, whichever the size of the file says: some binary files begin with the
// word "solid", too. Normals and attributes are ignored.
std::vector<Triangle> read_stl(const std::string& file) {
    const std::string bytes = contents(file);
    const bool binary = is_binary(bytes);
    if (!binary && bytes.compare(0, 5, "solid") != 0) {
        refuse_file(file, "has ", bytes.size(),
                    " bytes; it neither begins with \"solid\" (ASCII) nor has the 84 + "
                    "50 bytes per triangle of its count (binary)");
    }
    std::vector<Triangle> triangles =
        binary ? read_binary(bytes) : read_ascii(bytes, file);
    if (triangles.empty()) refuse_file(file, "has no triangle");
    for (const Triangle& triangle : triangles) {
        for (const Point& x : triangle) {
            if (!std::isfinite(x[0]) || !std::isfinite(x[1]) || !std::isfinite(x[2]))
                refuse_file(file, "has a vertex that is not finite");
        }
    }
    return triangles;
}

// Whether the projection along x of the triangle covers (y, z): the parity of its edges
// that lie at higher y on the line of constant z.
bool covers(const Triangle& t, double y, double z) {
    bool odd = false;
    for (int i = 0; i < 3; ++i) {
        const Point *a = &t[i], *b = &t[(i + 1) % 3];
        if (((*a)[2] > z) == ((*b)[2] > z)) continue;
        if (*b < *a) std::swap(a, b);  // the same order in both triangles of the edge
        const double along = (z - (*a)[2]) / ((*b)[2] - (*a)[2]);
        if ((*a)[1] + along * ((*b)[1] - (*a)[1]) > y) odd = !odd;
    }
    return odd;
}

// Nearest float: what an STL file can tell apart.
std::array<float, 3> key(const Point& x) {
    return {static_cast<float>(x[0]), static_cast<float>(x[1]), static_cast<float>(x[2])};
}

// Every edge must be walked as often one way as the other.
void check_closed(const std::vector<Triangle>& triangles, const std::string& file) {
    std::map<std::array<std::array<float, 3>, 2>, int> balance;
    for (const Triangle& t : triangles) {
        for (int i = 0; i < 3; ++i) {
            const auto a = key(t[i]), b = key(t[(i + 1) % 3]);
            if (a == b) continue;
            if (a < b) ++balance[{a, b}];
            if (b < a) --balance[{b, a}];
        }
    }
    const auto open =
        std::ranges::count_if(balance, [](const auto& edge) { return edge.second != 0; });
    if (open == 0) return;
    refuse_file(file, "has ", open,
                " edges that do not join two triangles of the same orientation; the "
                "surface must be closed");
}

}  // namespace

std::vector<Triangle> read_closed(const std::string& file, double scale,
                                  const Point& shift) {
    std::vector<Triangle> triangles = read_stl(file);
    check_closed(triangles, file);
    for (Triangle& t : triangles) {
        for (Point& corner : t) {
            for (std::size_t a = 0; a < 3; ++a) corner[a] = shift[a] + scale * corner[a];
        }
    }
    return triangles;
}

// A triangle seen edge-on is not met.
std::optional<double> crossing(const Triangle& t, double y, double z) {
    if (!covers(t, y, z)) return {};
    const Point n = normal(t);
    if (n[0] == 0) return {};
    return t[0][0] - (n[1] * (y - t[0][1]) + n[2] * (z - t[0][2])) / n[0];
}

}  // namespace magfsi::surface
