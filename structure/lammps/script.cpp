// SPDX-License-Identifier: GPL-2.0-or-later
#include "structure/lammps/script.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "structure/body.h"
#include "structure/lammps/effect.h"
#include "structure/lammps/lattice_file.h"
#include "structure/lammps/names.h"
#include "structure/refuse.h"

namespace magfsi::structure {
namespace {

// Nodes of all bodies, numbered one body after the other.
struct Assembly {
    std::vector<DataAtom> atoms;
    Bounds bounds;  // bounds of the bodies at their places, but not relaxed
    std::vector<int> first_node;
    std::vector<std::string> name;  // unique, fit for LAMMPS IDs and file names
    double longest_diagonal_m = 0;  // largest of all elements at the start
};

void check_input(const LammpsInput& input) {
    if (input.bodies.empty()) refuse("no body found, one is needed");
    if (!input.placements.empty() && input.placements.size() != input.bodies.size()) {
        refuse("{} placements for {} bodies found, one per body or none is allowed",
               input.placements.size(), input.bodies.size());
    }
    if (!(input.time_step_s > 0)) {
        refuse("time step of {:g} s found, it must be positive", input.time_step_s);
    }
    for (const Body& body : input.bodies) {
        check_materials(body.element_material, body.mesh.elements.size(),
                        body.other_materials.size());
        for (const Material& material : used_materials(body)) {
            if (material.density_kg_m3 > 0) continue;
            refuse(
                "body {} has an effective density of {:g} kg/m3, it must be positive: "
                "take a larger density of the material",
                body.name, material.density_kg_m3);
        }
    }
}

double longest_diagonal(const std::vector<Vec3>& nodes, const Body& body) {
    double longest = 0;
    for (const Hexahedron& element : body.mesh.elements) {
        for (int a = 0; a < 4; ++a) {
            longest =
                std::max(longest, distance_m(nodes[element[a]], nodes[element[7 - a]]));
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

Assembly assemble(const LammpsInput& input) {
    Assembly all;
    all.name = lammps_names(input.bodies, input.motions.size());
    const std::array<int, 2> plane =
        input.field ? input.field->plane : std::array<int, 2>{0, 2};
    for (std::size_t i = 0; i < input.bodies.size(); ++i) {
        Placement placement =
            input.placements.empty() ? Placement{} : input.placements[i];
        add_body(all, input.bodies[i], placed_nodes(input.bodies[i], placement, plane));
        placement.relaxed.reset();
        for (const Vec3& x : placed_nodes(input.bodies[i], placement, plane))
            all.bounds.add(x);
    }
    all.first_node.push_back(static_cast<int>(all.atoms.size()) + 1);
    return all;
}

// Commands up to the atoms. Boundaries are wrapped around the atoms at the start and not
// used later, so that a body may travel anywhere. Ranks share the bodies in slices along
// their longest extent, with equal numbers of nodes.
void add_system(Lines& lines, const Assembly& all, const std::string& data_file) {
    // Bounds before relaxing: slices along a body's length are best even if it starts
    // rolled up.
    const Vec3 extent_m = all.bounds.extent_m();
    const auto axis = std::ranges::max_element(extent_m) - extent_m.begin();
    std::array<const char*, 3> ranks{"1", "1", "1"};
    ranks[axis] = "*";
    // Ghost atoms must reach across an element that is stretched by half.
    const double cutoff = 1.5 * all.longest_diagonal_m;
    lines.insert(
        lines.end(),
        {"units si", "atom_style sphere", "atom_modify map array sort 0 0.0", "newton on",
         "boundary s s s",
         fmt::format("processors {} {} {}", ranks[0], ranks[1], ranks[2]),
         fmt::format("comm_modify mode single cutoff {:.6g} vel yes", cutoff),
         fmt::format("neighbor {:.6g} bin", 0.1 * cutoff), "neigh_modify once yes",
         fmt::format("read_data {}", data_in_script(data_file)),
         fmt::format("balance 1.0 shift {} 20 1.0", "xyz"[axis])});
}

// Writes the lattice files, adds each body's group and fix magttice, and fills fix_id.
void add_lattices(LammpsScript& script, const LammpsInput& input, const Assembly& all,
                  const std::filesystem::path& folder) {
    for (std::size_t i = 0; i < input.bodies.size(); ++i) {
        const Body& body = input.bodies[i];
        const std::string file = (folder / (all.name[i] + ".lattice")).string();
        write_lattice_file({body.mesh.nodes, body.mesh.elements, body.magnetization_a_m,
                            body.element_material, body.element_rigid},
                           file);
        script.setup.push_back(fmt::format("group {} id {}:{}", all.name[i],
                                           all.first_node[i], all.first_node[i + 1] - 1));
        script.fix_id.push_back("magttice_" + all.name[i]);
        std::string line =
            fmt::format("fix {} {} magttice {} {} {:.17g} {:.17g} element {}",
                        script.fix_id.back(), all.name[i], path_in_script(file),
                        all.first_node[i], body.material.shear_modulus_pa,
                        body.material.lame_lambda_pa, name_of(body.element));
        for (const Effect* effect : asked_effects(input)) {
            if (effect->body_words) line += effect->body_words(input, body);
        }
        for (const Material& other : body.other_materials) {
            line +=
                fmt::format(" material {:.17g} {:.17g} {:.17g}", other.shear_modulus_pa,
                            other.lame_lambda_pa, other.viscosity_pa_s);
        }
        script.setup.push_back(line);
    }
}

// Adds the commands that the asked effects have for one place in the script.
void add_effects(Lines& lines, const LammpsInput& input,
                 Effect::Commands Effect::*place) {
    for (const Effect* effect : asked_effects(input)) {
        if (effect->*place) (effect->*place)(lines, input);
    }
}

// Adds the commands between bodies and integration. The group of the integration follows
// the last effect that makes a group of nodes which are left out of it.
void add_commands(Lines& lines, const LammpsInput& input) {
    std::string left_out;
    const auto asked = asked_effects(input);
    const auto leaves_out = [](const Effect* effect) {
        return effect->group_left_out != nullptr;
    };
    std::size_t to_come = std::ranges::count_if(asked, leaves_out);
    for (const Effect* effect : asked) {
        if (effect->commands) effect->commands(lines, input);
        if (!leaves_out(effect)) continue;
        left_out += std::string(" ") + effect->group_left_out;
        if (--to_come == 0)
            lines.push_back(fmt::format("group {} subtract all{}",
                                        integrated_group(input), left_out));
    }
}

}  // namespace

LammpsScript write_lammps_input(const LammpsInput& input,
                                const std::filesystem::path& folder) {
    check_input(input);
    check_effects(input);
    const Assembly all = assemble(input);
    const std::string data_file = (folder / "bodies.data").string();
    write_data_file(all.atoms, data_file);
    LammpsScript script;
    script.first_node = all.first_node;
    Lines& lines = script.setup;
    add_system(lines, all, data_file);
    add_effects(lines, input, &Effect::before_bodies);
    add_lattices(script, input, all, folder);
    add_commands(lines, input);
    lines.push_back(fmt::format("fix integrate {} nve", integrated_group(input)));
    add_effects(lines, input, &Effect::after_integration);
    lines.insert(lines.end(), {fmt::format("timestep {:.17g}", input.time_step_s),
                               "thermo_style custom step", "thermo 0"});
    return script;
}

std::string text_of(const LammpsScript& script) {
    std::string text;
    for (const std::string& line : script.setup) {
        text += line.starts_with("read_data /proc/") ? "read_data bodies.data" : line;
        text += '\n';
    }
    return text;
}

}  // namespace magfsi::structure
