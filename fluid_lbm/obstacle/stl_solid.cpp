// SPDX-License-Identifier: GPL-2.0-or-later
// Bodies bounded by the triangles of an STL file.
#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <unordered_map>

#include "fluid_lbm/obstacle/solid.h"
#include "surface/triangles.h"

namespace magfsi::fluid {

namespace {

using surface::cross_product, surface::dot, surface::minus, surface::normal,
    surface::Triangle;

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

Bounds bounds_of(const std::vector<Triangle>& triangles) {
    constexpr double huge = std::numeric_limits<double>::max();
    Bounds bounds{{huge, huge, huge}, {-huge, -huge, -huge}};
    for (const Triangle& t : triangles) {
        for (const Vec3& corner : t) {
            for (int a = 0; a < 3; ++a) {
                bounds.low[a] = std::min(bounds.low[a], corner[a]);
                bounds.high[a] = std::max(bounds.high[a], corner[a]);
            }
        }
    }
    return bounds;
}

class TriangulatedSolid final : public Solid {
  public:
    explicit TriangulatedSolid(std::vector<Triangle> triangles);

    Bounds bounds() const override { return bounds_; }

    // Both by the parity of crossings of the ray along x.
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

TriangulatedSolid::TriangulatedSolid(std::vector<Triangle> triangles)
    : triangles_(std::move(triangles)), bounds_(bounds_of(triangles_)) {
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
    for (const int i : column->second)
        if (const auto x = surface::crossing(triangles_[i], y, z)) all.push_back(*x);
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

std::shared_ptr<const Solid> make_stl_solid(const StlSurface& body, double spacing_m) {
    need("scale", body.unit_m);
    return std::make_shared<TriangulatedSolid>(surface::read_closed(
        body.file, body.unit_m / spacing_m, in_cells(body.shift_m, spacing_m)));
}

StlExtent stl_extent(const StlSurface& body) {
    need("scale", body.unit_m);
    const std::vector<Triangle> triangles =
        surface::read_closed(body.file, body.unit_m, body.shift_m);
    StlExtent out{bounds_of(triangles)};
    const Vec3& origin = out.bounds_m.low;
    for (const Triangle& t : triangles)
        out.volume_m3 += dot(minus(t[0], origin),
                             cross_product(minus(t[1], origin), minus(t[2], origin))) /
                         6;
    out.volume_m3 = std::abs(out.volume_m3);  // of one turned inside out, too
    return out;
}

}  // namespace magfsi::fluid
