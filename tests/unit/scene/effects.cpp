// SPDX-License-Identifier: GPL-2.0-or-later
// What a scene comes to: effects, those that can do nothing, hash.
#include <gtest/gtest.h>
#include <algorithm>
#include <nlohmann/json.hpp>
#include <set>
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
    EXPECT_EQ(absent_effects(s),
              (Names{"viscosity", "field gradient", "field sources", "dipoles", "control",
                     "platform", "friction", "contact", "rigid parts", "rollers",
                     "prescribed motion", "implicit scheme", "bulk viscosity",
                     "eddy viscosity", "rheology", "free slip", "inlets and outlets",
                     "refinement", "obstacles"}));
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
            "structure step: elasticity, magnetic field; absent: viscosity, "
            "field gradient, field sources, dipoles, control, gravity, damping, "
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

// The hash is that of the meaning: the spelling does not matter, each value does.

constexpr const char* one_spelling = R"(
name: strip  # a comment
time: {end: 120 ms}
bodies:
  b: {mesh: {box: {size: [4 mm, 2 mm, 0.2 mm], elements: [4, 2, 1]}},
      material: {shear_modulus: 33 kPa, lame_lambda: 660 kPa, density: 1860 kg/m3}}
  a: {mesh: {box: {size: [4 mm, 2 mm, 0.2 mm], elements: [4, 2, 1]}},
      material: {shear_modulus: 33 kPa, lame_lambda: 660 kPa, density: 1860 kg/m3}}
damping: {rate: 600 1/s}
gravity: {acceleration: 9.81 m/s2, direction: [0, 0, -1]}
)";

constexpr const char* another_spelling = R"(
gravity: {direction: [0, -0.0, -2.5], acceleration: 981 cm/s^2}
damping:
  rate: 0.6 kHz
bodies:
  a: &same
    material:
      density: 1.86 g/cm3
      lame_lambda: 0.66 MPa
      shear_modulus: 33000 N/m2
    mesh: {box: {elements: [4, 2, 1], size: [4e-3 m, 0.2 cm, 200 um]}}
    element: assumed_strain
  b: *same
time: {end: 0.12 s}
name: "strip"
)";

TEST(Hash, ignores_comments_order_and_spelling) {
    const TemporaryScene one(one_spelling), another(another_spelling);
    EXPECT_EQ(read_scene(one.path()).hash, read_scene(another.path()).hash);
}

TEST(Hash, of_the_states_ignores_what_changes_none) {
    const auto state = [](const std::string& change) {
        return state_hash(read_scene(test_folder / "complete/swimmer.yaml", {change}));
    };
    const auto as_it_is = state("time.end=120 ms");
    EXPECT_EQ(state("time.end=240 ms"), as_it_is);
    EXPECT_NE(state("time.step=19 us"), as_it_is);
    EXPECT_NE(state("checkpoint.every=4 ms"), as_it_is);
    EXPECT_EQ(state("checkpoint.max_retries=3"), as_it_is);
}

// An effect of which nothing is said but that it is there is another scene.
TEST(Hash, knows_an_effect_by_its_empty_map) {
    const Scene without = read_scene(test_folder / "complete/swimmer.yaml");
    const Scene with = read_scene(test_folder / "complete/swimmer.yaml", {"contact={}"});
    EXPECT_TRUE(effective_scene(with).contains("contact"));
    EXPECT_NE(with.hash, without.hash);
    EXPECT_NE(state_hash(with), state_hash(without));
}

TEST(Hash, is_that_of_the_values) {
    const Scene s = read_scene(test_folder / "minimal.yaml");
    EXPECT_EQ(s.hash, scene_hash(s));
    EXPECT_NE(s.hash, 0u);
}

// Changes, each in one value, one a key of the table.
std::vector<std::string> changes() {
    const std::string body = "bodies.robot.";
    return {"name=other",
            "time.end=121 ms",
            "time.step=19 us",
            body + "mesh.box.size=[3.7 mm, 1.5 mm, 0.186 mm]",
            body + "mesh.box.elements=[19, 8, 2]",
            body + "element=assumed_strain",
            body + "material.shear_modulus=34 kPa",
            body + "material.lame_lambda=661 kPa",
            body + "material.density=1861 kg/m3",
            body + "magnetization.harmonic.amplitude=63 kA/m",
            body + "magnetization.harmonic.wavelength=4 mm",
            body + "magnetization.harmonic.phase=1 deg",
            body + "magnetization.harmonic.along=z",
            body + "magnetization.harmonic.into=z",
            body + "magnetization={uniform: [1 A/m, 0 A/m, 0 A/m]}",
            body + "clamps=[x_min]",
            body + "initial.position=[8 mm, 4 mm, 5 mm]",
            body + "initial.rotation.plane=zy",
            body + "initial.rotation.angle=89 deg",
            body + "initial.relaxed.magnitude=17 mT",
            body + "initial.relaxed.direction=1 deg",
            body + "initial.relaxed=",
            "magnetic_field.plane=xz",
            "magnetic_field.table.time=[0 ms, 19 ms, 32 ms]",
            "magnetic_field.table.magnitude=[-17 mT, 17 mT, -17 mT]",
            "magnetic_field.table.direction=0 deg",
            "magnetic_field.table.repeat=false",
            "gravity.acceleration=9.8 m/s2",
            "gravity.direction=[0, 0, -1]",
            "gravity=",
            "damping.rate=601 1/s",
            "damping=",
            "fluid.solver=lbm",
            "fluid.box=[16 mm, 8 mm, 16.2 mm]",
            "fluid.spacing=0.4 mm",
            "fluid.density=999 kg/m3",
            "fluid.viscosity=1.1 mm2/s",
            "fluid.expected_speed=0.6 m/s",
            "fluid.lattice_speed=0.05",
            "fluid.collision=automatic",
            "fluid.boundaries.x_min=",
            "fluid.boundaries.z_min.no_slip.velocity=[0.1 m/s, 0.3 m/s, 0 m/s]",
            "fluid.initial_velocity=[1 mm/s, 2 mm/s, 4 mm/s]",
            "fluid.initial_velocity=",
            "fluid.body_force=[10 Pa/m, 20 N/m3, 31 mN/cm3]",
            "fluid.body_force=",
            "coupling.substeps=13",
            "coupling.substeps=",
            "coupling.timeout=31 s",
            "coupling.immersed_boundary.kernel=3-point",
            "coupling.immersed_boundary.strength=1",
            "probes.every=0.4 ms",
            "probes.bodies=[energy]",
            "probes.points.tip.at=[3.6 mm, 0.75 mm, 0.0925 mm]",
            "probes.fluid=[mass]",
            "probes.interface_balance=false",
            "probes.energy_audit=false",
            "probes=",
            "output.structure.every=2 ms",
            "output.structure=",
            "output.fluid.every=1 ms",
            "output.fluid.fields=[velocity]",
            "checkpoint.every=4 ms",
            "checkpoint.max_retries=4",
            "checkpoint="};
}

TEST(Hash, changes_with_each_value) {
    std::set<std::uint64_t> seen = {
        read_scene(test_folder / "complete/swimmer.yaml").hash};
    for (const std::string& change : changes()) {
        std::vector<std::string> overrides = {change};
        // Periodic sides come in pairs.
        if (change == "fluid.boundaries.x_min=")
            overrides.emplace_back("fluid.boundaries.x_max=");
        const Scene s = read_scene(test_folder / "complete/swimmer.yaml", overrides);
        EXPECT_TRUE(seen.insert(s.hash).second) << change;
    }
}

// The names of the columns of probes.csv are a promise to every script that reads them.
using Names = std::vector<std::string>;

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
