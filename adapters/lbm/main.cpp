// SPDX-License-Identifier: GPL-2.0-or-later
// magfsi-fluid-lbm: the lattice-Boltzmann fluid of a scene, alone or beside
// magfsi-structure.
//   mpirun -n 1 magfsi-structure SCENE --out DIR : -n 2 magfsi-fluid-lbm SCENE --out DIR
#include "adapters/fluids/participant.h"
#include "adapters/lbm/lbm_fluid.h"
#include "adapters/lbm/refined_lbm.h"
#include "adapters/lbm/scene_to_fluid.h"
#include "adapters/run_scene.h"
#include "adapters/scene/effective.h"
#include "fluid_lbm/lattice/populations.h"

int main(int argc, char** argv) {
    using namespace magfsi;
    return run_scene(
        coupler::Role::fluid, "The lattice-Boltzmann fluid of a magfsi scene", argc, argv,
        [](const scene::Scene& scene, coupler::Session& session,
           const coupler::ParticipantArguments& arguments) {
            require_solver(scene, scene::FluidSolver::lbm);
            session.begin(*scene::coupled_step_s(scene));
            const MPI_Comm comm = session.world().local();
            if (scene.fluid->refinement) {
                fluid::keep_memory_of_populations();
                const double step_s = session.clock().step_s();
                const scene::Following rule = scene::following(*scene.fluid);
                fluid::RefinedFluid lattice(comm, lbm::to_refined_config(scene, step_s),
                                            lbm::refined_parts_m(scene));
                lbm::RefinedLbm fluid(comm, lattice, {rule.every, 0, rule.moves_cells});
                fluids::Participant(scene, session, fluid, arguments.progress).run();
                return;
            }
            fluid::Fluid lattice(comm, lbm::to_config(scene, session.clock().step_s()));
            lbm::LbmFluid fluid(comm, lattice);
            fluids::Participant(scene, session, fluid, arguments.progress).run();
        });
}
