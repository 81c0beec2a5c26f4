// SPDX-License-Identifier: GPL-2.0-or-later
// The hash of a scene.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <set>

#include "adapters/scene/effective.h"
#include "adapters/scene/reader.h"
#include "tests/unit/scene/scene_files.h"

namespace magfsi::scene {
namespace {

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

}  // namespace
}  // namespace magfsi::scene
