// The names of the columns of probes.csv are a promise to every script that reads them.

#include <gtest/gtest.h>

#include "adapters/fluids/fluid_probes.h"

namespace magfsi::scene {
namespace {

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
    scene.probes->fluid = {Q::max_speed, Q::mass};
    EXPECT_EQ(fluids::fluid_columns(scene), (Names{"max_speed[m/s]", "mass[kg]"}));
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
              (Names{"interface.momentum_mismatch[1]", "interface.power_mismatch[1]"}));
}

TEST(ProbeColumns, the_fluids_share_of_the_energy_comes_last_of_its_columns) {
    auto scene = robot_in_water();
    scene.probes->fluid = {FluidQuantity::mass};
    scene.probes->energy_audit = true;
    EXPECT_EQ(fluids::fluid_columns(scene),
              (Names{"mass[kg]", "audit.fluid_kinetic[J]"}));
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

}  // namespace
}  // namespace magfsi::scene
