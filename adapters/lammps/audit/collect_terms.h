// What LAMMPS and the markers know of the energies, summed over the ranks.
#pragma once

#include <mpi.h>

#include <string>
#include <vector>

#include "adapters/lammps/audit/energy_audit.h"
#include "coupler/immersed_boundary/balance.h"
#include "adapters/lammps/engine.h"
#include "structure/lammps/script.h"

namespace magfsi::lammps {

// Puts the sums that the audit needs into LAMMPS's steps; after all commands of the
// script.
void attach_audit(Engine& engine, const structure::LammpsInput& input);

// All but the fluid's own. markers: null without a fluid. Collective.
EnergyTerms collect_terms(const Engine& engine, const scene::Scene& scene,
                          const std::vector<std::string>& magttice_fixes,
                          const coupler::MarkerWork* markers, MPI_Comm comm);

}  // namespace magfsi::lammps
