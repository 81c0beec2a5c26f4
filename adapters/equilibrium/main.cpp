// magfsi-equilibrium: the bodies of a scene without motion, one process.
//   magfsi-equilibrium SCENE --out DIR
#include "adapters/equilibrium/participant.h"
#include "coupler/participants/guard.h"
#include "adapters/scene/effective.h"

int main(int argc, char** argv) {
    using namespace magfsi;
    return coupler::run_participant(
        coupler::Role::structure,
        "Static equilibria of a magfsi scene, by Newton's method", argc, argv,
        [](const coupler::ParticipantArguments& arguments, coupler::RunState& state) {
            coupler::Session session(coupler::Role::structure, arguments, state);
            if (session.world().size() > 1)
                throw std::invalid_argument("magfsi-equilibrium runs as one process");
            session.begin(scene::path_step_s(session.scene()));
            equilibrium::Participant(session, arguments.progress).run();
        });
}
