#include <fmt/format.h>

#include "adapters/magfsi/cost/prediction.h"
#include "adapters/magfsi/explain.h"
#include "adapters/scene/effective.h"

namespace magfsi::launch {

nlohmann::ordered_json facts(const scene::Scene& scene, const Ranks& ranks) {
    nlohmann::ordered_json out;
    out["name"] = scene.name;
    out["scene_hash"] = fmt::format("{:016x}", scene.hash);
    out["version"] = MAGFSI_VERSION;
    out["machine"] = machine();
    out["ranks"] = ranks;
    if (scene.fluid) {
        out["fluid"] = {{"spacing_m", scene.fluid->spacing_m},
                        {"step_s", *scene::coupled_step_s(scene)}};
    }
    if (const auto cost = prediction(scene, ranks)) out["predicted"] = to_json(*cost);
    return out;
}

}  // namespace magfsi::launch
