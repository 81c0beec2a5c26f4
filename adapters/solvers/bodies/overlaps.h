// SPDX-License-Identifier: GPL-2.0-or-later
// Overlaps: places where bodies pass through themselves, each other, an obstacle or a
// side of the fluid's box. Markers would then move the same fluid twice.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "adapters/solvers/bodies/solids_around.h"
#include "structure/mesh/proximity.h"

namespace magfsi::bodies {

// The search, for a scene with a fluid.
class Overlaps {
  public:
    // solids: the scene's bodies; start_m: positions of their nodes at time 0 [m], body
    // after body.
    Overlaps(const scene::Scene& scene, std::span<const structure::Body> solids,
             std::span<const structure::Vec3> start_m);

    struct Found {
        std::string overlap;  // the first one found, with place and advice; or ""
        structure::Proximities bodies;
        SolidProximities solids;
        // Distance that surfaces must travel at least before they can overlap [m].
        double apart_m = 0;
    };
    // nodes_m: present positions of the nodes of all bodies [m].
    Found find(std::span<const structure::Vec3> nodes_m) const;

    std::string body(std::size_t number) const;  // "body 'robot'"
    // The second of two bodies, "itself" if it is the first one.
    std::string second(const std::array<std::size_t, 2>& of) const;

  private:
    std::string told(const std::string& what, const structure::Vec3& at_m,
                     bool contact_helps) const;

    bool has_contact_;
    std::vector<std::string> names_;
    structure::ProximityFinder between_;
    SolidsAround around_;
};

}  // namespace magfsi::bodies
