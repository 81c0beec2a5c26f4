// SPDX-License-Identifier: GPL-2.0-or-later
#include "adapters/solvers/bodies/solids_around.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "adapters/solvers/bodies/marker_placement.h"
#include "fluid_lbm/obstacle/solid.h"
#include "structure/mesh/body_points.h"
#include "structure/mesh/surface.h"

namespace magfsi::bodies {

namespace {

// Position of a material point whose nodes are numbered over all bodies [m].
Vec3 place_of(const structure::MaterialPoint& point, std::span<const Vec3> nodes_m) {
    Vec3 x{};
    for (std::size_t a = 0; a < 8; ++a) {
        x += point.weight[a] * nodes_m[point.node[a]];
    }
    return x;
}

// True if holds(p) is true of x and of the six points at this distance from it along the
// axes: an approximation of a ball of this radius around x that lies inside.
template <class Holds>
bool is_deep(const Holds& holds, const Vec3& x, double radius_m) {
    if (!holds(x)) return false;
    for (std::size_t d = 0; d < 3; ++d) {
        for (const double side : {-radius_m, radius_m}) {
            Vec3 beside = x;
            beside[d] += side;
            if (!holds(beside)) return false;
        }
    }
    return true;
}

// The nodes of the clamped faces.
std::set<int> clamped_nodes(const structure::Body& body,
                            const std::vector<std::string>& clamps) {
    std::set<int> all;
    for (const std::string& face : clamps) {
        const auto& nodes = structure::face_nodes(body, face, "clamped");
        all.insert(nodes.begin(), nodes.end());
    }
    return all;
}

}  // namespace

SolidsAround::SolidsAround(const scene::Scene& scene,
                           std::span<const structure::Body> solids,
                           std::span<const Vec3> start_m, double near_m, double deep_m)
    : spacing_m_(scene.fluid->spacing_m), near_m_(near_m), deep_m_(deep_m) {
    int first_node = 0;
    for (std::size_t b = 0; b < solids.size(); ++b) {
        add_points(solids[b], clamped_nodes(solids[b], scene.bodies[b].clamps), b,
                   first_node);
        first_node += static_cast<int>(solids[b].mesh.nodes.size());
    }
    add_sides(scene, solids, start_m);
    add_obstacles(*scene.fluid, start_m);
}

// Adds the surface of a body: its nodes and points in the middle of pieces of a grid
// spacing. A node is a material point with the weight 1 of a single node.
void SolidsAround::add_points(const structure::Body& body, const std::set<int>& clamped,
                              std::size_t number, int first_node) {
    const auto surface = structure::boundary_quads(body.mesh);
    std::set<int> known;
    for (const auto& quad : surface) {
        for (const int node : quad.node) {
            if (!known.insert(node).second) continue;
            Point point{{}, number, clamped.contains(node)};
            point.at.node.fill(first_node + node);
            point.at.weight[0] = 1;
            point.at.element = quad.element;
            points_.push_back(point);
        }
    }
    for (const auto& middle : structure::surface_points(body.mesh, surface, spacing_m_)) {
        points_.push_back({middle.point, number, false});
        for (int& node : points_.back().at.node) node += first_node;
    }
}

// A body may pass a side if it spans the box to it or starts beyond it; it stands on the
// side if a clamped node starts within deep_m_ of it.
void SolidsAround::add_sides(const scene::Scene& scene,
                             std::span<const structure::Body> solids,
                             std::span<const Vec3> start_m) {
    const scene::Fluid& fluid = *scene.fluid;
    for (std::size_t side = 0; side < fluid.boundaries.size(); ++side) {
        if (fluid.boundaries[side].kind == scene::BoundaryKind::periodic) continue;
        const std::size_t axis = side / 2;
        const bool low = side % 2 == 0;
        Side made{static_cast<int>(axis),
                  low ? 1.0 : -1.0,
                  low ? 0 : fluid.box_m[axis],
                  fmt::format("the side {} of the fluid's box",
                              scene::names<scene::Face>[side]),
                  {}};
        std::vector<bool> passes, stands(solids.size());
        for (std::size_t b = 0; b < solids.size(); ++b)
            passes.push_back(
                spans_fluid(fluid, scene.bodies[b], solids[b].mesh, true)[axis]);
        const auto height_m = [&](const Point& point) {
            return made.inwards * (place_of(point.at, start_m)[axis] - made.place_m);
        };
        for (const Point& point : points_) {
            const double height = height_m(point);
            if (height < -deep_m_) passes[point.body] = true;
            if (height < deep_m_ && point.clamped) stands[point.body] = true;
        }
        for (const Point& point : points_)
            made.free.push_back(!passes[point.body] &&
                                !(stands[point.body] && height_m(point) < spacing_m_));
        sides_.push_back(std::move(made));
    }
}

// An obstacle holds a body if a point of it starts deep inside, or a clamped node starts
// inside or within deep_m_ of its surface.
void SolidsAround::add_obstacles(const scene::Fluid& fluid,
                                 std::span<const Vec3> start_m) {
    std::array<int, 3> cells{};
    for (std::size_t d = 0; d < 3; ++d)
        cells[d] = std::lround(fluid.box_m[d] / spacing_m_);
    std::array<int, 3> period{};
    for (std::size_t d = 0; d < 3; ++d)
        period[d] = fluid.period_m()[d] > 0 ? cells[d] : 0;
    for (const scene::Obstacle& shape : fluid.obstacles) {
        Obstacle made{
            fmt::format("the obstacle '{}'", shape.name),
            fluid::with_images(fluid::make_solid(shape.shape, spacing_m_, cells), period),
            {},
            {}};
        std::vector<bool> holds_body(points_.empty() ? 0 : points_.back().body + 1);
        const auto holds = [&](const Vec3& x) {
            return made.solid->holds(x / spacing_m_);
        };
        for (const Point& point : points_) {
            const Vec3 x = place_of(point.at, start_m);
            if (is_deep(holds, x, deep_m_) ||
                (point.clamped && comes_within(made, x, deep_m_)))
                holds_body[point.body] = true;
        }
        // A held body is not examined at points that start inside or beside the obstacle.
        for (const Point& point : points_)
            made.free.push_back(
                !holds_body[point.body] ||
                !comes_within(made, place_of(point.at, start_m), spacing_m_));
        for (const bool held : holds_body) made.pushed.push_back(!held);
        obstacles_.push_back(std::move(made));
    }
}

// True if x, or one of the six points at this distance from it along the axes, lies in
// the obstacle.
bool SolidsAround::comes_within(const Obstacle& obstacle, const Vec3& x,
                                double distance_m) const {
    const auto outside = [&](const Vec3& at) {
        return !obstacle.solid->holds(at / spacing_m_);
    };
    return !is_deep(outside, x, distance_m);
}

// Enters a point at this distance from a side or an obstacle (negative: inside it) into
// the result.
void SolidsAround::note(const SolidProximity& proximity, double gap_m,
                        SolidProximities& found) const {
    found.apart_m = std::min(found.apart_m, std::max(0.0, gap_m));
    if (gap_m < -deep_m_ && !found.inside) found.inside = proximity;
    if (!(gap_m < near_m_)) return;
    const bool known = std::ranges::any_of(found.near, [&](const SolidProximity& m) {
        return m.body == proximity.body && m.what == proximity.what;
    });
    if (!known) found.near.push_back(proximity);
}

// The distance from an obstacle is not computed but only its class: deep inside, near, or
// within reach.
SolidProximities SolidsAround::find(std::span<const Vec3> nodes_m, double reach_m) const {
    SolidProximities found;
    found.apart_m = reach_m;
    for (std::size_t p = 0; p < points_.size(); ++p) {
        const Point& point = points_[p];
        const Vec3 x = place_of(point.at, nodes_m);
        for (const Side& side : sides_) {
            const double gap = side.inwards * (x[side.axis] - side.place_m);
            if (gap < reach_m && side.free[p])
                note({point.body, point.at.element, side.what, x, true}, gap, found);
        }
        for (const Obstacle& obstacle : obstacles_) {
            if (!obstacle.free[p] || !comes_within(obstacle, x, reach_m)) continue;
            const auto holds = [&](const Vec3& at) {
                return obstacle.solid->holds(at / spacing_m_);
            };
            const double gap = is_deep(holds, x, deep_m_)           ? -INFINITY
                               : comes_within(obstacle, x, near_m_) ? 0.5 * near_m_
                                                                    : near_m_;
            note({point.body, point.at.element, obstacle.what, x,
                  obstacle.pushed[point.body]},
                 gap, found);
        }
    }
    return found;
}

}  // namespace magfsi::bodies
