// magfsi-fluid-lbm: the lattice-Boltzmann fluid of a scene, alone or beside
// magfsi-structure.
//   mpirun -n 1 magfsi-structure SCENE --out DIR : -n 2 magfsi-fluid-lbm SCENE --out DIR
#include "adapters/fluids/participant.h"
#include "adapters/lbm/lbm_fluid.h"
#include "adapters/lbm/scene_to_fluid.h"
#include "adapters/run_scene.h"
#include "adapters/scene/effective.h"

int main(int argc, char** argv) {
    using namespace magfsi;
    return run_scene(
        coupler::Role::fluid, "The lattice-Boltzmann fluid of a magfsi scene", argc, argv,
        [](const scene::Scene& scene, coupler::Session& session,
           const coupler::ParticipantArguments& arguments) {
            require_solver(scene, scene::FluidSolver::lbm);
            session.begin(*scene::coupled_step_s(scene));
            const MPI_Comm comm = session.world().local();
            fluid::Fluid lattice(comm, lbm::to_config(scene, session.clock().step_s()));
            lbm::LbmFluid fluid(comm, lattice);
            fluids::Participant(scene, session, fluid, arguments.progress).run();
        });
}
