// The table's defaults are those of scene.h, and those that depend on other keys are
// filled.
#include <gtest/gtest.h>

#include "adapters/scene/effective.h"
#include "adapters/scene/names.h"
#include "adapters/scene/reader.h"
#include "tests/unit/scene/scene_files.h"

namespace magfsi::scene {
namespace {

Scene minimal(const std::vector<std::string>& overrides = {}) {
    return read_scene(test_folder / "minimal.yaml", overrides);
}

TEST(Defaults, of_the_table_are_those_of_the_structs) {
    const Scene s = minimal();
    EXPECT_EQ(s.bodies[0].element, Body{}.element);
    EXPECT_TRUE(s.bodies[0].clamps.empty());
    EXPECT_EQ(s.bodies[0].initial.rotation->plane, PlaneRotation{}.plane);
    const auto& m = std::get<HarmonicMagnetization>(*s.bodies[0].magnetization);
    EXPECT_EQ(m.phase_rad, HarmonicMagnetization{}.phase_rad);
    EXPECT_EQ(m.along, HarmonicMagnetization{}.along);
    EXPECT_EQ(m.into, HarmonicMagnetization{}.into);
    EXPECT_EQ(s.magnetic_field->plane, MagneticField{}.plane);
    EXPECT_EQ(std::get<FieldTable>(s.magnetic_field->course).repeat, FieldTable{}.repeat);
    EXPECT_EQ(s.gravity->direction, Gravity{}.direction);
    EXPECT_EQ(s.fluid->solver, Fluid{}.solver);
    EXPECT_EQ(s.fluid->lattice_speed, Fluid{}.lattice_speed);
    EXPECT_EQ(s.fluid->courant, Fluid{}.courant);
    EXPECT_FALSE(s.fluid->grading);
    EXPECT_EQ(s.fluid->collision, Fluid{}.collision);
    for (std::size_t face = 0; face < 6; ++face) {
        EXPECT_EQ(s.fluid->boundaries[face].kind, Boundary{}.kind);
        EXPECT_EQ(s.fluid->boundaries[face].wall_velocity_m_s, Vec3{});
    }
    EXPECT_FALSE(s.fluid->initial_velocity_m_s);
    EXPECT_FALSE(s.fluid->body_force_n_m3);
    EXPECT_FALSE(s.probes->interface_balance);
    EXPECT_FALSE(s.probes->energy_audit);
    EXPECT_TRUE(s.probes->bodies.empty());
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
