// The names of the columns of probes.csv are a promise to every script that reads them.
#include "adapters/scene/probe_columns.h"

#include <gtest/gtest.h>

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

TEST(ProbeColumns, of_a_body) {
    using Q = BodyQuantity;
    auto scene = robot_in_water();
    scene.probes->bodies = {Q::com,         Q::speed, Q::shape, Q::max_displacement,
                            Q::fluid_force, Q::energy};
    EXPECT_EQ(
        body_columns(scene),
        (Names{"robot.com_x[m]", "robot.com_y[m]", "robot.com_z[m]", "robot.speed_x[m/s]",
               "robot.speed_y[m/s]", "robot.speed_z[m/s]", "robot.end_to_end[m]",
               "robot.mid_rise[m]", "robot.bend[rad]", "robot.max_displacement[m]",
               "robot.fluid_force_x[N]", "robot.fluid_force_y[N]",
               "robot.fluid_force_z[N]", "robot.energy_elastic[J]",
               "robot.energy_kinetic[J]", "robot.work_magnetic[J]"}));
}

TEST(ProbeColumns, of_a_point_after_all_bodies) {
    auto scene = robot_in_water();
    scene.bodies.push_back(scene.bodies[0]);
    scene.bodies[1].name = "twin";
    scene.probes->bodies = {BodyQuantity::max_displacement};
    scene.probes->points = {{"tip", "robot", {}}};
    EXPECT_EQ(body_columns(scene),
              (Names{"robot.max_displacement[m]", "twin.max_displacement[m]", "tip_x[m]",
                     "tip_y[m]", "tip_z[m]", "tip_ux[m]", "tip_uy[m]", "tip_uz[m]"}));
}

TEST(ProbeColumns, the_field_comes_first_and_only_where_there_is_one) {
    auto scene = robot_in_water();
    scene.probes->bodies = {BodyQuantity::max_displacement};
    scene.magnetic_field.emplace();
    EXPECT_EQ(body_columns(scene), (Names{"field[T]", "robot.max_displacement[m]"}));
}

TEST(ProbeColumns, of_the_fluid) {
    using Q = FluidQuantity;
    auto scene = robot_in_water();
    scene.probes->fluid = {Q::kinetic_energy, Q::enstrophy, Q::mass, Q::max_speed};
    EXPECT_EQ(fluid_columns(scene), (Names{"kinetic_energy[J]", "enstrophy[1/s^2]",
                                           "mass[kg]", "max_speed[m/s]"}));
    scene.probes->fluid = {Q::max_speed, Q::mass};
    EXPECT_EQ(fluid_columns(scene), (Names{"max_speed[m/s]", "mass[kg]"}));
}

TEST(ProbeColumns, of_integrals_on_the_side_that_they_are_of) {
    auto scene = robot_in_water();
    scene.probes->bodies.clear();
    scene.probes->fluid.clear();
    scene.probes->integrals = {{"fin", BodyPart{"robot", {}}},
                               {"gate", FluidPlane{0, 1e-3}}};
    EXPECT_EQ(
        body_columns(scene),
        (Names{"fin.ux[m]", "fin.uy[m]", "fin.uz[m]", "fin.momentum_x[kg m/s]",
               "fin.momentum_y[kg m/s]", "fin.momentum_z[kg m/s]", "fin.fluid_force_x[N]",
               "fin.fluid_force_y[N]", "fin.fluid_force_z[N]"}));
    EXPECT_EQ(
        fluid_columns(scene),
        (Names{"gate.flow[m3/s]", "gate.momentum_flux_x[N]", "gate.momentum_flux_y[N]",
               "gate.momentum_flux_z[N]", "gate.pressure[Pa]"}));
}

TEST(ProbeColumns, of_the_interface_only_when_asked_for) {
    auto scene = robot_in_water();
    EXPECT_TRUE(interface_columns(scene).empty());
    scene.probes->interface_balance = true;
    EXPECT_EQ(interface_columns(scene),
              (Names{"interface.momentum_mismatch[1]", "interface.power_mismatch[1]"}));
}

TEST(ProbeColumns, the_fluids_share_of_the_energy_comes_last_of_its_columns) {
    auto scene = robot_in_water();
    scene.probes->fluid = {FluidQuantity::mass};
    scene.probes->energy_audit = true;
    EXPECT_EQ(fluid_columns(scene), (Names{"mass[kg]", "audit.fluid_kinetic[J]"}));
    scene.fluid.reset();
    scene.probes->fluid.clear();
    EXPECT_TRUE(fluid_columns(scene).empty());
}

TEST(ProbeColumns, none_without_probes) {
    auto scene = robot_in_water();
    scene.magnetic_field.emplace();
    scene.probes.reset();
    EXPECT_TRUE(body_columns(scene).empty());
    EXPECT_TRUE(fluid_columns(scene).empty());
    EXPECT_TRUE(interface_columns(scene).empty());
}

}  // namespace
}  // namespace magfsi::scene
