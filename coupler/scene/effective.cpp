#include "coupler/scene/effective.h"

#include "coupler/scene/json_writer.h"

namespace magfsi::scene {

nlohmann::ordered_json effective_scene(const Scene& scene) {
    Scene copy = scene;  // bind.h serves reading too, hence wants mutable references
    JsonWriter writer;
    bind_keys(writer, copy);
    return writer.take();
}

std::uint64_t scene_hash(const Scene& scene) {
    // nlohmann::json sorts the keys, ordered_json does not.
    const std::string text = nlohmann::json(effective_scene(scene)).dump();
    std::uint64_t hash = 14695981039346656037ULL;
    for (const char c : text) {
        hash ^= static_cast<unsigned char>(c);
        hash *= 1099511628211ULL;
    }
    return hash;
}

std::uint64_t state_hash(const Scene& scene) {
    Scene endless = scene;
    endless.time.end_s = 0;
    return scene_hash(endless);
}

double path_step_s(const Scene& scene) {
    return scene.probes ? scene.probes->every_s : scene.time.end_s;
}

std::optional<double> coupled_step_s(const Scene& scene) {
    if (scene.time.step_s) return scene.time.step_s;
    if (!scene.fluid || !(scene.fluid->expected_speed_m_s > 0)) return std::nullopt;
    const Fluid& fluid = *scene.fluid;
    const double cells_a_step =
        fluid.solver == FluidSolver::openfoam ? fluid.courant : fluid.lattice_speed;
    return cells_a_step * fluid.spacing_m / fluid.expected_speed_m_s;
}

}  // namespace magfsi::scene
