#include "fluid_lbm/obstacle/triangulated_solid.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <stdexcept>
#include <string>

namespace magfsi::fluid {

namespace {

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

}  // namespace

std::size_t TriangulatedSolid::BinHash::operator()(const Bin& bin) const {
    std::size_t hash = 0;
    for (const int i : bin) hash = hash * 1000003 + static_cast<std::size_t>(i);
    return hash;
}

TriangulatedSolid::TriangulatedSolid(const std::filesystem::path& file, double scale,
                                     const Vec3& shift)
    : triangles_(read_stl(file)) {
    check_closed(file);
    constexpr double huge = std::numeric_limits<double>::max();
    bounds_ = {{huge, huge, huge}, {-huge, -huge, -huge}};
    for (Triangle& t : triangles_) {
        for (Vec3& corner : t) {
            for (int a = 0; a < 3; ++a) {
                corner[a] = shift[a] + scale * corner[a];
                bounds_.low[a] = std::min(bounds_.low[a], corner[a]);
                bounds_.high[a] = std::max(bounds_.high[a], corner[a]);
            }
        }
    }
    sort_into_bins();
}

// Every edge must be walked as often one way as the other.
void TriangulatedSolid::check_closed(const std::filesystem::path& file) const {
    std::map<std::array<std::array<float, 3>, 2>, int> balance;
    for (const Triangle& t : triangles_) {
        for (int i = 0; i < 3; ++i) {
            const auto a = key(t[i]), b = key(t[(i + 1) % 3]);
            if (a == b) continue;
            if (a < b) ++balance[{a, b}];
            if (b < a) --balance[{b, a}];
        }
    }
    const auto open = std::count_if(balance.begin(), balance.end(),
                                    [](const auto& edge) { return edge.second != 0; });
    if (open == 0) return;
    throw std::invalid_argument(
        "STL file " + file.string() + " has " + std::to_string(open) +
        " edges that do not join two triangles of the same orientation; an obstacle's "
        "surface must be closed");
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

void TriangulatedSolid::mark_row(double y, double z, int x_begin,
                                 std::span<char> inside) const {
    const auto column = columns_.find(
        {static_cast<int>(std::floor(y)), static_cast<int>(std::floor(z)), 0});
    if (column == columns_.end()) return;
    std::vector<double> crossings;
    for (const int i : column->second) {
        if (!covers(triangles_[i], y, z)) continue;
        if (const auto x = plane_at(triangles_[i], y, z)) crossings.push_back(*x);
    }
    std::sort(crossings.begin(), crossings.end());
    for (std::size_t i = 0; i + 1 < crossings.size(); i += 2) {
        const double first = std::ceil(crossings[i] - x_begin - 0.5);
        const double last = std::ceil(crossings[i + 1] - x_begin - 0.5);
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

}  // namespace magfsi::fluid
