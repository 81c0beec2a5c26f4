#include "structure/lammps/script_assembly.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "structure/lammps/names.h"
#include "structure/lattice/lattice.h"
#include "structure/body.h"

namespace magfsi::structure {
namespace {

double longest_diagonal(const std::vector<Vec3>& nodes, const Body& body) {
    double longest = 0;
    for (const Hexahedron& element : body.mesh.elements) {
        for (int a = 0; a < 4; ++a) {
            const Vec3& x = nodes[element[a]];
            const Vec3& y = nodes[element[7 - a]];
            longest =
                std::max(longest, std::hypot(x[0] - y[0], x[1] - y[1], x[2] - y[2]));
        }
    }
    return longest;
}

void add_body(Assembly& all, const Body& body, const std::vector<Vec3>& nodes) {
    all.first_node.push_back(static_cast<int>(all.atoms.size()) + 1);
    const auto masses = build_lattice(body).node_mass_kg;
    for (std::size_t a = 0; a < nodes.size(); ++a) {
        all.atoms.push_back({nodes[a], masses[a]});
    }
    all.longest_diagonal_m =
        std::max(all.longest_diagonal_m, longest_diagonal(nodes, body));
}

void add_bounds(Assembly& all, const std::vector<Vec3>& nodes) {
    for (const Vec3& x : nodes) {
        for (int d = 0; d < 3; ++d) {
            all.low[d] = std::min(all.low[d], x[d]);
            all.high[d] = std::max(all.high[d], x[d]);
        }
    }
}

}  // namespace

void check_input(const LammpsInput& input) {
    if (input.bodies.empty()) throw std::invalid_argument("no body found, one is needed");
    if (!input.placements.empty() && input.placements.size() != input.bodies.size()) {
        throw std::invalid_argument(fmt::format(
            "{} placements for {} bodies found, one a body or none is allowed",
            input.placements.size(), input.bodies.size()));
    }
    if (!(input.time_step_s > 0)) {
        throw std::invalid_argument(fmt::format(
            "time step of {:g} s found, it must be positive", input.time_step_s));
    }
    for (const Body& body : input.bodies) {
        check_materials(body.element_material, body.mesh.elements.size(),
                        body.other_materials.size());
        for (const Material& material : used_materials(body)) {
            if (material.density_kg_m3 > 0) continue;
            throw std::invalid_argument(fmt::format(
                "body {} has an effective density of {:g} kg/m3, it must be positive",
                body.name, material.density_kg_m3));
        }
    }
}

Assembly assemble(const LammpsInput& input) {
    Assembly all;
    all.low = {INFINITY, INFINITY, INFINITY};
    all.high = {-INFINITY, -INFINITY, -INFINITY};
    all.name = lammps_names(input.bodies, input.motions.size());
    const std::array<int, 2> plane =
        input.field ? input.field->plane : std::array<int, 2>{0, 2};
    for (std::size_t i = 0; i < input.bodies.size(); ++i) {
        Placement placement =
            input.placements.empty() ? Placement{} : input.placements[i];
        add_body(all, input.bodies[i], placed_nodes(input.bodies[i], placement, plane));
        placement.relaxed.reset();
        add_bounds(all, placed_nodes(input.bodies[i], placement, plane));
    }
    all.first_node.push_back(static_cast<int>(all.atoms.size()) + 1);
    return all;
}

}  // namespace magfsi::structure
