#include <fmt/format.h>

#include <algorithm>

#include "structure/lammps/effect.h"
#include "structure/lammps/effects/platform/platform_law.h"
#include "structure/body.h"

namespace magfsi::structure {

namespace {

double thickness_m(const Mesh& mesh) {
    Vec3 low = mesh.nodes.front();
    Vec3 high = low;
    for (const Vec3& x : mesh.nodes) {
        for (std::size_t d = 0; d < 3; ++d) {
            low[d] = std::min(low[d], x[d]);
            high[d] = std::max(high[d], x[d]);
        }
    }
    return std::min({high[0] - low[0], high[1] - low[1], high[2] - low[2]});
}

void add_platform(std::vector<std::string>& lines, const LammpsInput& input) {
    const Platform platform = platform_of(input);
    std::string line = "fix platform all magttice/platform";
    for (double value : platform.point_m) line += fmt::format(" {:.17g}", value);
    for (double value : platform.normal) line += fmt::format(" {:.17g}", value);
    line += fmt::format(" {:.17g}", platform.stiffness_pa_m);
    if (platform.friction > 0)
        line += fmt::format(" friction {:.17g}", platform.friction);
    if (platform.damping_pa_s_m > 0) {
        line += fmt::format(" damping {:.17g}", platform.damping_pa_s_m);
    }
    lines.push_back(line);
}

}  // namespace

Platform platform_of(const LammpsInput& input) {
    Platform platform = *input.platform;
    if (platform.stiffness_pa_m > 0) return platform;
    for (const Body& body : input.bodies) {
        for (const Material& material : used_materials(body)) {
            platform.stiffness_pa_m =
                std::max(platform.stiffness_pa_m,
                         platform_stiffness_pa_m(material, thickness_m(body.mesh)));
        }
    }
    return platform;
}

extern const ScriptEffect platform_effect{
    .name = "platform",
    .asked = [](const LammpsInput& input) { return input.platform.has_value(); },
    .commands = add_platform,
    .surface_spring_pa_m = [](const LammpsInput& input,
                              const Body&) { return platform_of(input).stiffness_pa_m; }};

}  // namespace magfsi::structure
