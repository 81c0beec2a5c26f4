// SPDX-License-Identifier: GPL-2.0-or-later
// Bodies bounded by the triangles of an STL file.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <limits>
#include <map>
#include <optional>
#include <unordered_map>

#include "fluid_lbm/obstacle/solid.h"
#include "fluid_lbm/refuse.h"

namespace magfsi::fluid {

namespace {

using Triangle = std::array<Vec3, 3>;

constexpr std::size_t header_bytes = 80, count_bytes = 4, triangle_bytes = 50;
constexpr std::size_t normal_bytes = 12;

template <class... What>
[[noreturn]] void refuse_file(const std::filesystem::path& file, const What&... what) {
    refuse("is the STL file ", file.string(), ", which ", what...);
}

std::string contents(const std::filesystem::path& file) {
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

std::vector<Triangle> read_ascii(const std::string& text,
                                 const std::filesystem::path& file) {
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
        Vec3& x = triangles.back()[corner];
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
std::vector<Triangle> read_stl(const std::filesystem::path& file) {
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
        for (const Vec3& x : triangle) {
            if (!std::isfinite(x[0]) || !std::isfinite(x[1]) || !std::isfinite(x[2]))
                refuse_file(file, "has a vertex that is not finite");
        }
    }
    return triangles;
}

Vec3 minus(const Vec3& a, const Vec3& b) {
    return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}

Vec3 cross_product(const Vec3& a, const Vec3& b) {
    return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2],
            a[0] * b[1] - a[1] * b[0]};
}

double dot(const Vec3& a, const Vec3& b) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

Vec3 normal(const Triangle& t) {
    return cross_product(minus(t[1], t[0]), minus(t[2], t[0]));
}

// Whether the projection along x of the triangle covers (y, z): the parity of its edges
// that lie at higher y on the line of constant z.
bool covers(const Triangle& t, double y, double z) {
    bool odd = false;
    for (int i = 0; i < 3; ++i) {
        const Vec3 *a = &t[i], *b = &t[(i + 1) % 3];
        if (((*a)[2] > z) == ((*b)[2] > z)) continue;
        if (*b < *a) std::swap(a, b);  // the same order in both triangles of the edge
        const double along = (z - (*a)[2]) / ((*b)[2] - (*a)[2]);
        if ((*a)[1] + along * ((*b)[1] - (*a)[1]) > y) odd = !odd;
    }
    return odd;
}

// x of the triangle's plane at (y, z); none for a triangle seen edge-on.
std::optional<double> plane_at(const Triangle& t, double y, double z) {
    const Vec3 n = normal(t);
    if (n[0] == 0) return {};
    return t[0][0] - (n[1] * (y - t[0][1]) + n[2] * (z - t[0][2])) / n[0];
}

// Fraction of the way from a to b where it meets the triangle (Moeller and Trumbore 1997,
// with a margin so that no way slips between two triangles).
std::optional<double> meets(const Triangle& t, const Vec3& a, const Vec3& b) {
    constexpr double margin = 1e-9;
    const Vec3 way = minus(b, a), e1 = minus(t[1], t[0]), e2 = minus(t[2], t[0]);
    const Vec3 p = cross_product(way, e2);
    const double determinant = dot(e1, p);
    if (determinant == 0) return {};
    const Vec3 from = minus(a, t[0]), q = cross_product(from, e1);
    const double u = dot(from, p) / determinant, v = dot(way, q) / determinant;
    if (u < -margin || v < -margin || u + v > 1 + margin) return {};
    const double s = dot(e2, q) / determinant;
    if (s < -margin || s > 1 + margin) return {};
    return std::clamp(s, 0.0, 1.0);
}

// Whether the triangle's plane passes through the unit cube at `low` or close by.
bool plane_meets_cube(const Triangle& t, const Vec3& n, const std::array<int, 3>& low) {
    const Vec3 centre{low[0] + 0.5, low[1] + 0.5, low[2] + 0.5};
    const double reach = 0.51 * (std::abs(n[0]) + std::abs(n[1]) + std::abs(n[2]));
    return std::abs(dot(n, minus(centre, t[0]))) <= reach;
}

// Nearest float: what an STL file can tell apart.
std::array<float, 3> key(const Vec3& x) {
    return {static_cast<float>(x[0]), static_cast<float>(x[1]), static_cast<float>(x[2])};
}

// Every edge must be walked as often one way as the other.
void check_closed(const std::vector<Triangle>& triangles,
                  const std::filesystem::path& file) {
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

// In place: a point x of the file comes to shift + scale * x.
Bounds place(std::vector<Triangle>& triangles, double scale, const Vec3& shift) {
    constexpr double huge = std::numeric_limits<double>::max();
    Bounds bounds{{huge, huge, huge}, {-huge, -huge, -huge}};
    for (Triangle& t : triangles) {
        for (Vec3& corner : t) {
            for (int a = 0; a < 3; ++a) {
                corner[a] = shift[a] + scale * corner[a];
                bounds.low[a] = std::min(bounds.low[a], corner[a]);
                bounds.high[a] = std::max(bounds.high[a], corner[a]);
            }
        }
    }
    return bounds;
}

class TriangulatedSolid final : public Solid {
  public:
    // A point x of the file comes to shift + scale * x. Throws std::invalid_argument if
    // the surface is not closed.
    TriangulatedSolid(const std::filesystem::path& file, double scale, const Vec3& shift);

    Bounds bounds() const override { return bounds_; }

    // Both by the parity of crossings of the ray along x. Each edge is intersected in one
    // order of its ends, so that triangles that share it agree and a ray through an edge
    // or a vertex is counted once.
    bool holds(const Vec3& point) const override;
    void mark_row(double y, double z, int x_begin, std::span<char> inside) const override;

    double entry(const Vec3& outside, const Vec3& inside) const override;

  private:
    using Bin = std::array<int, 3>;
    struct BinHash {
        std::size_t operator()(const Bin& bin) const;
    };

    void sort_into_bins();
    std::vector<double> crossings(double y, double z) const;  // x of each, ascending

    std::vector<Triangle> triangles_;
    Bounds bounds_;
    // Triangles by the unit cubes and by the unit squares of (y, z) that they may meet.
    std::unordered_map<Bin, std::vector<int>, BinHash> cubes_, columns_;
};

std::size_t TriangulatedSolid::BinHash::operator()(const Bin& bin) const {
    std::size_t hash = 0;
    for (const int i : bin) hash = hash * 1000003 + static_cast<std::size_t>(i);
    return hash;
}

TriangulatedSolid::TriangulatedSolid(const std::filesystem::path& file, double scale,
                                     const Vec3& shift)
    : triangles_(read_stl(file)) {
    check_closed(triangles_, file);
    bounds_ = place(triangles_, scale, shift);
    sort_into_bins();
}

void TriangulatedSolid::sort_into_bins() {
    for (int i = 0; i < static_cast<int>(triangles_.size()); ++i) {
        const Triangle& t = triangles_[i];
        const Vec3 n = normal(t);
        Bin low, high;
        for (int a = 0; a < 3; ++a) {
            const auto [least, most] = std::minmax({t[0][a], t[1][a], t[2][a]});
            low[a] = static_cast<int>(std::floor(least));
            high[a] = static_cast<int>(std::floor(most));
        }
        for (int z = low[2]; z <= high[2]; ++z) {
            for (int y = low[1]; y <= high[1]; ++y) {
                columns_[{y, z, 0}].push_back(i);
                for (int x = low[0]; x <= high[0]; ++x) {
                    if (plane_meets_cube(t, n, {x, y, z})) cubes_[{x, y, z}].push_back(i);
                }
            }
        }
    }
}

std::vector<double> TriangulatedSolid::crossings(double y, double z) const {
    std::vector<double> all;
    const auto column = columns_.find(
        {static_cast<int>(std::floor(y)), static_cast<int>(std::floor(z)), 0});
    if (column == columns_.end()) return all;
    for (const int i : column->second) {
        if (!covers(triangles_[i], y, z)) continue;
        if (const auto x = plane_at(triangles_[i], y, z)) all.push_back(*x);
    }
    std::sort(all.begin(), all.end());
    return all;
}

bool TriangulatedSolid::holds(const Vec3& point) const {
    const auto all = crossings(point[1], point[2]);
    const auto before = std::ranges::lower_bound(all, point[0]) - all.begin();
    return before % 2 == 1;
}

void TriangulatedSolid::mark_row(double y, double z, int x_begin,
                                 std::span<char> inside) const {
    const auto at = crossings(y, z);
    for (std::size_t i = 0; i + 1 < at.size(); i += 2) {
        const double first = std::ceil(at[i] - x_begin - 0.5);
        const double last = std::ceil(at[i + 1] - x_begin - 0.5);
        const double size = static_cast<double>(inside.size());
        const auto from = static_cast<std::size_t>(std::clamp(first, 0.0, size));
        const auto to = static_cast<std::size_t>(std::clamp(last, 0.0, size));
        std::fill(inside.begin() + from, inside.begin() + std::max(from, to), char{1});
    }
}

double TriangulatedSolid::entry(const Vec3& outside, const Vec3& inside) const {
    Bin low, high;
    for (int a = 0; a < 3; ++a) {
        low[a] = static_cast<int>(std::floor(std::min(outside[a], inside[a])));
        high[a] = static_cast<int>(std::floor(std::max(outside[a], inside[a])));
    }
    double nearest = 2;
    for (int z = low[2]; z <= high[2]; ++z) {
        for (int y = low[1]; y <= high[1]; ++y) {
            for (int x = low[0]; x <= high[0]; ++x) {
                const auto cube = cubes_.find({x, y, z});
                if (cube == cubes_.end()) continue;
                for (const int i : cube->second) {
                    const auto s = meets(triangles_[i], outside, inside);
                    if (s) nearest = std::min(nearest, *s);
                }
            }
        }
    }
    return nearest <= 1 ? nearest : 0.5;  // rounding hid the surface: half-way
}

}  // namespace

std::shared_ptr<const Solid> make_stl_solid(const StlSurface& surface, double spacing_m) {
    need("scale", surface.unit_m);
    return std::make_shared<TriangulatedSolid>(surface.file, surface.unit_m / spacing_m,
                                               in_cells(surface.shift_m, spacing_m));
}

StlExtent stl_extent(const StlSurface& surface) {
    need("scale", surface.unit_m);
    std::vector<Triangle> triangles = read_stl(surface.file);
    check_closed(triangles, surface.file);
    StlExtent out{place(triangles, surface.unit_m, surface.shift_m)};
    const Vec3& origin = out.bounds_m.low;
    for (const Triangle& t : triangles)
        out.volume_m3 += dot(minus(t[0], origin),
                             cross_product(minus(t[1], origin), minus(t[2], origin))) /
                         6;
    out.volume_m3 = std::abs(out.volume_m3);  // of one turned inside out, too
    return out;
}

}  // namespace magfsi::fluid
