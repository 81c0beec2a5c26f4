#include "adapters/magfsi/explain.h"

#include <fmt/format.h>

#include "adapters/magfsi/explain_parts.h"
#include "adapters/scene/effective.h"

namespace magfsi::launch {

std::string explain(const scene::Scene& scene, const Ranks& ranks) {
    const int fluid_ranks = ranks.contains("fluid") ? ranks.at("fluid") : 1;
    std::string text = fmt::format("scene '{}'; effects in step order:\n", scene.name);
    for (const std::string& line : scene::effects_by_step(scene))
        text += fmt::format("  {}\n", line);
    for (const std::string& line : scene::idle_effects(scene))
        text += fmt::format("  warning: {}\n", line);
    if (!scene.bodies.empty()) text += explain_structure(scene);
    if (scene.fluid) {
        text += scene.fluid->solver == scene::FluidSolver::lbm
                    ? explain_fluid(scene, fluid_ranks)
                    : explain_openfoam(scene);
    }
    if (scene.coupling) text += explain_coupling(scene);
    return text;
}

}  // namespace magfsi::launch
