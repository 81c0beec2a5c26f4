// SPDX-License-Identifier: GPL-2.0-or-later
#include "structure/lammps/step_limit.h"

#include <algorithm>
#include <cmath>

#include "structure/lattice/lattice.h"
#include "structure/lattice/stable_step.h"
#include "structure/mesh/surface.h"

namespace magfsi::structure {

double step_limit_s(const Body& body, double stiffness_pa_m) {
    const double own = stable_step_s(body);
    const double frequency = 2 / stable_elastic_step_s(body);
    // From the definition of the body's own step.
    const double damping = 2 / own - 0.5 * own * frequency * frequency;
    const auto area = surface_areas(body.mesh.nodes, body.mesh.elements);
    const auto mass = build_lattice(body).node_mass_kg;
    double largest = 0;
    for (std::size_t a = 0; a < area.size(); ++a) {
        largest = std::max(largest, stiffness_pa_m * area[a] / mass[a]);
    }
    const double squared = frequency * frequency + largest;
    return 4 / (std::sqrt(damping * damping + 4 * squared) + damping);
}

}  // namespace magfsi::structure
