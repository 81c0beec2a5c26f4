// SPDX-License-Identifier: GPL-2.0-or-later
#include "structure/lammps/lattice_file.h"

#include <fmt/ranges.h>

#include <algorithm>
#include <sstream>
#include <string>

#include "structure/mesh/mesh_file.h"
#include "structure/refuse.h"

namespace magfsi::structure {

void write_lattice_file(const LatticeFile& lattice, const std::filesystem::path& file) {
    write_text_file("lattice file", file, [&](fmt::ostream& out) {
        out.print("# magttice lattice [m, A/m]\n");
        write_nodes(out, lattice.nodes_m);
        out.print("elements {}\n", lattice.elements.size());
        for (std::size_t e = 0; e < lattice.elements.size(); ++e) {
            const Vec3 m =
                lattice.magnetization_a_m.empty() ? Vec3{} : lattice.magnetization_a_m[e];
            out.print("{} {:.17g}", fmt::join(lattice.elements[e], " "),
                      fmt::join(m, " "));
            const bool rigid = !lattice.element_rigid.empty();
            if (!lattice.element_material.empty())
                out.print(" {}", lattice.element_material[e]);
            else if (rigid)
                out.print(" 0");
            if (rigid) out.print(" {}", lattice.element_rigid[e]);
            out.print("\n");
        }
    });
}

LatticeFile read_lattice_file(const std::filesystem::path& file) {
    NumberedLines lines("lattice file", file);
    LatticeFile out;
    out.nodes_m = lines.nodes(1);
    out.elements.resize(lines.count("elements", 1));
    out.magnetization_a_m.resize(out.elements.size());
    out.element_material.resize(out.elements.size());
    out.element_rigid.assign(out.elements.size(), -1);
    for (std::size_t e = 0; e < out.elements.size(); ++e) {
        const char* expected =
            "eight node numbers and the magnetisation of an element, and perhaps the "
            "number of its material, and then of its rigid part";
        std::istringstream fields = lines.next(expected);
        for (int& node : out.elements[e]) fields >> node;
        Vec3& m = out.magnetization_a_m[e];
        if (!(fields >> m[0] >> m[1] >> m[2])) lines.fail(expected);
        int& material = out.element_material[e];
        if (!(fields >> std::ws).eof() && (!(fields >> material) || material < 0)) {
            lines.fail(expected);
        }
        int& part = out.element_rigid[e];
        if (!(fields >> std::ws).eof() && (!(fields >> part) || part < -1)) {
            lines.fail(expected);
        }
    }
    if (std::ranges::all_of(out.element_rigid, [](int part) { return part == -1; })) {
        out.element_rigid.clear();
    }
    if (std::ranges::all_of(out.element_material, [](int m) { return m == 0; })) {
        out.element_material.clear();
    }
    return out;
}

void write_data_file(const std::vector<DataAtom>& atoms,
                     const std::filesystem::path& file) {
    Bounds box;
    for (const DataAtom& atom : atoms) box.add(atom.position_m);
    // The margin keeps atoms off the bounds; a shrink-wrapped boundary replaces these.
    const double margin = 0.01 * std::ranges::max(box.extent_m());
    write_text_file("data file", file, [&](fmt::ostream& out) {
        out.print("Nodes of all bodies, SI\n\n{} atoms\n1 atom types\n\n", atoms.size());
        for (std::size_t d = 0; d < 3; ++d) {
            out.print("{:.17g} {:.17g} {}lo {}hi\n", box.low_m[d] - margin,
                      box.high_m[d] + margin, "xyz"[d], "xyz"[d]);
        }
        out.print("\nAtoms # sphere: id type diameter mass x y z\n\n");
        for (std::size_t i = 0; i < atoms.size(); ++i) {
            out.print("{} 1 0 {:.17g} {:.17g}\n", i + 1, atoms[i].mass_kg,
                      fmt::join(atoms[i].position_m, " "));
        }
    });
}

ElementVariant parse_element_name(const std::string& word) {
    constexpr auto words = words_of(ElementVariant{});
    const auto found = std::ranges::find(words, word);
    if (found != words.end()) return static_cast<ElementVariant>(found - words.begin());
    refuse("element {} found; full and assumed_strain are allowed", word);
}

}  // namespace magfsi::structure
