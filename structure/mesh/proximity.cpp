// SPDX-License-Identifier: GPL-2.0-or-later
#include "structure/mesh/proximity.h"
#include "structure/mesh/near_pairs.h"

namespace magfsi::structure {
namespace {

using Triangle = std::array<Vec3, 3>;

// Point where the segment from p to q passes through the triangle. Touching its plane, up
// to rounding, does not count.
std::optional<Vec3> piercing(const Vec3& p, const Vec3& q, const Triangle& t) {
    constexpr double rounding = 1e-9;
    const Vec3 normal = cross(t[1] - t[0], t[2] - t[0]);
    const double before = dot(normal, p - t[0]), after = dot(normal, q - t[0]);
    const Vec3 way = q - p;
    const double least = rounding * std::sqrt(dot(normal, normal) * dot(way, way));
    if ((before > 0) == (after > 0) || std::abs(before) < least ||
        std::abs(after) < least)
        return {};
    // The segment passes through if it has all three edges on the same side.
    std::array<bool, 3> left;
    for (std::size_t i = 0; i < 3; ++i)
        left[i] = dot(way, cross(t[i] - p, t[(i + 1) % 3] - p)) > 0;
    if (left[0] != left[1] || left[1] != left[2]) return {};
    const double part = before / (before - after);
    return p + part * way;
}

// First point where one of the quad's edges, or its diagonal, passes through the other
// quad, which is taken as two triangles.
std::optional<Vec3> piercing(const Corners4& edges, const Corners4& other) {
    constexpr int ends[5][2] = {{0, 1}, {1, 2}, {2, 3}, {3, 0}, {0, 2}};
    for (const auto& [p, q] : ends) {
        for (const int third : {1, 3}) {
            const Triangle half{other[0], other[third], other[2]};
            const auto at = piercing(edges[p], edges[q], half);
            if (at) return at;
        }
    }
    return {};
}

// Smallest distance from a corner of one quad to the other.
double corner_gap_m(const Corners4& from, const Corners4& to) {
    double nearest = INFINITY;
    for (const Vec3& corner : from) {
        const auto [u, v] = nearest_on_quad(to, corner);
        const auto weight = quad_shape(u, v);
        Vec3 foot{};
        for (std::size_t i = 0; i < 4; ++i) foot += weight[i] * to[i];
        nearest = std::min(nearest, distance_m(corner, foot));
    }
    return nearest;
}

Corners4 corners_of(const std::array<int, 4>& node, std::span<const Vec3> nodes_m) {
    Corners4 out;
    for (std::size_t i = 0; i < 4; ++i) out[i] = nodes_m[node[i]];
    return out;
}

}  // namespace

// Centre and radius of the ball around the four corners.
ProximityFinder::Ball ProximityFinder::ball_around(const Patch& patch,
                                                   std::span<const Vec3> nodes_m) {
    const Corners4 corners = corners_of(patch.node, nodes_m);
    Ball out;
    for (const Vec3& x : corners) out.centre_m += 0.25 * x;
    for (const Vec3& x : corners)
        out.radius_m = std::max(out.radius_m, distance_m(x, out.centre_m));
    return out;
}

ProximityFinder::ProximityFinder(std::span<const Mesh* const> bodies, double near_m,
                                 const Vec3& period_m)
    : period_m_(period_m), near_m_(near_m) {
    int first_node = 0;
    double largest = 0;
    for (std::size_t b = 0; b < bodies.size(); ++b) {
        for (const SurfaceQuad& quad : boundary_quads(*bodies[b])) {
            Patch patch{quad.node, b, quad.element, {}};
            patch.rest = ball_around(patch, bodies[b]->nodes);
            largest = std::max(largest, patch.rest.radius_m);
            const Corners4 x = corners_of(quad.node, bodies[b]->nodes);
            for (std::size_t i = 0; i < 4; ++i)
                shortest_edge_m_ =
                    std::min(shortest_edge_m_, distance_m(x[i], x[(i + 1) % 4]));
            for (int& node : patch.node) node += first_node;
            patches_.push_back(patch);
        }
        goes_on_.push_back(goes_on_through_sides(bodies[b]->nodes, period_m));
        first_node += static_cast<int>(bodies[b]->nodes.size());
    }
    // The number of pairs grows with the cube of the range, the steps between two
    // searches only linearly.
    reach_m_ = std::max(2 * largest, near_m);
}

std::optional<double> ProximityFinder::rest_gap_m(const Patch& a, const Patch& b,
                                                  const Vec3& image_m) const {
    if (a.body != b.body) return {};
    const auto apart =
        rest_distance_m(a.rest.centre_m, b.rest.centre_m, image_m, goes_on_[a.body]);
    if (!apart) return {};
    return *apart - a.rest.radius_m - b.rest.radius_m;
}

// gap_m: lower bound of the gap, from the balls around the two quads.
void ProximityFinder::look_at(const Patch& a, const Patch& b, const Vec3& image_m,
                              double gap_m, std::span<const Vec3> nodes_m,
                              Proximities& found) const {
    const Corners4 of_a = corners_of(a.node, nodes_m);
    Corners4 of_b = corners_of(b.node, nodes_m);
    for (Vec3& corner : of_b) corner += image_m;
    Proximity proximity{{a.body, b.body}, {a.element, b.element}, of_a[0], gap_m};
    auto at = gap_m < 0 ? piercing(of_a, of_b) : std::nullopt;
    if (gap_m < 0 && !at) at = piercing(of_b, of_a);
    if (at) {
        proximity.at_m = *at;
        proximity.gap_m = 0;
        if (!found.crossing) found.crossing = proximity;
    } else if (gap_m < near_m_) {
        proximity.gap_m = std::min(corner_gap_m(of_a, of_b), corner_gap_m(of_b, of_a));
    }
    found.apart_m = std::min(found.apart_m, proximity.gap_m);
    if (!(proximity.gap_m < near_m_)) return;
    const auto known = std::ranges::find(found.near, proximity.body, &Proximity::body);
    if (known == found.near.end())
        found.near.push_back(proximity);
    else if (proximity.gap_m < known->gap_m)
        *known = proximity;
}

Proximities ProximityFinder::find(std::span<const Vec3> nodes_m) const {
    std::vector<Vec3> centres;
    std::vector<double> radii;
    double largest = 0;
    for (const Patch& patch : patches_) {
        const Ball ball = ball_around(patch, nodes_m);
        centres.push_back(ball.centre_m);
        radii.push_back(ball.radius_m);
        largest = std::max(largest, ball.radius_m);
    }
    Proximities found;
    found.apart_m = reach_m_;
    NearPairs(centres, 2 * largest + reach_m_, period_m_)
        .visit([&](std::size_t i, std::size_t j, const Vec3& image_m) {
            const double reach = radii[i] + radii[j] + reach_m_;
            const Vec3 apart = centres[i] - centres[j] - image_m;
            if (dot(apart, apart) >= reach * reach) return;
            const Patch &a = patches_[i], &b = patches_[j];
            const double gap = std::sqrt(dot(apart, apart)) - radii[i] - radii[j];
            const auto at_rest = rest_gap_m(a, b, image_m);
            const bool neighbours =
                at_rest && *at_rest <= a.rest.radius_m + b.rest.radius_m;
            if (neighbours || (at_rest && gap >= 0.5 * *at_rest)) return;
            look_at(a, b, image_m, gap, nodes_m, found);
        });
    return found;
}

}  // namespace magfsi::structure
