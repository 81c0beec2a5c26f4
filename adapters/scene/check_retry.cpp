// Scenes whose steps a retry can halve: docs/stability.md.
#include <fmt/format.h>

#include "adapters/scene/checks.h"
#include "adapters/scene/effective.h"
#include "adapters/scene/names.h"
#include "adapters/scene/unit.h"

namespace magfsi::scene {

namespace {

constexpr const char* without = "take checkpoint.on_divergence: stop";

}  // namespace

std::string fault_of_half_step(const Scene& scene) {
    Scene half = scene;
    ++half.time.halvings;
    const auto tau = relaxation_time(half);
    if (!tau || *tau >= least_relaxation_time) return {};
    return fmt::format("half of the step {} has a relaxation time of {:.6g}, below {}",
                       format_si(*coupled_step_s(scene), "s"), *tau,
                       least_relaxation_time);
}

void check_retry(const Scene& scene, const Marks& marks) {
    const Origin& here = marks.value({"checkpoint", "on_divergence"});
    if (scene.fluid && scene.fluid->solver != FluidSolver::lbm)
        refuse(here, "a retry with fluid.solver openfoam",
               "it with the lattice-Boltzmann fluid, or bodies alone",
               fmt::format("{}, and a smaller fluid.courant", without));
    if (scene.fluid && !scene.bodies.empty() &&
        scene.coupling->scheme != Scheme::serial) {
        // Impulses under way, or what was learnt, belong to a step of the old length.
        refuse(here, "a retry in a scheme that is not serial",
               "it with coupling.scheme serial",
               fmt::format("{}, and a smaller fluid.lattice_speed", without));
    }
    const std::string fault = fault_of_half_step(scene);
    if (!fault.empty())
        refuse(here, "a retry though " + fault, "room for at least one half step",
               fmt::format("{}, or a smaller fluid.spacing", without));
}

}  // namespace magfsi::scene
