// SPDX-License-Identifier: GPL-2.0-or-later
// What stands around the bodies in their fluid: the sides of its box and its obstacles,
// and which surfaces come near them or go into them.
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "adapters/scene/scene.h"
#include "structure/body.h"
#include "structure/mesh/mesh.h"

namespace magfsi::fluid {
class Solid;
}

namespace magfsi::bodies {

// A body and what it touches.
struct SolidProximity {
    std::size_t body = 0;
    int element = -1;  // of the surface
    std::string what;  // "the wall z_min", "the obstacle 'post'"
    structure::Vec3 at_m{};
    bool yields_to_contact = false;  // the key contact keeps bodies out of it
};

struct SolidProximities {
    std::optional<SolidProximity> inside;  // the first that is found
    std::vector<SolidProximity> near;      // once for each body and what it is near to
    double apart_m = 0;  // all others are at least so far away, as far as is looked
};

// Surfaces are looked at in their nodes and in points one grid spacing apart.
class SolidsAround {
  public:
    // solids: to_body of each. start_m: their nodes at time 0, all of one body after the
    // other's. What stands in an obstacle there, as a body does that is held by it, is
    // not looked at; nor is a side that a body starts beyond or spans the box to; nor
    // what starts beside a side or an obstacle on which a clamped face of its body
    // stands. near_m: what is closer is reported. deep_m: what is further inside is.
    SolidsAround(const scene::Scene& scene, std::span<const structure::Body> solids,
                 std::span<const structure::Vec3> start_m, double near_m, double deep_m);

    // reach_m: how far is looked at most.
    SolidProximities find(std::span<const structure::Vec3> nodes_m, double reach_m) const;

  private:
    struct Point {
        structure::MaterialPoint at;  // of the nodes of all bodies
        std::size_t body = 0;
        bool clamped = false;
    };
    struct Side {
        int axis = 0;
        double inwards = 1, place_m = 0;
        std::string what;
        std::vector<bool> free;  // by point: may not pass it
    };
    struct Obstacle {
        std::string what;
        std::shared_ptr<const fluid::Solid> solid;
        std::vector<bool> free;    // by point: does not start in it
        std::vector<bool> pushed;  // by body: contact keeps it out
    };

    void add_points(const structure::Body& body, const std::set<int>& clamped,
                    std::size_t number, int first_node);
    void add_sides(const scene::Fluid& fluid, std::span<const scene::Body> bodies,
                   std::span<const structure::Vec3> start_m);
    void add_obstacles(const scene::Fluid& fluid,
                       std::span<const structure::Vec3> start_m);
    bool comes_within(const Obstacle& obstacle, const structure::Vec3& x,
                      double distance_m) const;
    void note(const SolidProximity& proximity, double gap_m,
              SolidProximities& found) const;

    double spacing_m_, near_m_, deep_m_;
    std::vector<Point> points_;
    std::vector<Side> sides_;
    std::vector<Obstacle> obstacles_;
};

}  // namespace magfsi::bodies
