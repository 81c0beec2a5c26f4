// SPDX-License-Identifier: GPL-2.0-or-later
// Both directions of `magfsi lattice`: scene to LAMMPS files, lattice file to Gmsh mesh
// and table.
#include "adapters/app/lattice.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "adapters/scene/effective.h"
#include "adapters/scene/reader.h"
#include "adapters/solvers/lammps/scene_to_input.h"
#include "adapters/solvers/lammps/substeps.h"
#include "coupler/output/file.h"
#include "coupler/participants/errors.h"
#include "structure/lammps/lattice_file.h"
#include "structure/lammps/script.h"

namespace magfsi::launch {

namespace fs = std::filesystem;

namespace {

// Writes the files of a scene's bodies into options.out. The script lammps.in has all
// loads of the scene except the fluid, and runs until the scene's end; a path of
// equilibria has no such number of steps.
int write(const LatticeOptions& options) {
    const scene::Scene scene = scene::read_scene(options.input, options.overrides);
    if (scene.bodies.empty())
        throw std::invalid_argument(
            "the scene has no bodies; name one with the key bodies");
    auto input = lammps::to_lammps_input(scene, bodies::to_bodies(scene));
    const lammps::Substeps steps = lammps::choose_substeps(scene, input);
    input.time_step_s = steps.lammps_step_s;
    fs::create_directories(options.out);
    const auto script = structure::write_lammps_input(input, fs::absolute(options.out));
    std::string text =
        fmt::format("# {}: runs with magfsi lammps -in lammps.in{}\n", scene.name,
                    scene.fluid ? "; without the fluid, which only magfsi run has" : "");
    text += text_of(script);
    if (!scene.time.equilibrium)
        text += fmt::format("run {:.0f}\n", scene.time.end_s / steps.lammps_step_s);
    output::write_atomically(options.out / "lammps.in", text);
    for (const structure::Body& body : input.bodies)
        fmt::print("{}: {} nodes, {} elements\n", body.name, body.mesh.nodes.size(),
                   body.mesh.elements.size());
    fmt::print("{}: bodies.data, a lattice file a body, lammps.in\n",
               options.out.string());
    return coupler::exit_done;
}

// Corners of a hexahedron in the order of Gmsh, which goes around the lower face, then
// around the upper one; ours numbers x fastest, then y, then z.
constexpr std::array gmsh_order{0, 1, 3, 2, 4, 5, 7, 6};

// Text of a Gmsh 2.2 file; each material becomes a physical volume "material_N".
// Physical tags count from 1, materials of the lattice file from 0.
std::string gmsh_text(const structure::LatticeFile& lattice) {
    const auto material = [&](std::size_t e) {
        return lattice.element_material.empty() ? 0 : lattice.element_material[e];
    };
    int materials = 1;
    for (const int m : lattice.element_material) materials = std::max(materials, m + 1);
    std::string text = fmt::format(
        "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n{}\n", materials);
    for (int m = 0; m < materials; ++m)
        text += fmt::format("3 {} \"material_{}\"\n", m + 1, m);
    text += fmt::format("$EndPhysicalNames\n$Nodes\n{}\n", lattice.nodes_m.size());
    for (std::size_t n = 0; n < lattice.nodes_m.size(); ++n) {
        const auto& x = lattice.nodes_m[n];
        text += fmt::format("{} {} {} {}\n", n + 1, x[0], x[1], x[2]);
    }
    text += fmt::format("$EndNodes\n$Elements\n{}\n", lattice.elements.size());
    for (std::size_t e = 0; e < lattice.elements.size(); ++e) {
        text += fmt::format("{} 5 2 {} {}", e + 1, material(e) + 1, material(e) + 1);
        for (const int a : gmsh_order)
            text += fmt::format(" {}", lattice.elements[e][a] + 1);
        text += "\n";
    }
    return text + "$EndElements\n";
}

// Table of magnetisations: element centres [m] and vectors [A/m], in the order of the
// elements.
std::string table_text(const structure::LatticeFile& lattice) {
    std::string text = "x[m],y[m],z[m],Mx[A/m],My[A/m],Mz[A/m]\n";
    for (std::size_t e = 0; e < lattice.elements.size(); ++e) {
        structure::Vec3 centre{};
        for (const int node : lattice.elements[e]) centre += lattice.nodes_m[node] / 8;
        text += fmt::format("{},{}\n", fmt::join(centre, ","),
                            fmt::join(lattice.magnetization_a_m[e], ","));
    }
    return text;
}

// Writes the mesh and the magnetisations of a lattice file and prints the keys that use
// them in a scene.
int read(const LatticeOptions& options) {
    if (!options.overrides.empty())
        throw std::invalid_argument(
            "--set: found with a lattice file; allowed with a scene");
    const auto lattice = structure::read_lattice_file(options.input);
    fs::create_directories(options.out);
    const fs::path base = options.out / options.input.stem();
    output::write_atomically(base.string() + ".msh", gmsh_text(lattice));
    output::write_atomically(base.string() + ".csv", table_text(lattice));
    fmt::print(
        "{0}.msh, {0}.csv: {1} nodes, {2} elements; in a scene\n"
        "  mesh: {{gmsh: {{file: {3}.msh}}}}\n"
        "  magnetization: {{table: {{file: {3}.csv}}}}\n",
        base.string(), lattice.nodes_m.size(), lattice.elements.size(),
        options.input.stem().string());
    return coupler::exit_done;
}

}  // namespace

// The ending decides which way to convert.
int lattice(const LatticeOptions& options) {
    if (options.input.extension() != ".lattice") return write(options);
    try {
        return read(options);
    } catch (const std::runtime_error& error) {  // a fault in the input file
        throw std::invalid_argument(error.what());
    }
}

}  // namespace magfsi::launch
