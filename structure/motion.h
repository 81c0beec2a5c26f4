// SPDX-License-Identifier: GPL-2.0-or-later
// Prescribed motions of faces and rigid parts: nodes, consistency and course over time.
#pragma once

#include <vector>

#include "structure/body.h"

namespace magfsi::structure {

// Numbers of the nodes on the faces of a motion, ascending, each once. Throws
// std::invalid_argument if the mesh has no face of that name.
std::vector<int> moved_nodes(const Body& body, const PrescribedMotion& motion);

// Throws std::invalid_argument, with body and face, if a node is moved by two motions, is
// held by a face that is not moved, or is on rollers that block the motion's direction,
// or if an axis has no direction.
void check_motions(const std::vector<Body>& bodies,
                   const std::vector<PrescribedMotion>& motions);

// Displacement from the place at time 0 [m], velocity [m/s] and acceleration [m/s2] of a
// course, the same for all of its nodes; 0 of a turn. Formulas throw as value_at does.
Vec3 displacement_m(const MotionCourse& course, double time_s);
Vec3 velocity_m_s(const MotionCourse& course, double time_s);
Vec3 acceleration_m_s2(const MotionCourse& course, double time_s);

// Displacement [m] of a course's nodes at time 0 from their places in the mesh: 0 but for
// HeldDisplacement.
Vec3 start_displacement_m(const MotionCourse& course);

// A turn since time 0 [rad], its rate [rad/s] or its acceleration [rad/s2], as a vector
// along the axis, and a point of the axis; 0 of other courses. Formulas throw as above.
struct Turn {
    Vec3 vector{};
    Vec3 about_m{};
};
Turn turn_rad(const MotionCourse& course, double time_s);
Turn turn_rate_rad_s(const MotionCourse& course, double time_s);
Turn turn_acceleration_rad_s2(const MotionCourse& course, double time_s);

// Displacement [m] of a point whose distance vector from the axis's point is arm_m when
// it turns by a vector [rad].
Vec3 turned_by_m(const Vec3& turn, const Vec3& arm_m);

// Acceleration [m/s2] of a node of a course that is at place_m.
Vec3 node_acceleration_m_s2(const MotionCourse& course, const Vec3& place_m,
                            double time_s);

}  // namespace magfsi::structure
