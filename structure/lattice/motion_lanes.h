// SPDX-License-Identifier: GPL-2.0-or-later
// Kinematics of elements that the kernels of viscosity and of Maxwell branches share. For
// files of magfsi_isa_variants only.
#pragma once

#include "structure/lattice/element_lanes.h"

namespace magfsi::structure::MAGFSI_ISA {
namespace {

// Kinematics of an element: modes, F, hourglass vectors xy, xz, yz (v) and xyz (last).
// For velocities all of these are rates.
struct Motion {
    Vec mode[8];
    Vec f[3];
    Vec v[3];
    Vec last[1];
};

// Computes the members from the nodes' values, which are in m.mode.
template <bool brick>
MAGFSI_INLINE void complete(const double* data, Motion& m) {
    to_modes(m.mode);
    for (int k = 1; k < 8; ++k) m.mode[k] = splat(0.125) * m.mode[k];
    m.v[0] = m.mode[3];
    m.v[1] = m.mode[5];
    m.v[2] = m.mode[6];
    m.last[0] = m.mode[7];
    const double* gradient = data + batch_lanes;
    if constexpr (brick) {
        for (int d = 0; d < 3; ++d) {
            m.f[d] = load(gradient + d * batch_lanes) * m.mode[1 << d];
        }
    } else {
        mean_gradient(gradient, m.mode, m.f);
        take_off_linear(data + 31 * batch_lanes, m.f, m.v);
        take_off_linear(data + 40 * batch_lanes, m.f, m.last);
    }
}

}  // namespace
}  // namespace magfsi::structure::MAGFSI_ISA
