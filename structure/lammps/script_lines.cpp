#include "structure/lammps/script_lines.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "structure/lammps/effect.h"
#include "structure/lammps/element_name.h"
#include "structure/lammps/lattice_file.h"
#include "structure/lammps/names.h"

namespace magfsi::structure {
namespace {

// Along the bodies' length, also where they start rolled up.
int longest_axis(const Assembly& all) {
    int longest = 0;
    for (int d = 1; d < 3; ++d) {
        if (all.high[d] - all.low[d] > all.high[longest] - all.low[longest]) longest = d;
    }
    return longest;
}

// Of the effects that look for nodes in each other's reach; 0 without one.
double neighbor_skin_m(const LammpsInput& input) {
    double skin_m = 0;
    for (const ScriptEffect* effect : asked_effects(input)) {
        if (effect->neighbor_skin_m)
            skin_m = std::max(skin_m, effect->neighbor_skin_m(input));
    }
    return skin_m;
}

std::string integrated_group(const LammpsInput& input) {
    for (const ScriptEffect* effect : asked_effects(input)) {
        if (effect->integrated_group) return effect->integrated_group;
    }
    return "all";
}

}  // namespace

// Boundaries are wrapped around the atoms at the start and then no more looked at: a body
// may travel anywhere. Ranks share the bodies along their longest extent, evenly by
// nodes.
void add_system(Lines& lines, const LammpsInput& input, const Assembly& all,
                const std::string& data_file) {
    const int axis = longest_axis(all);
    std::array<const char*, 3> ranks{"1", "1", "1"};
    ranks[axis] = "*";
    // Ghosts must reach across an element, even one that has been stretched by half.
    const double cutoff = 1.5 * all.longest_diagonal_m;
    const double skin_m = neighbor_skin_m(input);
    lines.insert(
        lines.end(),
        {"units si", "atom_style sphere", "atom_modify map array sort 0 0.0", "newton on",
         "boundary s s s",
         fmt::format("processors {} {} {}", ranks[0], ranks[1], ranks[2]),
         fmt::format("comm_modify mode single cutoff {:.6g} vel yes", cutoff),
         fmt::format("neighbor {:.6g} bin", skin_m > 0 ? skin_m : 0.1 * cutoff),
         skin_m > 0 ? "neigh_modify every 1 delay 0 check yes" : "neigh_modify once yes",
         fmt::format("read_data {}", quoted(data_file)),
         fmt::format("balance 1.0 shift {} 20 1.0", "xyz"[axis])});
}

void add_lattices(Lines& lines, LammpsScript& script, const LammpsInput& input,
                  const Assembly& all, const std::filesystem::path& folder) {
    const auto effects = asked_effects(input);
    for (std::size_t i = 0; i < input.bodies.size(); ++i) {
        const Body& body = input.bodies[i];
        const std::string file = (folder / (all.name[i] + ".lattice")).string();
        write_lattice_file({body.mesh.nodes, body.mesh.elements, body.magnetization_a_m,
                            body.element_material},
                           file);
        lines.push_back(fmt::format("group {} id {}:{}", all.name[i], all.first_node[i],
                                    all.first_node[i + 1] - 1));
        script.fix_id.push_back(fmt::format("magttice_{}", all.name[i]));
        std::string line = fmt::format(
            "fix {} {} magttice {} {} {:.17g} {:.17g} element {}", script.fix_id.back(),
            all.name[i], quoted(file), all.first_node[i], body.material.shear_modulus_pa,
            body.material.lame_lambda_pa, name_of(body.element));
        for (const ScriptEffect* effect : effects) {
            if (effect->body_words) line += effect->body_words(input, body);
        }
        for (const Material& other : body.other_materials) {
            line +=
                fmt::format(" material {:.17g} {:.17g} {:.17g}", other.shear_modulus_pa,
                            other.lame_lambda_pa, other.viscosity_pa_s);
        }
        lines.push_back(line);
    }
}

void add_effects(Lines& lines, const LammpsInput& input,
                 ScriptEffect::Commands ScriptEffect::*place) {
    for (const ScriptEffect* effect : asked_effects(input)) {
        if (effect->*place) (effect->*place)(lines, input);
    }
}

void add_integration(Lines& lines, const LammpsInput& input) {
    const std::string group = integrated_group(input);
    if (input.quiet) lines.push_back(fmt::format("fix quiet {} magttice/quiet", group));
    lines.push_back(fmt::format("fix integrate {} nve", group));
}

void add_settings(Lines& lines, const LammpsInput& input) {
    lines.push_back(fmt::format("timestep {:.17g}", input.time_step_s));
    lines.push_back("thermo_style custom step");
    lines.push_back("thermo 0");
}

}  // namespace magfsi::structure
