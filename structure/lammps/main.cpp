// SPDX-License-Identifier: GPL-2.0-or-later
// Program magfsi-lammps: the LAMMPS command line with our styles, for plain input
// scripts; and `magfsi-lammps lattice NAME ...`, which writes the files of a block for
// such scripts.
#include <dlfcn.h>
#include <mpi.h>
#include "input.h"
#include "lammps.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <memory>
#include <string>

#include "base/process/keep_libraries.h"
#include "structure/lammps/lattice_file.h"
#include "structure/lammps/register_styles.h"
#include "structure/lattice/lattice.h"
#include "structure/lattice/stable_step.h"
#include "structure/magnetics/magnetization.h"
#include "structure/mesh/block_mesh.h"

namespace magfsi::structure {
namespace {

// Arguments of `magfsi-lammps lattice`.
struct Wanted {
    std::string name;
    Box box;
    Material material;
    std::string element = "assumed_strain";
    Vec3 magnetization_a_m{};
};

void declare(CLI::App& app, Wanted& wanted) {
    app.name("magfsi-lammps lattice");
    app.add_option("NAME", wanted.name, "writes NAME.lattice and NAME.data")->required();
    app.add_option("--size", wanted.box.size_m, "edges along x, y, z [m]")->required();
    app.add_option("--elements", wanted.box.elements, "along x, y, z")->required();
    app.add_option("--shear-modulus", wanted.material.shear_modulus_pa, "G [Pa]")
        ->required();
    app.add_option("--lame-lambda", wanted.material.lame_lambda_pa, "K [Pa]")->required();
    app.add_option("--density", wanted.material.density_kg_m3, "[kg/m3]")->required();
    app.add_option("--element", wanted.element,
                   "full or assumed_strain (the stable step's)");
    app.add_option("--magnetization", wanted.magnetization_a_m, "uniform [A/m]");
}

void write(const Wanted& wanted) {
    Body body;
    body.name = wanted.name;
    body.mesh = box_mesh(wanted.box);
    body.material = wanted.material;
    body.element = parse_element_name(wanted.element);
    const auto masses = build_lattice(body).node_mass_kg;
    std::vector<DataAtom> atoms;
    for (std::size_t a = 0; a < masses.size(); ++a) {
        atoms.push_back({body.mesh.nodes[a], masses[a]});
    }
    write_lattice_file({body.mesh.nodes,
                        body.mesh.elements,
                        uniform_magnetization(body.mesh, wanted.magnetization_a_m),
                        {}},
                       wanted.name + ".lattice");
    write_data_file(atoms, wanted.name + ".data");
    fmt::print("{0}.lattice, {0}.data: {1} nodes, {2} elements, stable step {3:.4g} s\n",
               wanted.name, masses.size(), body.mesh.elements.size(),
               stable_step_s(body));
}

// Writes NAME.lattice (for fix magttice) and NAME.data (for read_data) and prints the
// stable step; argv[0] is the word "lattice". Returns the exit code: 0, or 2 on wrong
// arguments, which are named on stderr.
int lattice_command(int argc, char** argv) {
    CLI::App app("A block of bricks, one corner in the origin");
    Wanted wanted;
    declare(app, wanted);
    try {
        app.parse(argc, argv);
        write(wanted);
    } catch (const CLI::ParseError& error) {
        return app.exit(error) == 0 ? 0 : 2;
    } catch (const std::exception& error) {
        fmt::print(stderr, "magfsi-lammps lattice: {}\n", error.what());
        return 2;
    }
    return 0;
}

}  // namespace
}  // namespace magfsi::structure

// LAMMPS's command `clear` deletes and creates its styles anew and calls post_create at
// the end. This definition is found before the library's own; it calls that one and then
// registers our styles again, so that they outlive `clear`.
void LAMMPS_NS::LAMMPS::post_create() {
    void* const theirs = dlsym(RTLD_NEXT, "_ZN9LAMMPS_NS6LAMMPS11post_createEv");
    if (theirs != nullptr) reinterpret_cast<void (*)(LAMMPS*)>(theirs)(this);
    magfsi::structure::register_styles(*this);
}

int main(int argc, char** argv) {
    if (argc > 1 && std::string(argv[1]) == "lattice") {
        return magfsi::structure::lattice_command(argc - 1, argv + 1);
    }
    MPI_Init(&argc, &argv);
    try {
        const auto lammps =
            std::make_unique<LAMMPS_NS::LAMMPS>(argc, argv, MPI_COMM_WORLD);
        magfsi::structure::register_styles(*lammps);
        lammps->input->file();
    } catch (const std::exception& error) {
        fmt::print(stderr, "magfsi-lammps: {}\n", error.what());
        MPI_Abort(MPI_COMM_WORLD, 1);
    }
    magfsi::keep_libraries();
    MPI_Finalize();
    return 0;
}
