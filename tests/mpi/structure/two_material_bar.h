// A cantilever of two materials, one of them viscous, in a field and under its weight.
#pragma once

#include "structure/lammps/script.h"
#include "structure/lattice/stable_step.h"
#include "tests/unit/structure/two_materials.h"

namespace magfsi::structure::test {

inline LammpsInput bending_bar() {
    LammpsInput input;
    Body body = soft_and_stiff_bar();
    body.other_materials[0].viscosity_pa_s = 0.5;
    body.magnetization_a_m = uniform_magnetization(body.mesh, {60e3, 0, 0});
    body.clamps = {"x_min"};
    input.field = FieldProgram{{0, 2}, ConstantField{10e-3, 1.5}};
    input.gravity_m_s2 = Vec3{0, 0, -9.81};
    input.time_step_s = 0.9 * stable_step_s(body);
    input.bodies = {body};
    return input;
}

}  // namespace magfsi::structure::test
