// SPDX-License-Identifier: GPL-2.0-or-later
// Defaults of the scene.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <numbers>

#include "adapters/scene/effective.h"
#include "adapters/scene/keys.h"
#include "adapters/scene/reader.h"
#include "tests/unit/scene/scene_files.h"

namespace magfsi::scene {
namespace {

// Defaults that depend on other keys are filled.

Scene minimal(const std::vector<std::string>& overrides = {}) {
    return read_scene(test_folder / "minimal.yaml", overrides);
}

TEST(Defaults, name_the_scene_and_write_velocities) {
    const Scene s = minimal();
    EXPECT_EQ(s.name, "scene");
    EXPECT_EQ(s.output.fluid->fields, std::vector{FluidField::velocity});
    EXPECT_FALSE(s.output.structure);
}

TEST(Defaults, of_the_wavelength_is_the_length_along_its_axis) {
    const auto wavelength = [](const Scene& s) {
        return std::get<HarmonicMagnetization>(*s.bodies[0].magnetization).wavelength_m;
    };
    EXPECT_EQ(wavelength(minimal()), 4e-3);
    EXPECT_EQ(wavelength(minimal({"bodies.robot.magnetization.harmonic.along=y"})), 2e-3);
}

TEST(Defaults, fill_the_coupling_of_bodies_in_a_fluid) {
    const Scene s = minimal();
    ASSERT_TRUE(s.coupling);
    EXPECT_FALSE(s.coupling->substeps);
    // A scene that writes the key with nothing of its own means the same.
    EXPECT_EQ(minimal({"coupling={}"}).hash, s.hash);
    EXPECT_EQ(s.coupling->timeout_s, Coupling{}.timeout_s);
    EXPECT_FALSE(minimal({"bodies=", "magnetic_field=", "gravity="}).coupling);
}

TEST(Defaults, of_the_coupling_follow_its_scheme) {
    const Scene serial = minimal();
    EXPECT_FALSE(serial.coupling->iteration);
    EXPECT_EQ(serial.coupling->sampled_velocity, SampledVelocity::frozen);
    const Scene s = minimal({"coupling.scheme=implicit"});
    EXPECT_EQ(s.coupling->sampled_velocity, SampledVelocity::linear);
    EXPECT_EQ(minimal({"coupling.scheme=implicit", "coupling.iteration={}"}).hash,
              s.hash);
    const Iteration& i = *s.coupling->iteration;
    EXPECT_EQ(i.acceleration, AccelerationMethod::iqn_ils);
    EXPECT_EQ(i.max_iterations, Iteration{}.max_iterations);
    EXPECT_EQ(i.velocity_tolerance, Iteration{}.velocity_tolerance);
    EXPECT_EQ(i.filter_limit, Iteration{}.filter_limit);
}

TEST(Defaults, do_not_reach_absent_effects) {
    const Scene s = minimal({"fluid=", "gravity=", "output=", "probes="});
    EXPECT_FALSE(s.fluid || s.gravity || s.damping || s.coupling || s.probes);
    EXPECT_FALSE(s.output.structure || s.output.fluid);
}

}  // namespace
}  // namespace magfsi::scene
