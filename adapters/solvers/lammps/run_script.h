// SPDX-License-Identifier: GPL-2.0-or-later
// The LAMMPS script of a run.
#pragma once

#include <cstdint>

#include "coupler/participants/session.h"
#include "structure/lammps/script.h"

namespace magfsi::lammps {

// The script of the run, the same on every rank. The root writes it as lammps.in, with
// its data files, into the run folder. steps: LAMMPS steps of the run. Collective.
structure::LammpsScript generate_input(const coupler::Session& session,
                                       const structure::LammpsInput& input,
                                       std::int64_t steps);

}  // namespace magfsi::lammps
