#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "structure/lammps/script_lines.h"
#include "structure/materials.h"

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

ContactLaw contact_law(const LammpsInput& input) {
    ContactLaw law = *input.contact;
    if (!(law.distance_m > 0)) law.distance_m = contact_distance_m(input.bodies);
    if (!(law.stiffness_pa_m > 0)) {
        law.stiffness_pa_m = contact_stiffness_pa_m(input.bodies, law.distance_m);
    }
    return law;
}

void add_contact(Lines& lines, const LammpsInput& input) {
    if (!input.contact) return;
    const ContactLaw law = contact_law(input);
    lines.push_back(
        fmt::format("pair_style magttice/contact {:.17g} {:.17g} excluded {:.17g}",
                    law.distance_m, law.stiffness_pa_m, law.excluded));
    lines.push_back("pair_coeff * *");
    lines.push_back("compute contact all magttice/contact");
}

void add_platform(Lines& lines, const LammpsInput& input) {
    if (!input.platform) return;
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

void add_loads(Lines& lines, const LammpsInput& input) {
    if (input.gravity_m_s2) {
        const auto& [gx, gy, gz] = *input.gravity_m_s2;
        const double magnitude = std::hypot(gx, gy, gz);
        if (magnitude > 0) {
            lines.push_back(fmt::format(
                "fix gravity all gravity {:.17g} vector {:.17g} {:.17g} {:.17g}",
                magnitude, gx, gy, gz));
        }
    }
    if (input.drag_rate_1_s) {
        lines.push_back(
            fmt::format("fix drag all magttice/drag {:.17g}", *input.drag_rate_1_s));
    }
}

}  // namespace magfsi::structure
