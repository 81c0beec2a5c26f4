// SPDX-License-Identifier: GPL-2.0-or-later
// Sides of the fluid's box that push the surfaces of bodies back: smooth planes, each
// with the fix of the platform.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "structure/lammps/effect.h"
#include "structure/lammps/names.h"
#include "structure/mesh/body_points.h"
#include "structure/platform.h"

namespace magfsi::structure {
namespace {

// That of a platform under a column of one element, for a wall may be met by a
// corner or the pole of a ball: (lambda + 2 G) / (2 h), h the mean size of an element;
// the largest of the bodies.
double stiffness_pa_m(const LammpsInput& input) {
    double largest = 0;
    for (const Body& body : input.bodies) {
        const double size_m = std::cbrt(volume_m3(body.mesh) /
                                        static_cast<double>(body.mesh.elements.size()));
        for (const Material& material : used_materials(body))
            largest = std::max(largest, platform_stiffness_pa_m(material, size_m));
    }
    return largest;
}

void add_walls(Lines& lines, const LammpsInput& input) {
    const std::vector<std::string> bodies =
        lammps_names(input.bodies, input.motions.size());
    for (const Wall& wall : input.walls) {
        std::string group = "all";
        if (wall.bodies.size() < bodies.size()) {
            group = "touch_" + wall.name;
            std::string line = fmt::format("group {} union", group);
            for (const std::size_t b : wall.bodies) line += " " + bodies[b];
            lines.push_back(line);
        }
        const Platform& plane = wall.plane;
        lines.push_back(
            fmt::format("fix wall_{} {} magttice/platform {:.17g} {:.17g} {:.17g}",
                        wall.name, group, fmt::join(plane.point_m, " "),
                        fmt::join(plane.normal, " "), stiffness_pa_m(input)));
        const double friction = input.contact ? input.contact->friction : 0;
        if (friction > 0) lines.back() += fmt::format(" friction {:.17g}", friction);
    }
}

}  // namespace

// A node in a corner touches several, each along its own axis.
extern const Effect walls_effect{
    .name = "walls",
    .asked = [](const LammpsInput& input) { return !input.walls.empty(); },
    .commands = add_walls,
    .surface_spring_pa_m = [](const LammpsInput& input,
                              const Body&) { return stiffness_pa_m(input); }};

}  // namespace magfsi::structure
