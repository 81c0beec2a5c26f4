// SPDX-License-Identifier: GPL-2.0-or-later
// write_plain_script FOLDER: a small magnetic cantilever as a LAMMPS script.
#include <cstdio>
#include <fstream>

#include "structure/lammps/script.h"
#include "structure/lattice/stable_step.h"
#include "structure/magnetics/magnetization.h"
#include "structure/mesh/block_mesh.h"

int main(int argc, char** argv) {
    using namespace magfsi::structure;
    if (argc != 2) {
        std::fprintf(stderr, "usage: write_plain_script FOLDER\n");
        return 2;
    }
    const std::filesystem::path folder = argv[1];
    Body body;
    body.name = "beam";
    body.mesh = box_mesh({{4e-3, 1e-3, 0.25e-3}, {8, 2, 1}});
    body.material = {33e3, 660e3, 1860};
    body.magnetization_a_m = uniform_magnetization(body.mesh, {62e3, 0, 0});
    body.clamps = {"x_min"};
    LammpsInput input;
    input.bodies = {body};
    input.field = FieldProgram{{0, 2}, ConstantField{0.005, 1.5}};
    input.gravity_m_s2 = Vec3{0, 0, -9.81};
    input.drag = Drag{100};
    input.time_step_s = 0.9 * stable_step_s(body);
    std::ofstream out(folder / "lammps.in");
    for (const std::string& line : write_lammps_input(input, folder).setup) {
        out << line << '\n';
    }
    return out ? 0 : 1;
}
