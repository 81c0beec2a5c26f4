// SPDX-License-Identifier: GPL-2.0-or-later
// Search for contact of the bodies with the sides of the fluid's box and its obstacles.
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

// A body that is close to a side or an obstacle, or inside of it.
struct SolidProximity {
    std::size_t body = 0;
    int element = -1;        // the surface element of the body that is close
    std::string what;        // "the side z_min of the fluid's box", "the obstacle 'post'"
    structure::Vec3 at_m{};  // the point of the surface
    bool yields_to_contact = false;  // true if the key contact keeps bodies out of it
};

struct SolidProximities {
    std::optional<SolidProximity> inside;  // the first that is found
    // One entry for each pair of a body and a side or an obstacle that it is near to.
    std::vector<SolidProximity> near;
    // Lower bound of the distance of all other pairs, not above the search radius [m].
    double apart_m = 0;
};

// Surfaces are examined at their nodes and at points one grid spacing apart.
class SolidsAround {
  public:
    // solids: the scene's bodies by to_body, or with other densities; start_m: positions
    // of their nodes at time 0 [m], body after body. near_m: smaller distances are
    // reported as near; deep_m: points deeper than that are reported as inside.
    //
    // Not examined are a body that starts in an obstacle, as one that is held by it does,
    // where it starts inside or beside it; a side that a body starts beyond or to which
    // it spans the box; and points that start beside a side on which a clamped face of
    // their body stands.
    SolidsAround(const scene::Scene& scene, std::span<const structure::Body> solids,
                 std::span<const structure::Vec3> start_m, double near_m, double deep_m);

    // nodes_m: present positions of the nodes of all bodies [m]; reach_m: radius of the
    // search [m].
    SolidProximities find(std::span<const structure::Vec3> nodes_m, double reach_m) const;

  private:
    struct Point {
        structure::MaterialPoint at;  // nodes are numbered over all bodies
        std::size_t body = 0;
        bool clamped = false;  // true if it is a node of a clamped face
    };
    // A side of the box that is not periodic: the plane x[axis] = place_m, with the fluid
    // in the direction `inwards` (1 or -1).
    struct Side {
        int axis = 0;
        double inwards = 1, place_m = 0;
        std::string what;
        std::vector<bool> free;  // for each point: true if it must not pass the side
    };
    struct Obstacle {
        std::string what;
        std::shared_ptr<const fluid::Solid> solid;
        // For each point: true unless its body is held there and it starts beside it.
        std::vector<bool> free;
        std::vector<bool> pushed;  // for each body: true if contact keeps it out
    };

    void add_points(const structure::Body& body, const std::set<int>& clamped,
                    std::size_t number, int first_node);
    void add_sides(const scene::Scene& scene, std::span<const structure::Body> solids,
                   std::span<const structure::Vec3> start_m);
    void add_obstacles(const scene::Fluid& fluid,
                       std::span<const structure::Vec3> start_m);
    bool comes_within(const Obstacle& obstacle, const structure::Vec3& x,
                      double distance_m) const;
    void note(const SolidProximity& proximity, double gap_m,
              SolidProximities& found) const;

    double spacing_m_, near_m_, deep_m_;  // spacing_m_: of the coarsest grid
    std::vector<Point> points_;
    std::vector<Side> sides_;
    std::vector<Obstacle> obstacles_;
};

}  // namespace magfsi::bodies
