// SPDX-License-Identifier: GPL-2.0-or-later
#include "adapters/solvers/bodies/fluid_inside.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "structure/body.h"
#include "structure/lattice/lattice.h"

namespace magfsi::bodies {

namespace {

// Fraction of a cube that elements of this material stand for (filled_cubes.h), by which
// both the body's mass and that of the fluid in its place are scaled; 1 in other meshes.
double part_of(const scene::Body& body, const structure::Material& material) {
    return std::holds_alternative<structure::VoxelMesh>(body.mesh)
               ? material.density_kg_m3 / body.material.density_kg_m3
               : 1;
}

// Replaces the densities of a body so that its masses are those of the fluid in its
// place.
void fill_with(structure::Body& solid, const scene::Body& body, double density_kg_m3) {
    for (structure::Material& other : solid.other_materials)
        other.density_kg_m3 = part_of(body, other) * density_kg_m3;
    solid.material.density_kg_m3 = density_kg_m3;
}

// Appends the lumped masses of the body's nodes [kg].
void add_masses(std::vector<double>& all, const structure::Body& body) {
    const auto masses = structure::build_lattice(body).node_mass_kg;
    all.insert(all.end(), masses.begin(), masses.end());
}

}  // namespace

double off_nodes_kg_m3(const scene::Scene& scene, const structure::Body& body) {
    if (!scene.fluid || has_drag(scene)) return 0;
    double lightest = std::numeric_limits<double>::infinity();
    const auto& from = *std::ranges::find(scene.bodies, body.name, &scene::Body::name);
    for (const structure::Material& material : structure::used_materials(body))
        lightest = std::min(lightest, material.density_kg_m3 / part_of(from, material));
    return std::min(scene.fluid->density_kg_m3, largest_part_off_nodes * lightest);
}

Solids bodies_in_fluid(const scene::Scene& scene, Solids solids) {
    for (std::size_t b = 0; b < solids.size(); ++b) {
        const double off = off_nodes_kg_m3(scene, solids[b]);
        for (structure::Material& other : solids[b].other_materials)
            other.density_kg_m3 -= off * part_of(scene.bodies[b], other);
        solids[b].material.density_kg_m3 -= off;
    }
    return solids;
}

std::vector<double> whole_masses_kg(const Solids& solids) {
    std::vector<double> all;
    for (const structure::Body& solid : solids) add_masses(all, solid);
    return all;
}

Solids bodies_of_fluid(const scene::Scene& scene, Solids solids) {
    for (std::size_t b = 0; b < solids.size(); ++b)
        fill_with(solids[b], scene.bodies[b], scene.fluid->density_kg_m3);
    return solids;
}

std::vector<double> inside_masses_kg(const scene::Scene& scene, Solids solids) {
    return whole_masses_kg(bodies_of_fluid(scene, std::move(solids)));
}

}  // namespace magfsi::bodies
