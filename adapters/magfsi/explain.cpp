#include "adapters/magfsi/explain.h"

#include <fmt/format.h>

#include "adapters/magfsi/explain_parts.h"
#include "coupler/scene/effective.h"

namespace magfsi::launch {

namespace {

std::string join(const std::vector<std::string>& words) {
    return words.empty() ? "none" : fmt::format("{}", fmt::join(words, ", "));
}

}  // namespace

std::string explain(const scene::Scene& scene) {
    std::string text = fmt::format(
        "scene '{}'\n  active, in step order: {}\n  absent: {}\n", scene.name,
        join(scene::active_effects(scene)), join(scene::absent_effects(scene)));
    if (!scene.bodies.empty()) text += explain_structure(scene);
    if (scene.fluid) {
        text += scene.fluid->solver == scene::FluidSolver::lbm ? explain_fluid(scene)
                                                               : explain_openfoam(scene);
    }
    if (scene.coupling) text += explain_coupling(scene);
    return text;
}

}  // namespace magfsi::launch
