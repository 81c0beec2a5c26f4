#include <fmt/format.h>

#include "adapters/magfsi/cost/prediction.h"

namespace magfsi::launch {

namespace {

std::string duration(double seconds) {
    if (seconds < 120) return fmt::format("{:.2g} s", seconds);
    if (seconds < 7200) return fmt::format("{:.2g} min", seconds / 60);
    return fmt::format("{:.2g} h", seconds / 3600);
}

std::string time_line(const Prediction& p, bool path) {
    if (!p.wall_s)
        return "unknown: damped motion takes as many steps as it needs to come to rest";
    std::string text = duration(*p.wall_s);
    if (path) {
        text +=
            " if Newton's method meets no instability on the path, several times "
            "that if it does";
    }
    if (p.exchange_s) {
        text += fmt::format(" (structure {}, fluid {}, messages {})",
                            duration(*p.structure_s), duration(*p.fluid_s),
                            duration(*p.exchange_s));
    }
    return text;
}

}  // namespace

nlohmann::ordered_json to_json(const Prediction& p) {
    nlohmann::ordered_json out;
    out["wall_s"] = p.wall_s ? nlohmann::ordered_json(*p.wall_s) : nullptr;
    if (p.structure_bytes > 0) out["memory_bytes"]["structure"] = p.structure_bytes;
    if (p.fluid_bytes > 0) out["memory_bytes"]["fluid"] = p.fluid_bytes;
    out["disk_bytes"] = p.disk_bytes;
    return out;
}

std::string explain_cost(const scene::Scene& scene, const Ranks& ranks) {
    std::string text = fmt::format("\ncost on ranks {}\n", to_text(ranks));
    if (scene.fluid && scene.fluid->solver == scene::FluidSolver::openfoam)
        return text + "  not predicted with fluid.solver openfoam\n";
    const auto calibration = read_calibration();
    if (!calibration) {
        return text +
               "  not known: this machine is not calibrated; ./magfsi bench "
               "--calibrate does it in half a minute\n";
    }
    const Prediction p = *prediction(scene, ranks);
    text += fmt::format("  time    {}\n",
                        time_line(p, scene.time.equilibrium.has_value()));
    if (const auto faster = faster_ranks(scene, ranks)) {
        text += fmt::format("  faster  with --ranks {}: {}\n", to_text(faster->first),
                            duration(*faster->second.wall_s));
    }
    text +=
        fmt::format("  memory  {:.3g} MB\n", (p.structure_bytes + p.fluid_bytes) / 1e6);
    text += fmt::format("  disk    {:.3g} MB\n", p.disk_bytes / 1e6);
    return text + fmt::format("  as calibrated on {}, {}\n", calibration->machine,
                              calibration->date);
}

}  // namespace magfsi::launch
