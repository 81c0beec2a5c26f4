// SPDX-License-Identifier: GPL-2.0-or-later
// magfsi-fluid-lbm runs the lattice-Boltzmann fluid of a scene, alone or coupled to
// magfsi-structure.
//    mpirun -n 1 magfsi-structure SCENE --out DIR : -n 2 magfsi-fluid-lbm SCENE --out DIR
#include <omp.h>

#include <algorithm>
#include <cstdlib>

#include "adapters/run_scene.h"
#include "adapters/scene/effective.h"
#include "adapters/solvers/fluids/participant.h"
#include "adapters/solvers/lbm/lbm_fluid.h"
#include "adapters/solvers/lbm/refined_lbm.h"
#include "adapters/solvers/lbm/scene_to_fluid.h"
#include "fluid_lbm/lattice/populations.h"

namespace {

// Limits the threads of this process to its share of the machine's cores, since a further
// thread would take a core from a partner or spin beside it, and to the number for which
// there are enough cells. OMP_NUM_THREADS, if set, decides instead.
void choose_threads(const magfsi::scene::Fluid& fluid,
                    const magfsi::coupler::World& world) {
    if (std::getenv("OMP_NUM_THREADS")) return;
    const int share = magfsi::available_cores() / world.processes_here();
    const int worthwhile = magfsi::worthwhile_parts(fluid) / world.size();
    omp_set_num_threads(std::max(1, std::min(share, worthwhile)));
}

}  // namespace

int main(int argc, char** argv) {
    using namespace magfsi;
    return run_scene(
        coupler::Role::fluid, "The lattice-Boltzmann fluid of a magfsi scene", argc, argv,
        [](const scene::Scene& scene, coupler::Session& session,
           const coupler::ParticipantArguments& arguments) {
            require_solver(scene, scene::FluidSolver::lbm);
            choose_threads(*scene.fluid, session.world());
            session.begin(*scene::coupled_step_s(scene));
            const MPI_Comm comm = session.world().local();
            if (scene.fluid->refinement) {
                fluid::keep_memory_of_populations();
                const double step_s = session.clock().step_s();
                const scene::Following rule = scene::following(*scene.fluid);
                fluid::RefinedFluid lattice(
                    comm, lbm::to_refined_config(scene, step_s),
                    lbm::refined_parts_m(scene, scene.fluid->refinement->box_m
                                                    ? bodies::Solids{}
                                                    : bodies::to_bodies(scene)));
                lbm::RefinedLbm fluid(comm, lattice, {rule.every, 0, rule.moves_cells});
                fluids::Participant(scene, session, fluid, arguments.progress).run();
                return;
            }
            fluid::Fluid lattice(comm, lbm::to_config(scene, session.clock().step_s()));
            lbm::LbmFluid fluid(comm, lattice);
            fluids::Participant(scene, session, fluid, arguments.progress).run();
        });
}
