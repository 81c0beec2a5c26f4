// magfsi-structure: the bodies of a scene in LAMMPS, alone or beside a fluid participant.
//   mpirun -n 1 magfsi-structure SCENE --out DIR : -n 2 magfsi-fluid-lbm SCENE --out DIR
#include "adapters/lammps/participant.h"
#include "coupler/participants/guard.h"

int main(int argc, char** argv) {
    using namespace magfsi;
    return coupler::run_participant(
        coupler::Role::structure, "The soft bodies of a magfsi scene, in LAMMPS", argc,
        argv,
        [](const coupler::ParticipantArguments& arguments, coupler::RunState& state) {
            coupler::Session session(coupler::Role::structure, arguments, state);
            if (session.scene().bodies.empty())
                throw std::runtime_error("the scene has no bodies");
            const lammps::Substeps substeps = lammps::choose_substeps(session.scene());
            session.begin(substeps.coupled_step_s);
            lammps::Participant(session, substeps, arguments).run();
        });
}
