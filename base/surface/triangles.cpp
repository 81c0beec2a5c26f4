// SPDX-License-Identifier: GPL-2.0-or-later
#include "base/surface/triangles.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <numeric>
#include <span>
#include <unordered_map>
#include <utility>

#include "base/surface/stl_file.h"

namespace magfsi::surface {

namespace {

constexpr double same = 1e-7;  // distance of vertices that are joined, over size_of()
using Corners = std::array<std::uint32_t, 3>;  // numbers of the vertices

// Size of a surface: the largest of its extents and coordinates, which sets the precision
// of the digits in its file.
double size_of(const std::vector<Triangle>& triangles) {
    double size = 0;
    Vec3 low = triangles[0][0], high = low;
    for (const Triangle& t : triangles) {
        for (const Vec3& x : t) {
            low = lower(low, x);
            high = higher(high, x);
            for (std::size_t d = 0; d < 3; ++d)
                size = std::max({size, std::abs(x[d]), high[d] - low[d]});
        }
    }
    return size;
}

// Numbers of vertices. A vertex within `reach` of an earlier one gets that one's number;
// with a reach of 0 only equal floats do, as an STL file stores these.
class Vertices {
  public:
    explicit Vertices(double reach) : reach_(reach) {}

    // Number of the vertex at x; a new one if none is near.
    std::uint32_t number(const Vec3& x) {
        if (reach_ == 0) {
            Cell key{};
            for (std::size_t d = 0; d < 3; ++d)
                key[d] = static_cast<double>(static_cast<float>(x[d]));
            return of_cell(key, x);
        }
        const auto cell = [&](std::size_t d) { return std::floor(x[d] / reach_); };
        for (int n = 0; n < 27; ++n) {
            const auto found = by_cell_.find(
                {cell(0) + n % 3 - 1, cell(1) + n / 3 % 3 - 1, cell(2) + n / 9 - 1});
            if (found == by_cell_.end()) continue;
            const Vec3 way = at_[found->second] - x;
            if (dot(way, way) <= reach_ * reach_) return found->second;
        }
        return of_cell({cell(0), cell(1), cell(2)}, x);
    }
    const Vec3& operator[](std::uint32_t i) const { return at_[i]; }

  private:
    using Cell = std::array<double, 3>;
    struct Hash {
        std::size_t operator()(const Cell& cell) const {
            std::size_t hash = 0;
            for (const double c : cell)
                hash = hash * 1000003 + std::hash<double>{}(c == 0 ? 0.0 : c);
            return hash;
        }
    };
    // Number of the vertex in a grid cell. The first vertex of a cell stands for all:
    // another lies within the cell's diagonal.
    std::uint32_t of_cell(const Cell& cell, const Vec3& x) {
        const auto [found, fresh] =
            by_cell_.try_emplace(cell, static_cast<std::uint32_t>(at_.size()));
        if (fresh) at_.push_back(x);
        return found->second;
    }

    double reach_;
    std::vector<Vec3> at_;
    std::unordered_map<Cell, std::uint32_t, Hash> by_cell_;
};

// An edge of a triangle; back: the triangle runs from its higher to its lower vertex.
struct Half {
    std::uint32_t low, high;
    bool back;
    std::uint32_t triangle;
    auto operator<=>(const Half&) const = default;
};

// A surface with joined vertices and edges.
struct Joined {
    Vertices vertices;
    std::vector<Corners> triangles;
    // Edges without a partner; edges whose triangles run the same way.
    std::vector<Half> open, turned;
    std::vector<std::uint32_t> part;  // for each triangle, the first triangle of its part
};

// The edges of all triangles, sorted so that those with the same vertices follow each
// other.
std::vector<Half> edges_of(const std::vector<Corners>& triangles) {
    std::vector<Half> edges;
    edges.reserve(3 * triangles.size());
    for (std::uint32_t t = 0; t < triangles.size(); ++t) {
        for (std::size_t i = 0; i < 3; ++i) {
            const std::uint32_t a = triangles[t][i], b = triangles[t][(i + 1) % 3];
            edges.push_back({std::min(a, b), std::max(a, b), a > b, t});
        }
    }
    std::ranges::sort(edges);
    return edges;
}

// First triangle of the part of t (union-find with path halving).
std::uint32_t root_of(std::vector<std::uint32_t>& part, std::uint32_t t) {
    while (part[t] != t) t = part[t] = part[part[t]];
    return t;
}

// Joins triangles that share an edge into parts and collects faulty edges. An edge must
// occur equally often in either direction. Where more than two triangles share an edge,
// they are paired in the order of the file.
void join_edges(Joined& out) {
    const std::vector<Half> edges = edges_of(out.triangles);
    out.part.resize(out.triangles.size());
    std::iota(out.part.begin(), out.part.end(), 0U);
    for (auto first = edges.begin(); first != edges.end();) {
        const auto same_edge = [&](const Half& e) {
            return e.low == first->low && e.high == first->high;
        };
        const auto end = std::find_if_not(first, edges.end(), same_edge);
        const auto back = std::find_if(first, end, [](const Half& e) { return e.back; });
        const auto pairs = std::min(back - first, end - back);
        for (std::ptrdiff_t i = 0; i < pairs; ++i) {
            const auto a = root_of(out.part, first[i].triangle);
            const auto b = root_of(out.part, back[i].triangle);
            out.part[std::max(a, b)] = std::min(a, b);
        }
        if (back - first != end - back)
            ((end - first) % 2 == 0 ? out.turned : out.open).push_back(*first);
        first = end;
    }
    for (std::uint32_t t = 0; t < out.part.size(); ++t)
        out.part[t] = root_of(out.part, t);
}

// Joins vertices and edges; triangles that lose a vertex by it are dropped.
Joined join(const std::vector<Triangle>& triangles, double reach) {
    Joined out{Vertices(reach), {}, {}, {}, {}};
    for (const Triangle& t : triangles) {
        Corners corners{};
        for (std::size_t i = 0; i < 3; ++i) corners[i] = out.vertices.number(t[i]);
        if (corners[0] != corners[1] && corners[1] != corners[2] &&
            corners[2] != corners[0])
            out.triangles.push_back(corners);
    }
    join_edges(out);
    return out;
}

// Throws std::invalid_argument with the place of the first faulty edge and a remedy.
[[noreturn]] void refuse_open(const Joined& surface, const std::string& file) {
    const auto& edges = surface.open.empty() ? surface.turned : surface.open;
    const auto [x, y, z] =
        0.5 * (surface.vertices[edges[0].low] + surface.vertices[edges[0].high]);
    std::ostringstream place;
    place << "(" << x << ", " << y << ", " << z << ")";
    if (surface.open.empty())
        refuse_file(file, "has ", edges.size(),
                    " edges that do not join two triangles of the same orientation, one "
                    "of them at ",
                    place.str(),
                    "; turn all triangles outwards (MeshLab: Re-Orient all faces "
                    "coherently; Blender: Recalculate Outside)");
    refuse_file(file, "is open at ", place.str(), ": ", edges.size(),
                " edges that do not join two triangles; the surface must be closed (join "
                "what should meet, MeshLab: Merge Close Vertices, then Close Holes; "
                "Blender: Merge by Distance, then Fill)");
}

// Signed volume of the tetrahedron of a triangle and a point.
double volume_of(const Triangle& t, const Vec3& origin) {
    return dot(t[0] - origin, cross(t[1] - origin, t[2] - origin)) / 6;
}

void turn(Triangle& t) {
    std::swap(t[1], t[2]);
}

// Winding number at a point of all triangles except those that are left out.
template <class LeftOut>
int winding(std::span<const Triangle> triangles, const Vec3& at,
            const LeftOut& left_out) {
    int sum = 0;
    for (std::size_t t = 0; t < triangles.size(); ++t) {
        if (left_out(t)) continue;
        const auto found = crossing(triangles[t], at[1], at[2]);
        if (found && found->x > at[0]) sum += found->out;
    }
    return sum;
}

// Turns parts that are inside out. If the other parts' inside surrounds such a part, it
// is a cavity and stays as it is, otherwise it is an error of the file.
void turn_outwards(std::vector<Triangle>& triangles,
                   const std::vector<std::uint32_t>& part, double size) {
    const Vec3 origin = triangles[0][0];
    std::map<std::uint32_t, double> volume;
    double whole = 0;
    for (std::size_t t = 0; t < triangles.size(); ++t) {
        const double one = volume_of(triangles[t], origin);
        volume[part[t]] += one;
        whole += one;
    }
    if (whole < 0) {
        for (Triangle& t : triangles) turn(t);
        for (auto& [first, v] : volume) v = -v;
    }
    if (volume.size() == 1) return;
    constexpr std::size_t points = 16;  // triangles of a part that are tested
    std::map<std::uint32_t, std::size_t> looked;
    std::map<std::uint32_t, bool> slip;
    for (std::size_t t = 0; t < triangles.size(); ++t) {
        if (volume[part[t]] >= 0 || looked[part[t]]++ >= points || slip[part[t]])
            continue;
        const Triangle& one = triangles[t];
        const Vec3 n = normal(one);
        const double length = std::sqrt(dot(n, n));
        if (length == 0) continue;
        const Vec3 beside = (one[0] + one[1] + one[2]) / 3 - 1e-6 * size * n / length;
        slip[part[t]] = winding(triangles, beside, [&](std::size_t other) {
                            return volume[part[other]] < 0;
                        }) == 0;
    }
    for (std::size_t t = 0; t < triangles.size(); ++t) {
        if (volume[part[t]] < 0 && slip[part[t]]) turn(triangles[t]);
    }
}

// Winding number, by the right hand, of the triangle's projection along x around (y, z):
// the sum over the edges that cross the line of constant z at higher y.
int turns(const Triangle& t, double y, double z) {
    int sum = 0;
    for (std::size_t i = 0; i < 3; ++i) {
        const Vec3 *a = &t[i], *b = &t[(i + 1) % 3];
        if (((*a)[2] > z) == ((*b)[2] > z)) continue;
        const int up = (*b)[2] > z ? 1 : -1;
        if (*b < *a) std::swap(a, b);  // the same order in both triangles of an edge
        const double along = (z - (*a)[2]) / ((*b)[2] - (*a)[2]);
        if ((*a)[1] + along * ((*b)[1] - (*a)[1]) > y) sum += up;
    }
    return sum;
}

}  // namespace

Closed read_closed(const std::string& file, double scale, const Vec3& shift) {
    const std::vector<Triangle> read = read_stl(file);
    const double size = size_of(read);
    Joined joined = join(read, 0);
    if (!joined.open.empty()) joined = join(read, same * size);
    if (!joined.open.empty() || !joined.turned.empty()) refuse_open(joined, file);
    const auto without_area = [&] { refuse_file(file, "has no triangle with an area"); };
    if (joined.triangles.empty()) without_area();
    Closed out;
    for (const Corners& corners : joined.triangles) {
        Triangle& t = out.triangles.emplace_back();
        for (std::size_t i = 0; i < 3; ++i) t[i] = joined.vertices[corners[i]];
    }
    turn_outwards(out.triangles, joined.part, size);
    out.parts = 0;
    for (std::uint32_t t = 0; t < joined.part.size(); ++t)
        out.parts += joined.part[t] == t ? 1 : 0;
    for (Triangle& t : out.triangles) {
        for (Vec3& corner : t) corner = shift + scale * corner;
    }
    // Points on a line, or closer than rounding of their place, have none either.
    if (std::ranges::none_of(out.triangles, [](const Triangle& t) {
            const Vec3 n = normal(t);
            return dot(n, n) > 0;
        }))
        without_area();
    return out;
}

std::optional<Crossing> crossing(const Triangle& t, double y, double z) {
    const int out = turns(t, y, z);
    if (out == 0) return {};
    const auto [least, most] = std::minmax({t[0][0], t[1][0], t[2][0]});
    const Vec3 n = normal(t);
    // Rounding may give a triangle that is seen edge-on (n[0] == 0) a crossing.
    const double x = n[0] == 0
                         ? least
                         : t[0][0] - (n[1] * (y - t[0][1]) + n[2] * (z - t[0][2])) / n[0];
    return Crossing{std::clamp(x, least, most), out};
}

}  // namespace magfsi::surface
