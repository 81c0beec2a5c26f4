// SPDX-License-Identifier: GPL-2.0-or-later
// The scene in the terms of structure/lammps.
#pragma once

#include "adapters/scene/scene.h"
#include "structure/lammps/script.h"

namespace magfsi::lammps {

// time_step_s: LAMMPS's own step.
structure::LammpsInput to_lammps_input(const scene::Scene& scene, double time_step_s);

// Largest stable LAMMPS step over all bodies, with platform, contact and viscosity [s].
double stable_step_s(const scene::Scene& scene);

}  // namespace magfsi::lammps
