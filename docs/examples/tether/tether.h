// SPDX-License-Identifier: GPL-2.0-or-later
// What is asked of the tether. In the tree this would be a member of LammpsInput
// (structure/lammps/script.h), which the scene fills.
#pragma once

#include <optional>

namespace magfsi::structure {

inline std::optional<double> tether_n_m;  // stiffness of each node's spring

}  // namespace magfsi::structure
