#include "adapters/scene/effective.h"
#include "adapters/scene/names.h"

#include <cmath>

#include "adapters/scene/json_writer.h"

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
    // What a run does when it diverges changes no state before that.
    if (endless.checkpoint) endless.checkpoint = Checkpoint{endless.checkpoint->every_s};
    return scene_hash(endless);
}

double path_step_s(const Scene& scene) {
    return scene.probes ? scene.probes->every_s : scene.time.end_s;
}

double halved(const Scene& scene, double step_s) {
    return std::ldexp(step_s, -scene.time.halvings);
}

std::optional<double> coupled_step_s(const Scene& scene) {
    if (scene.time.step_s) return halved(scene, *scene.time.step_s);
    if (!scene.fluid || !(scene.fluid->expected_speed_m_s > 0)) return std::nullopt;
    const Fluid& fluid = *scene.fluid;
    const double cells_a_step =
        fluid.solver == FluidSolver::openfoam ? fluid.courant : fluid.lattice_speed;
    return halved(scene, cells_a_step * fluid.spacing_m / fluid.expected_speed_m_s);
}

std::optional<double> relaxation_time(const Scene& scene) {
    const auto dt_s = coupled_step_s(scene);
    if (!dt_s || !scene.fluid || scene.fluid->solver != FluidSolver::lbm) return {};
    const double dx = scene.fluid->spacing_m;
    return 3 * scene.fluid->viscosity_m2_s * *dt_s / (dx * dx) + 0.5;
}

}  // namespace magfsi::scene
