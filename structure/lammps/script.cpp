#include "structure/lammps/script.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "structure/lammps/data_file.h"
#include "structure/lammps/lattice_file.h"
#include "structure/lammps/names.h"
#include "structure/lattice/lattice.h"

namespace magfsi::structure {
namespace {

// What the writers below share.
struct Assembly {
    std::vector<DataAtom> atoms;
    Vec3 low{INFINITY, INFINITY, INFINITY};  // bounds of the bodies before relaxing
    Vec3 high{-INFINITY, -INFINITY, -INFINITY};
    std::vector<int> first_node;
    std::vector<std::string> name;  // fit for LAMMPS IDs and file names
    std::vector<int> clamped_ids;
    double longest_diagonal_m = 0;
};

void check(const LammpsInput& input) {
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
        if (!(body.material.density_kg_m3 > 0)) {
            throw std::invalid_argument(fmt::format(
                "body {} has an effective density of {:g} kg/m3, it must be positive",
                body.name, body.material.density_kg_m3));
        }
    }
}

std::vector<int> clamped_nodes(const Body& body) {
    std::vector<int> out;
    for (const std::string& face : body.clamps) {
        const auto found = body.mesh.faces.find(face);
        if (found == body.mesh.faces.end()) {
            throw std::invalid_argument(fmt::format(
                "body {} is clamped at {}, a face that its mesh lacks", body.name, face));
        }
        out.insert(out.end(), found->second.begin(), found->second.end());
    }
    std::ranges::sort(out);
    const auto repeated = std::ranges::unique(out);
    out.erase(repeated.begin(), repeated.end());
    return out;
}

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
    const int first = static_cast<int>(all.atoms.size()) + 1;
    all.first_node.push_back(first);
    const auto masses = node_masses(
        build_lattice(body.mesh.nodes, body.mesh.elements, body.material, body.element));
    for (std::size_t a = 0; a < nodes.size(); ++a) {
        all.atoms.push_back({nodes[a], masses[a]});
    }
    for (int node : clamped_nodes(body)) all.clamped_ids.push_back(first + node);
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

Assembly assemble(const LammpsInput& input) {
    Assembly all;
    all.name = lammps_names(input.bodies);
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

// Along the bodies' length, also where they start rolled up.
int longest_axis(const Assembly& all) {
    int longest = 0;
    for (int d = 1; d < 3; ++d) {
        if (all.high[d] - all.low[d] > all.high[longest] - all.low[longest]) longest = d;
    }
    return longest;
}

// Boundaries are wrapped around the atoms at the start and then no more looked at: a body
// may travel anywhere. Ranks share the bodies along their longest extent, evenly by
// nodes.
void add_system(std::vector<std::string>& lines, const Assembly& all,
                const std::string& data_file) {
    const int axis = longest_axis(all);
    std::array<const char*, 3> ranks{"1", "1", "1"};
    ranks[axis] = "*";
    // Ghosts must reach across an element, even one that has been stretched by half.
    const double cutoff = 1.5 * all.longest_diagonal_m;
    lines.insert(lines.end(),
                 {"units si", "atom_style sphere", "atom_modify map array sort 0 0.0",
                  "newton on", "boundary s s s",
                  fmt::format("processors {} {} {}", ranks[0], ranks[1], ranks[2]),
                  fmt::format("comm_modify mode single cutoff {:.6g} vel yes", cutoff),
                  fmt::format("neighbor {:.6g} bin", 0.1 * cutoff),
                  "neigh_modify once yes", fmt::format("read_data {}", quoted(data_file)),
                  fmt::format("balance 1.0 shift {} 20 1.0", "xyz"[axis])});
}

// Variables, so that a script can put its own course in their place.
void add_field(std::vector<std::string>& lines, const FieldProgram& field) {
    lines.push_back(
        fmt::format("fix field all magttice/field {}", field_arguments(field)));
    for (int d = 0; d < 3; ++d) {
        lines.push_back(fmt::format("variable B{} equal f_field[{}]", "xyz"[d], d + 1));
    }
}

void add_lattices(std::vector<std::string>& lines, LammpsScript& script,
                  const LammpsInput& input, const Assembly& all,
                  const std::filesystem::path& folder) {
    for (std::size_t i = 0; i < input.bodies.size(); ++i) {
        const Body& body = input.bodies[i];
        const std::string file = (folder / (all.name[i] + ".lattice")).string();
        write_lattice_file({body.mesh.nodes, body.mesh.elements, body.magnetization_a_m},
                           file);
        lines.push_back(fmt::format("group {} id {}:{}", all.name[i], all.first_node[i],
                                    all.first_node[i + 1] - 1));
        script.fix_id.push_back(fmt::format("magttice_{}", all.name[i]));
        const bool magnetic = input.field && !body.magnetization_a_m.empty();
        lines.push_back(fmt::format(
            "fix {} {} magttice {} {} {:.17g} {:.17g} element {}{}", script.fix_id.back(),
            all.name[i], quoted(file), all.first_node[i], body.material.shear_modulus_pa,
            body.material.lame_lambda_pa,
            body.element == ElementVariant::full ? "full" : "mean_f",
            magnetic ? " field v_Bx v_By v_Bz" : ""));
    }
}

void add_loads(std::vector<std::string>& lines, const LammpsInput& input) {
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

// Clamped nodes are left out of the integration: they cannot move, and the force on them
// stays readable as the reaction.
void add_integration(std::vector<std::string>& lines, const LammpsInput& input,
                     const Assembly& all) {
    const char* moving = "all";
    if (!all.clamped_ids.empty()) {
        lines.push_back(fmt::format("group clamped id {}", id_ranges(all.clamped_ids)));
        lines.push_back("group moving subtract all clamped");
        moving = "moving";
    }
    lines.push_back(fmt::format("fix integrate {} nve", moving));
    lines.push_back(fmt::format("timestep {:.17g}", input.time_step_s));
    lines.push_back("thermo_style custom step");
    lines.push_back("thermo 0");
}

}  // namespace

LammpsScript write_lammps_input(const LammpsInput& input,
                                const std::filesystem::path& folder) {
    check(input);
    const Assembly all = assemble(input);
    const std::string data_file = (folder / "bodies.data").string();
    write_data_file(all.atoms, data_file);
    LammpsScript script;
    script.first_node = all.first_node;
    add_system(script.setup, all, data_file);
    if (input.field) {
        add_field(script.setup, *input.field);
    }
    add_lattices(script.setup, script, input, all, folder);
    add_loads(script.setup, input);
    add_integration(script.setup, input, all);
    return script;
}

}  // namespace magfsi::structure
