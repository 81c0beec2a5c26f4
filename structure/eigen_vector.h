// SPDX-License-Identifier: GPL-2.0-or-later
// Vectors of three as Eigen's, and back.
#pragma once

#include <Eigen/Core>

#include "base/vector/vec3.h"

namespace magfsi::structure {

inline Eigen::Vector3d as_eigen(const Vec3& v) {
    return {v[0], v[1], v[2]};
}
inline Vec3 as_vec3(const Eigen::Vector3d& v) {
    return {v[0], v[1], v[2]};
}

}  // namespace magfsi::structure
