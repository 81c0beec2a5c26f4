// SPDX-License-Identifier: GPL-2.0-or-later
// magfsi-fluid-openfoam: the fluid of a scene by OpenFOAM's pimpleFoam, alone or beside
// magfsi-structure.
//   mpirun -n 1 magfsi-structure SCENE --out DIR
//        : -n 2 magfsi-fluid-openfoam SCENE --out DIR
#include <algorithm>

#include "adapters/run_scene.h"
#include "adapters/scene/effective.h"
#include "adapters/solvers/fluids/participant.h"
#include "adapters/solvers/openfoam/foam_fluid.h"

// Time folders come as often as fluid.openfoam.write or else the scene's output asks, or
// ten over the run; without `write` only stock programs write them.
int main(int argc, char** argv) {
    using namespace magfsi;
    return run_scene(
        coupler::Role::fluid, "The fluid of a magfsi scene by OpenFOAM", argc, argv,
        [](const scene::Scene& scene, coupler::Session& session,
           const coupler::ParticipantArguments& arguments) {
            require_solver(scene, scene::FluidSolver::openfoam);
            session.begin(*scene::coupled_step_s(scene));
            const coupler::Clock& clock = session.clock();
            openfoam::CaseTimes times{clock.step_s(), clock.steps(),
                                      std::max<std::int64_t>(1, clock.steps() / 10)};
            if (const auto& output = scene.output.fluid)
                times.steps_between_files = clock.every(output->every_s);
            if (const auto& own = scene.fluid->openfoam; own && own->write)
                times.steps_between_files = clock.every(own->write->every_s);
            times.goes_on = session.restart() != nullptr;
            openfoam::FoamFluid fluid(session.world().local(), *scene.fluid, times,
                                      session.out() / "openfoam",
                                      scene::holds_openfoam(scene));
            fluids::Participant(scene, session, fluid, arguments.progress).run();
        });
}
