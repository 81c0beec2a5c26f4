// magfsi-equilibrium: the bodies of a scene without motion, one process.
//   magfsi-equilibrium SCENE --out DIR
#include "adapters/equilibrium/participant.h"
#include "adapters/run_scene.h"
#include "adapters/scene/effective.h"

int main(int argc, char** argv) {
    using namespace magfsi;
    return run_scene(
        coupler::Role::structure,
        "Static equilibria of a magfsi scene, by Newton's method", argc, argv,
        [](const scene::Scene& scene, coupler::Session& session,
           const coupler::ParticipantArguments& arguments) {
            if (session.world().size() > 1)
                throw std::invalid_argument("magfsi-equilibrium runs as one process");
            session.begin(scene::path_step_s(scene));
            equilibrium::Participant(scene, session, arguments.progress).run();
        });
}
