// SPDX-License-Identifier: GPL-2.0-or-later
// The bodies that the structure tests run in LAMMPS: the paper's strip, and a bar of two
// materials.
#pragma once

#include <numbers>

#include "structure/lammps/script.h"
#include "structure/lattice/lattice.h"
#include "structure/lattice/stable_step.h"
#include "structure/magnetics/magnetization.h"
#include "structure/mesh/block_mesh.h"
#include "tests/unit/structure/elements.h"

namespace magfsi::structure::test {

inline Body strip(ElementVariant element = ElementVariant::assumed_strain) {
    Body body;
    body.name = "strip";
    body.mesh = box_mesh({{3.7e-3, 1.5e-3, 0.185e-3}, {20, 8, 2}});
    body.material = {33e3, 660e3, 1860};
    body.element = element;
    body.magnetization_a_m =
        harmonic_magnetization(body.mesh, {62e3, 3.7e-3, std::numbers::pi / 4, 0, 2});
    return body;
}

// At 0.9 of the stable step, in the field of one swimming stroke.
inline LammpsInput strip_in_field(
    ElementVariant element = ElementVariant::assumed_strain) {
    LammpsInput input;
    input.bodies = {strip(element)};
    input.field = FieldProgram{
        {0, 2},
        FieldTable{
            {0, 0.0195, 0.032, 0.04}, {-0.017, 0.017, -0.017, -0.017}, {0.8}, true}};
    input.time_step_s = 0.9 * stable_step_s(input.bodies[0]);
    return input;
}

inline LammpsInput bare_strip() {
    LammpsInput input = strip_in_field();
    input.field.reset();
    return input;
}

// Two across each other, the upper so high, which can touch.
inline LammpsInput crossed_strips(double height_m) {
    LammpsInput input = bare_strip();
    input.bodies.push_back(input.bodies[0]);
    input.bodies[1].name = "upper";
    input.placements.resize(2);
    input.placements[0].position_m = Vec3{0, 0, 0};
    input.placements[1].position_m = Vec3{0.2e-3, 0.1e-3, height_m};
    input.placements[1].rotation = PlaneRotation{{0, 1}, 1.2};
    input.contact = ContactLaw{};
    return input;
}

// Without load, from the V of 5 mT.
inline LammpsInput released_strip() {
    LammpsInput input = bare_strip();
    Placement placement;
    placement.relaxed = ConstantField{5e-3, 0.8};
    input.placements = {placement};
    return input;
}

// A cantilever of two materials, one of them viscous, in a field and under its weight.
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

// Sum of mass times v [kg m/s] of a body whose node 0 has the given place in v.
inline Vec3 momentum(const Body& body, const std::vector<double>& velocity,
                     std::size_t first = 0) {
    const auto mass = build_lattice(body).node_mass_kg;
    Vec3 out{};
    for (std::size_t a = 0; a < mass.size(); ++a)
        out += mass[a] * vector_at(&velocity[3 * (first + a)]);
    return out;
}

// Kinetic energy [J] of such a body.
inline double kinetic_energy(const Body& body, const std::vector<double>& velocity,
                             std::size_t first = 0) {
    const auto mass = build_lattice(body).node_mass_kg;
    double out = 0;
    for (std::size_t q = 0; q < 3 * mass.size(); ++q) {
        const double v = velocity[3 * first + q];
        out += 0.5 * mass[q / 3] * v * v;
    }
    return out;
}

}  // namespace magfsi::structure::test
