// magfsi-structure: the bodies of a scene in LAMMPS, alone or beside a fluid participant.
//   mpirun -n 1 magfsi-structure SCENE --out DIR : -n 2 magfsi-fluid-lbm SCENE --out DIR
#include "adapters/lammps/participant.h"
#include "adapters/run_scene.h"

int main(int argc, char** argv) {
    using namespace magfsi;
    return run_scene(
        coupler::Role::structure, "The soft bodies of a magfsi scene, in LAMMPS", argc,
        argv,
        [](const scene::Scene& scene, coupler::Session& session,
           const coupler::ParticipantArguments& arguments) {
            if (scene.bodies.empty())
                throw std::runtime_error("the scene has no bodies");
            const lammps::Substeps substeps = lammps::choose_substeps(scene);
            session.begin(substeps.coupled_step_s);
            lammps::Participant(scene, session, substeps, arguments).run();
        });
}
