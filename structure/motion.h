// SPDX-License-Identifier: GPL-2.0-or-later
// The course of a prescribed motion, and the nodes that follow it.
#pragma once

#include <vector>

#include "structure/body.h"

namespace magfsi::structure {

// The nodes of a body's motion, ascending. Throws std::invalid_argument on a face that
// the mesh lacks.
std::vector<int> moved_nodes(const Body& body, const PrescribedMotion& motion);

// Throws std::invalid_argument, naming body and face, where a node is moved twice, also
// held by a face that is not moved, or on rollers across its way.
void check_motions(const std::vector<Body>& bodies,
                   const std::vector<PrescribedMotion>& motions);

Vec3 displacement_m(const MotionCourse& course, double time_s);
Vec3 velocity_m_s(const MotionCourse& course, double time_s);
Vec3 acceleration_m_s2(const MotionCourse& course, double time_s);

}  // namespace magfsi::structure
