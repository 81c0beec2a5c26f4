// SPDX-License-Identifier: GPL-2.0-or-later
// What a scene comes to: effects, those that can do nothing, columns.
#include <gtest/gtest.h>
#include <algorithm>
#include "adapters/scene/effective.h"
#include "adapters/scene/reader.h"
#include "adapters/solvers/fluids/fluid_probes.h"
#include "tests/unit/scene/scene_files.h"

namespace magfsi::scene {
namespace {

using Names = std::vector<std::string>;

TEST(Effects, of_a_swimmer) {
    const Scene s = read_scene(test_folder / "complete/swimmer.yaml");
    EXPECT_EQ(active_effects(s),
              (Names{"elasticity", "magnetic field", "gravity", "damping", "clamps",
                     "immersed boundary", "buoyancy", "overlap check", "fluid",
                     "body force", "moving walls", "probes", "interface balance",
                     "energy audit", "structure fields", "fluid fields", "checkpoint"}));
    EXPECT_EQ(absent_effects(s), (Names{"stiffening",
                                        "viscosity",
                                        "viscoelasticity",
                                        "field gradient",
                                        "field sources",
                                        "dipoles",
                                        "control",
                                        "platform",
                                        "friction",
                                        "contact",
                                        "rigid parts",
                                        "rollers",
                                        "prescribed motion",
                                        "implicit scheme",
                                        "bulk viscosity",
                                        "eddy viscosity",
                                        "rheology",
                                        "free slip",
                                        "inlets and outlets",
                                        "refinement",
                                        "obstacles"}));
}

TEST(Effects, AnUnknownNameIsAnError) {
    const Scene s = read_scene(test_folder / "complete/swimmer.yaml");
    EXPECT_TRUE(has_effect(s, "gravity"));
    EXPECT_FALSE(has_effect(s, "contact"));
    EXPECT_THROW(has_effect(s, "gravitation"), std::logic_error);
}

TEST(Effects, of_a_strip_on_a_platform) {
    const Scene s = read_scene(test_folder / "complete/platform.yaml");
    EXPECT_EQ(active_effects(s),
              (Names{"elasticity", "viscosity", "magnetic field", "field gradient",
                     "dipoles", "platform", "friction", "contact"}));
}

TEST(Effects, of_a_solid) {
    const Scene s = read_scene(test_folder / "complete/turning.yaml");
    EXPECT_EQ(active_effects(s), (Names{"elasticity", "magnetic field"}));
    EXPECT_EQ(
        effects_by_step(s),
        (Names{
            "structure step: elasticity, magnetic field; absent: stiffening, viscosity, "
            "viscoelasticity, field gradient, field sources, dipoles, control, gravity, "
            "damping, "
            "platform, friction, contact, "
            "clamps, rigid parts, rollers, prescribed motion",
            "coupled step: none; absent: immersed boundary, buoyancy, "
            "overlap check, implicit scheme",
            "fluid step: none; absent: fluid, body force, bulk viscosity, "
            "eddy viscosity, rheology, moving walls, free slip, inlets and outlets, "
            "refinement, "
            "obstacles",
            "outputs: none; absent: probes, interface balance, energy audit, structure "
            "fields, fluid fields, checkpoint"}));
}

TEST(Effects, of_faces_that_are_held) {
    EXPECT_EQ(active_effects(read_scene(test_folder / "complete/elastic.yaml")),
              (Names{"elasticity", "magnetic field", "clamps", "rollers",
                     "prescribed motion"}));
}

TEST(Effects, of_a_channel) {
    EXPECT_EQ(active_effects(read_scene(test_folder / "complete/channel.yaml")),
              (Names{"fluid", "bulk viscosity", "eddy viscosity", "free slip",
                     "inlets and outlets", "obstacles", "probes"}));
}

TEST(Effects, of_a_fluid) {
    const Scene s = read_scene(test_folder / "minimal.yaml",
                               {"bodies=", "magnetic_field=", "gravity="});
    EXPECT_EQ(active_effects(s), (Names{"fluid", "probes", "fluid fields"}));
}

// An effect that is in the scene and can do nothing there is told of; one that does
// something is not.

using Sets = std::vector<std::string>;

std::string warnings(const std::string& file, const Sets& overrides) {
    std::string all;
    for (const auto& line : idle_effects(read_scene(test_folder / file, overrides)))
        all += line + "\n";
    return all;
}

std::string of_minimal(const Sets& overrides) {
    return warnings("minimal.yaml", overrides);
}

TEST(IdleEffects, are_not_seen_where_there_are_none) {
    for (const auto& file : right_scenes()) {
        const auto idle = idle_effects(read_scene(file));
        EXPECT_TRUE(idle.empty()) << file << ": " << idle.front();
    }
}

struct Case {
    const char* warning;  // what it begins with, and why
    Sets overrides;
};

TEST(IdleEffects, are_not_a_gradient_without_a_uniform_field) {
    EXPECT_EQ(of_minimal({"magnetic_field.table.magnitude=[0 T]",
                          "magnetic_field.gradient.matrix=[[1 T/m, 0 T/m, 0 T/m], "
                          "[0 T/m, -1 T/m, 0 T/m], [0 T/m, 0 T/m, 0 T/m]]"}),
              "");
}

TEST(IdleEffects, are_named_with_the_reason) {
    const std::string gradient =
        "magnetic_field.gradient.matrix=[[0 T/m, 0 T/m, 0 T/m], [0 T/m, 0 T/m, 0 T/m], "
        "[0 T/m, 0 T/m, 0 T/m]]";
    const std::vector<Case> cases{
        {"gravity can do nothing: its acceleration is 0",
         {"gravity.acceleration=0 m/s2"}},
        {"gravity can do nothing: every body has the fluid's density",
         {"bodies.robot.material.density=1000 kg/m3"}},
        {"magnetic_field can do nothing: its magnitude is 0 at all times",
         {"magnetic_field.table.magnitude=[0 T]"}},
        {"magnetic_field can do nothing: every magnetization is 0",
         {"bodies.robot.magnetization={uniform: [0 A/m, 0 A/m, 0 A/m]}"}},
        {"magnetic_field.gradient can do nothing: its matrix is 0", {gradient}},
        {"damping can do nothing: its rate is 0", {"damping.rate=0 1/s"}},
        {"fluid.body_force can do nothing: it is 0",
         {"fluid.body_force=[0 N/m3, 0 N/m3, 0 N/m3]"}},
        {"fluid.initial_velocity can do nothing: it is 0",
         {"fluid.initial_velocity=[0 m/s, 0 m/s, 0 m/s]"}},
        {"checkpoint can do nothing: its interval is longer than the run",
         {"checkpoint.every=2 s"}},
    };
    for (const Case& c : cases) {
        const std::string text = of_minimal(c.overrides);
        EXPECT_TRUE(text.starts_with(c.warning)) << text << "instead of " << c.warning;
        EXPECT_EQ(std::ranges::count(text, '\n'), 1) << text;
    }
}

TEST(IdleEffects, of_an_equilibrium_by_newton_are_those_of_motion) {
    EXPECT_TRUE(
        warnings("complete/turning.yaml",
                 {"time={end: 1 s, equilibrium: {method: newton}}", "damping.rate=5 1/s"})
            .starts_with("damping can do nothing: Newton's method"));
}

// The names of the columns of probes.csv are a promise to every script that reads them.

Scene robot_in_water() {
    Scene scene;
    Body body;
    body.name = "robot";
    scene.bodies.push_back(body);
    scene.fluid.emplace();
    scene.probes.emplace();
    return scene;
}

TEST(ProbeColumns, of_the_fluid) {
    using Q = FluidQuantity;
    auto scene = robot_in_water();
    scene.probes->fluid = {Q::kinetic_energy, Q::enstrophy, Q::mass, Q::max_speed};
    EXPECT_EQ(
        fluids::fluid_columns(scene),
        (Names{"kinetic_energy[J]", "enstrophy[1/s^2]", "mass[kg]", "max_speed[m/s]"}));
    scene.probes->fluid = {Q::max_speed, Q::mass, Q::momentum};
    EXPECT_EQ(fluids::fluid_columns(scene),
              (Names{"max_speed[m/s]", "mass[kg]", "momentum_x[kg m/s]",
                     "momentum_y[kg m/s]", "momentum_z[kg m/s]"}));
}

TEST(ProbeColumns, of_a_plane) {
    auto scene = robot_in_water();
    scene.probes->fluid.clear();
    scene.probes->integrals = {{"fin", BodyPart{"robot", {}}},
                               {"gate", FluidPlane{0, 1e-3}}};
    EXPECT_EQ(
        fluids::fluid_columns(scene),
        (Names{"gate.flow[m3/s]", "gate.momentum_flux_x[N]", "gate.momentum_flux_y[N]",
               "gate.momentum_flux_z[N]", "gate.pressure[Pa]"}));
}

TEST(ProbeColumns, of_the_interface_only_when_asked_for) {
    auto scene = robot_in_water();
    EXPECT_TRUE(fluids::interface_columns(scene).empty());
    scene.probes->interface_balance = true;
    EXPECT_EQ(fluids::interface_columns(scene),
              (Names{"interface.momentum_mismatch[1]", "interface.power_mismatch[1]",
                     "interface.impulse_x[N s]", "interface.impulse_y[N s]",
                     "interface.impulse_z[N s]"}));
}

TEST(ProbeColumns, the_fluids_share_of_the_energy_comes_last_of_its_columns) {
    auto scene = robot_in_water();
    scene.probes->fluid = {FluidQuantity::mass};
    scene.probes->energy_audit = true;
    EXPECT_EQ(fluids::fluid_columns(scene),
              (Names{"mass[kg]", "audit.fluid_sound[J]", "audit.fluid_kinetic[J]"}));
    scene.fluid.reset();
    scene.probes->fluid.clear();
    EXPECT_TRUE(fluids::fluid_columns(scene).empty());
}

TEST(ProbeColumns, none_without_probes) {
    auto scene = robot_in_water();
    scene.magnetic_field.emplace();
    scene.probes.reset();
    EXPECT_TRUE(fluids::fluid_columns(scene).empty());
    EXPECT_TRUE(fluids::interface_columns(scene).empty());
}

Scene minimal(const std::vector<std::string>& overrides = {}) {
    return read_scene(test_folder / "minimal.yaml", overrides);
}

TEST(Defaults, forcing_is_without_slip_where_that_can_be) {
    const auto forcing = [](const std::string& key, const std::string& value) {
        const std::string path = "coupling." + key + "=" + value;
        return minimal({path}).coupling->immersed_boundary.forcing;
    };
    const auto no_slip = coupler::Forcing::no_slip, penalty = coupler::Forcing::penalty;
    EXPECT_EQ(minimal().coupling->immersed_boundary.forcing, no_slip);
    EXPECT_EQ(forcing("scheme", "implicit"), no_slip);
    EXPECT_EQ(forcing("immersed_boundary.kernel", "2-point"), no_slip);
    EXPECT_EQ(forcing("immersed_boundary.forcing", "penalty"), penalty);
    EXPECT_EQ(minimal({"fluid.solver=openfoam"}).coupling->immersed_boundary.forcing,
              penalty);
    for (const auto& [key, value] :
         {std::pair{"kernel", "4-point"}, {"strength", "0.5"}, {"strength", "2"}})
        EXPECT_EQ(forcing(std::string("immersed_boundary.") + key, value), penalty)
            << key;
}

}  // namespace
}  // namespace magfsi::scene
