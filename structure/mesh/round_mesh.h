// SPDX-License-Identifier: GPL-2.0-or-later
// Round bodies of hexahedra: ball, cylinder, capsule, cone, and a helix of round wire.
// All have a core of blocks in their middle and layers of elements from it to the surface
// (a cubed sphere; in sections an o-grid).
//
// Their outer faces are plane, so that nodes on the surface would leave a body that is
// too light. Nodes lie outside of it by as much as gives the mesh the volume of the
// shape. Faces x_min to z_max are the parts of the surface on the six sides of the core.
// Elements are numbered as in box_mesh as nearly as they are turned.
#pragma once

#include "structure/mesh/mesh.h"
#include "structure/options.h"

namespace magfsi::structure {

// Centred at the origin. Each throws std::invalid_argument if a size or a number of
// elements is not positive.
Mesh ball_mesh(const BallMesh& ball);
// Along x, centred at the origin, with a centre line.
Mesh cylinder_mesh(const CylinderMesh& cylinder);
// A cylinder with two half balls, along x and centred at the origin, with a centre line
// through all of it. Throws also unless the length is more than the diameter and the
// number across the core is even.
Mesh capsule_mesh(const CapsuleMesh& capsule);
// A truncated cone along x, centred at the middle of its length, with a centre line.
Mesh cone_mesh(const ConeMesh& cone);
// Wire wound about the axis x as helix_mesh winds a block: from x = 0 and the side of y.
// With a head, the wire goes on for a turn in which it comes to the axis, grows to the
// head's diameter within half a turn more, and then has the head's length. Throws also
// where turns would touch each other or themselves.
Mesh wire_mesh(const WireMesh& wire);

}  // namespace magfsi::structure
