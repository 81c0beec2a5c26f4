// lammps.in and its data files in the run folder, and its lines on every rank.
#pragma once

#include "coupler/participants/session.h"
#include "structure/lammps/script.h"

namespace magfsi::lammps {

// Collective: the root writes, all ranks get the script. steps: LAMMPS steps of the run.
structure::LammpsScript generate_input(const coupler::Session& session,
                                       const structure::LammpsInput& input,
                                       std::int64_t steps);

}  // namespace magfsi::lammps
