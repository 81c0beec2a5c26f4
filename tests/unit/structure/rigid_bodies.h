// SPDX-License-Identifier: GPL-2.0-or-later
// Rigid bodies that several tests take.
#pragma once

#include <utility>

#include "structure/lattice/rigid_mass.h"
#include "structure/rigid_motion.h"
#include "tests/unit/structure/elements.h"

namespace magfsi::structure {

inline Body rigid(Mesh mesh) {
    Body body;
    body.name = "body";
    body.mesh = std::move(mesh);
    body.material = {0, 0, 1200};
    body.rigid_parts = {{"", {}}};
    body.element_rigid.assign(body.mesh.elements.size(), 0);
    return body;
}

// Inertia of a brick of 3 x 2 x 1 mm.
inline RigidInertia brick_inertia() {
    const Body body = rigid(box_mesh({{3e-3, 2e-3, 1e-3}, {1, 1, 1}}));
    const RigidMass mass = rigid_mass(body, 0, body.mesh.nodes);
    return {mass.mass_kg, mass.centre_m, mass.inertia_kg_m2, {}};
}

}  // namespace magfsi::structure
