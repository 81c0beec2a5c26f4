// SPDX-License-Identifier: GPL-2.0-or-later
// Prescribed motions of faces: nodes, consistency and course over time.
#pragma once

#include <vector>

#include "structure/body.h"

namespace magfsi::structure {

// Numbers of the nodes on the faces of a motion, ascending, each once. Throws
// std::invalid_argument if the mesh has no face of that name.
std::vector<int> moved_nodes(const Body& body, const PrescribedMotion& motion);

// Throws std::invalid_argument, with body and face, if a node is moved by two motions, is
// held by a face that is not moved, or is on rollers that block the motion's direction.
void check_motions(const std::vector<Body>& bodies,
                   const std::vector<PrescribedMotion>& motions);

// Displacement from the place at time 0 [m], velocity [m/s] and acceleration [m/s2] of a
// course, the same for all of its nodes. Formulas throw as value_at does.
Vec3 displacement_m(const MotionCourse& course, double time_s);
Vec3 velocity_m_s(const MotionCourse& course, double time_s);
Vec3 acceleration_m_s2(const MotionCourse& course, double time_s);

}  // namespace magfsi::structure
