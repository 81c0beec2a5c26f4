// SPDX-License-Identifier: GPL-2.0-or-later
// Bodies bounded by the triangles of an STL file.
#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <unordered_map>
#include <utility>

#include "base/surface/triangles.h"
#include "fluid_lbm/obstacle/solid.h"
#include "fluid_lbm/refuse.h"

namespace magfsi::fluid {

namespace {

using surface::normal, surface::Triangle;

// Fraction of the segment from a to b at which it meets the triangle (Moeller and
// Trumbore 1997), absent if it does not. A margin prevents segments from slipping between
// two triangles.
std::optional<double> meets(const Triangle& t, const Vec3& a, const Vec3& b) {
    constexpr double margin = 1e-9;
    const Vec3 way = b - a, e1 = t[1] - t[0], e2 = t[2] - t[0];
    const Vec3 p = cross(way, e2);
    const double determinant = dot(e1, p);
    if (determinant == 0) return {};
    const Vec3 from = a - t[0], q = cross(from, e1);
    const double u = dot(from, p) / determinant, v = dot(way, q) / determinant;
    if (u < -margin || v < -margin || u + v > 1 + margin) return {};
    const double s = dot(e2, q) / determinant;
    if (s < -margin || s > 1 + margin) return {};
    return std::clamp(s, 0.0, 1.0);
}

// True if the triangle's plane passes through the unit cube at `low` or close by.
bool plane_meets_cube(const Triangle& t, const Vec3& n, const std::array<int, 3>& low) {
    const Vec3 centre{low[0] + 0.5, low[1] + 0.5, low[2] + 0.5};
    const double reach = 0.51 * (std::abs(n[0]) + std::abs(n[1]) + std::abs(n[2]));
    return std::abs(dot(n, centre - t[0])) <= reach;
}

Bounds bounds_of(const std::vector<Triangle>& triangles) {
    constexpr double huge = std::numeric_limits<double>::max();
    Bounds bounds{{huge, huge, huge}, {-huge, -huge, -huge}};
    for (const Triangle& t : triangles) {
        for (const Vec3& corner : t) {
            bounds.low = lower(bounds.low, corner);
            bounds.high = higher(bounds.high, corner);
        }
    }
    return bounds;
}

// A body bounded by triangles, which are sorted into bins for fast queries.
class TriangulatedSolid final : public Solid {
  public:
    // reach: region in which bins are made and queries are answered.
    TriangulatedSolid(std::vector<Triangle> triangles, const Bounds& reach);

    Bounds bounds() const override { return bounds_; }

    // These two add up the windings of the surfaces that a ray along x meets.
    bool holds(const Vec3& point) const override;
    void mark_row(double y, double z, int x_begin, std::span<char> inside) const override;

    double entry(const Vec3& outside, const Vec3& inside) const override;

    // Length of the part of a line along x that lies inside.
    double length(double y, double z) const;

  private:
    using Bin = std::array<int, 3>;
    struct BinHash {
        std::size_t operator()(const Bin& bin) const;
    };

    void sort_into_bins();
    // Crossings of the line along x at (y, z) with the surface, sorted by x.
    std::vector<surface::Crossing> crossings(double y, double z) const;

    std::vector<Triangle> triangles_;
    Bounds bounds_, reach_;
    // Triangles by the unit cubes and by the unit squares of (y, z) that they may meet.
    std::unordered_map<Bin, std::vector<int>, BinHash> cubes_, columns_;
};

std::size_t TriangulatedSolid::BinHash::operator()(const Bin& bin) const {
    std::size_t hash = 0;
    for (const int i : bin) hash = hash * 1000003 + static_cast<std::size_t>(i);
    return hash;
}

TriangulatedSolid::TriangulatedSolid(std::vector<Triangle> triangles, const Bounds& reach)
    : triangles_(std::move(triangles)), bounds_(bounds_of(triangles_)), reach_(reach) {
    sort_into_bins();
}

void TriangulatedSolid::sort_into_bins() {
    for (int i = 0; i < static_cast<int>(triangles_.size()); ++i) {
        const Triangle& t = triangles_[i];
        const Vec3 n = normal(t);
        Bin low, high;
        for (int a = 0; a < 3; ++a) {
            const auto [least, most] = std::minmax({t[0][a], t[1][a], t[2][a]});
            low[a] = static_cast<int>(std::floor(std::max(least, reach_.low[a])));
            high[a] = static_cast<int>(std::floor(std::min(most, reach_.high[a])));
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

std::vector<surface::Crossing> TriangulatedSolid::crossings(double y, double z) const {
    std::vector<surface::Crossing> all;
    const auto column = columns_.find(
        {static_cast<int>(std::floor(y)), static_cast<int>(std::floor(z)), 0});
    if (column == columns_.end()) return all;
    for (const int i : column->second)
        if (const auto met = surface::crossing(triangles_[i], y, z)) all.push_back(*met);
    std::ranges::sort(all, {}, &surface::Crossing::x);
    return all;
}

bool TriangulatedSolid::holds(const Vec3& point) const {
    int winding = 0;
    for (const auto& [x, out] : crossings(point[1], point[2])) {
        if (x < point[0]) winding -= out;
    }
    return winding != 0;
}

void TriangulatedSolid::mark_row(double y, double z, int x_begin,
                                 std::span<char> inside) const {
    int winding = 0;
    double entered = 0;
    for (const auto& [x, out] : crossings(y, z)) {
        const bool was_inside = winding != 0;
        winding -= out;
        if (!was_inside) entered = x;
        if (!was_inside || winding != 0) continue;
        const double size = inside.size();
        const auto cell = [&](double at) {
            return static_cast<std::size_t>(
                std::clamp(std::ceil(at - x_begin - 0.5), 0.0, size));
        };
        std::fill(inside.begin() + cell(entered), inside.begin() + cell(x), char{1});
    }
}

double TriangulatedSolid::length(double y, double z) const {
    int winding = 0;
    double sum = 0, before = 0;
    for (const auto& [x, out] : crossings(y, z)) {
        if (winding != 0) sum += x - before;
        winding -= out;
        before = x;
    }
    return sum;
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
    return nearest <= 1 ? nearest : 0.5;  // 0.5 if rounding hid the surface
}

}  // namespace

namespace {

// Volume by lines along x. Unlike the sum of signed volumes, it counts a region once
// where parts overlap.
double volume_in_cells(const TriangulatedSolid& solid) {
    constexpr int lines = 3;  // per cell and axis
    const Bounds bounds = solid.bounds();
    double sum = 0;
    for (double z = std::floor(bounds.low[2]) + 0.5 / lines; z < bounds.high[2];
         z += 1.0 / lines) {
        for (double y = std::floor(bounds.low[1]) + 0.5 / lines; y < bounds.high[1];
             y += 1.0 / lines)
            sum += solid.length(y, z);
    }
    return sum / (lines * lines);
}

}  // namespace

// Bins reach one length of the box beyond it: queries may concern points beside the box,
// as those of bodies do.
std::shared_ptr<const Solid> make_stl_solid(const StlSurface& body, double spacing_m,
                                            const Bounds& box) {
    need("scale", body.unit_m);
    auto read = surface::read_closed(body.file, body.unit_m / spacing_m,
                                     body.shift_m / spacing_m);
    const Vec3 around = box.high - box.low + Vec3{2, 2, 2};
    return std::make_shared<TriangulatedSolid>(
        std::move(read.triangles), Bounds{box.low - around, box.high + around});
}

StlExtent stl_extent(const StlSurface& body) {
    need("scale", body.unit_m);
    auto [triangles, parts] = surface::read_closed(body.file, body.unit_m, body.shift_m);
    StlExtent out{bounds_of(triangles), 0, parts, triangles.size()};
    const Vec3& origin = out.bounds_m.low;
    for (const Triangle& t : triangles)
        out.volume_m3 += dot(t[0] - origin, cross(t[1] - origin, t[2] - origin)) / 6;
    if (parts == 1) return out;
    const double cell_m = std::ranges::max(out.bounds_m.high - origin) / 200;
    for (Triangle& t : triangles) {
        for (Vec3& corner : t) corner = (corner - origin) / cell_m;
    }
    const TriangulatedSolid solid(std::move(triangles), {{-1, -1, -1}, {201, 201, 201}});
    const double held_m3 = volume_in_cells(solid) * cell_m * cell_m * cell_m;
    // Lines are exact to about 1e-3; disjoint parts do not need them.
    if (std::abs(held_m3 - out.volume_m3) > 0.01 * out.volume_m3) out.volume_m3 = held_m3;
    return out;
}

}  // namespace magfsi::fluid
