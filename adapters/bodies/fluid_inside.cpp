// SPDX-License-Identifier: GPL-2.0-or-later
#include "adapters/bodies/fluid_inside.h"

#include <algorithm>
#include <limits>

#include "adapters/bodies/scene_to_body.h"
#include "structure/body.h"
#include "structure/lattice/lattice.h"

namespace magfsi::bodies {

namespace {

// The nodes keep a third of their mass: their stable step is that of a body of a third of
// the density, at least 0.58 of their own.
constexpr double largest_part = 2.0 / 3;

void add_masses(std::vector<double>& all, const structure::Body& body) {
    const auto masses = structure::build_lattice(body).node_mass_kg;
    all.insert(all.end(), masses.begin(), masses.end());
}

}  // namespace

double off_nodes_kg_m3(const scene::Scene& scene, const structure::Body& body) {
    if (!scene.fluid || scene.damping) return 0;
    double lightest = std::numeric_limits<double>::infinity();
    for (const structure::Material& material : structure::used_materials(body))
        lightest = std::min(lightest, material.density_kg_m3);
    return std::min(scene.fluid->density_kg_m3, largest_part * lightest);
}

std::vector<structure::Body> bodies_in_fluid(const scene::Scene& scene) {
    std::vector<structure::Body> all;
    for (const scene::Body& body : scene.bodies) {
        structure::Body& solid = all.emplace_back(to_body(body));
        const double off = off_nodes_kg_m3(scene, solid);
        solid.material.density_kg_m3 -= off;
        for (structure::Material& other : solid.other_materials)
            other.density_kg_m3 -= off;
    }
    return all;
}

std::vector<double> whole_masses_kg(const scene::Scene& scene) {
    std::vector<double> all;
    for (const scene::Body& body : scene.bodies) add_masses(all, to_body(body));
    return all;
}

std::vector<double> inside_masses_kg(const scene::Scene& scene) {
    std::vector<double> all;
    for (const scene::Body& body : scene.bodies) {
        structure::Body solid = to_body(body);
        solid.material.density_kg_m3 = scene.fluid->density_kg_m3;
        for (structure::Material& other : solid.other_materials)
            other.density_kg_m3 = scene.fluid->density_kg_m3;
        add_masses(all, solid);
    }
    return all;
}

}  // namespace magfsi::bodies
