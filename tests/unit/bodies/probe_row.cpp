// SPDX-License-Identifier: GPL-2.0-or-later
// The names of the bodies' columns of probes.csv are a promise to every script that reads
// them, and each has its value.
#include "adapters/solvers/bodies/probe_row.h"

#include <gtest/gtest.h>

#include "adapters/solvers/bodies/scene_to_body.h"

namespace magfsi::bodies {
namespace {

using Names = std::vector<std::string>;
using Q = scene::BodyQuantity;

scene::Scene robots(std::initializer_list<const char*> names) {
    scene::Scene scene;
    for (const char* name : names) {
        scene::Body& body = scene.bodies.emplace_back();
        body.name = name;
        body.mesh = structure::Box{{4e-3, 2e-3, 1e-3}, {4, 2, 1}};
        body.material.shear_modulus_pa = 1e5;
        body.material.lame_lambda_pa = 1e6;
        body.material.density_kg_m3 = 1000;
    }
    scene.fluid.emplace();
    scene.probes.emplace().bodies.clear();
    return scene;
}

struct Row {
    Names columns;
    std::vector<double> values;
};

// Of bodies that have moved by 1 mm along z since the start, at 2 m/s along x.
Row row_of(const scene::Scene& scene) {
    std::vector<structure::Body> bodies;
    NodalState nodes;
    for (const scene::Body& body : scene.bodies) {
        bodies.push_back(to_body(body));
        for (const auto& node : bodies.back().mesh.nodes)
            nodes.position_m.push_back({node[0], node[1], node[2]});
    }
    nodes.velocity_m_s.assign(nodes.position_m.size(), {2, 0, 0});
    nodes.mass_kg.assign(nodes.position_m.size(), 1e-6);
    const ProbeRow row(scene, bodies, nodes);
    for (auto& x : nodes.position_m) x[2] += 1e-3;
    std::vector<BodyLoads> loads(bodies.size(), {{3, 4, 5}, 6, 7});
    const std::vector<Vec3> force_on_parts{{8, 9, 10}};
    return {row.columns(), row.values(0, nodes, loads, force_on_parts)};
}

TEST(ProbeRow, of_a_body) {
    auto scene = robots({"robot"});
    scene.probes->bodies = {Q::com,         Q::speed, Q::shape, Q::max_displacement,
                            Q::fluid_force, Q::energy};
    const Row row = row_of(scene);
    EXPECT_EQ(
        row.columns,
        (Names{"robot.com_x[m]", "robot.com_y[m]", "robot.com_z[m]", "robot.speed_x[m/s]",
               "robot.speed_y[m/s]", "robot.speed_z[m/s]", "robot.end_to_end[m]",
               "robot.mid_rise[m]", "robot.bend[rad]", "robot.max_displacement[m]",
               "robot.fluid_force_x[N]", "robot.fluid_force_y[N]",
               "robot.fluid_force_z[N]", "robot.energy_elastic[J]",
               "robot.energy_kinetic[J]", "robot.work_magnetic[J]"}));
    ASSERT_EQ(row.values.size(), row.columns.size());
    EXPECT_NEAR(row.values[3], 2, 1e-12);
    EXPECT_NEAR(row.values[6], 4e-3, 1e-15);
    EXPECT_NEAR(row.values[9], 1e-3, 1e-15);
    EXPECT_EQ(row.values[11], 4);
    EXPECT_EQ(row.values[15], 7);
}

// Forces through a point r have the torque r x F about the origin, (r - c) x F about c.
TEST(ProbeRow, of_the_fluids_torque_is_about_the_centre_of_mass) {
    auto scene = robots({"robot"});
    scene.probes->bodies = {Q::com, Q::fluid_torque};
    const Row row = row_of(scene);
    ASSERT_EQ(row.columns[3], "robot.fluid_torque_x[N m]");
    const double* c = row.values.data();
    EXPECT_NEAR(row.values[3], -(c[1] * 5 - c[2] * 4), 1e-15);
    EXPECT_NEAR(row.values[4], -(c[2] * 3 - c[0] * 5), 1e-15);
    EXPECT_NEAR(row.values[5], -(c[0] * 4 - c[1] * 3), 1e-15);
}

TEST(ProbeRow, of_a_point_after_all_bodies) {
    auto scene = robots({"robot", "twin"});
    scene.probes->bodies = {Q::max_displacement};
    scene.probes->points = {{"tip", "robot", {4e-3, 1e-3, 0}}};
    const Row row = row_of(scene);
    EXPECT_EQ(row.columns,
              (Names{"robot.max_displacement[m]", "twin.max_displacement[m]", "tip_x[m]",
                     "tip_y[m]", "tip_z[m]", "tip_ux[m]", "tip_uy[m]", "tip_uz[m]"}));
    ASSERT_EQ(row.values.size(), row.columns.size());
    EXPECT_NEAR(row.values[7], 1e-3, 1e-15);
}

TEST(ProbeRow, the_field_comes_first_and_only_where_there_is_one) {
    auto scene = robots({"robot"});
    scene.probes->bodies = {Q::max_displacement};
    scene.magnetic_field.emplace();
    EXPECT_EQ(row_of(scene).columns.size(), 1u);  // no law: sources alone
    scene.magnetic_field->uniform = true;
    scene.magnetic_field->course = structure::VectorField{{2e-3, 3e-3, -6e-3}};
    const Row row = row_of(scene);
    EXPECT_EQ(row.columns, (Names{"field[T]", "field_x[T]", "field_y[T]", "field_z[T]",
                                  "robot.max_displacement[m]"}));
    EXPECT_NEAR(row.values[0], 7e-3, 1e-18);
    EXPECT_EQ(row.values[3], -6e-3);
}

TEST(ProbeRow, of_a_part_with_the_force_on_it_in_a_fluid) {
    auto scene = robots({"robot"});
    scene.probes->integrals = {{"gate", scene::FluidPlane{0, 1e-3}},
                               {"fin", scene::BodyPart{"robot", {}}}};
    Row row = row_of(scene);
    EXPECT_EQ(row.columns, (Names{"fin.ux[m]", "fin.uy[m]", "fin.uz[m]",
                                  "fin.momentum_x[kg m/s]", "fin.momentum_y[kg m/s]",
                                  "fin.momentum_z[kg m/s]", "fin.fluid_force_x[N]",
                                  "fin.fluid_force_y[N]", "fin.fluid_force_z[N]"}));
    ASSERT_EQ(row.values.size(), row.columns.size());
    EXPECT_NEAR(row.values[2], 1e-3, 1e-15);
    EXPECT_EQ(row.values[8], 10);
    scene.fluid.reset();
    row = row_of(scene);
    EXPECT_EQ(row.columns.size(), 6u);
    EXPECT_EQ(row.values.size(), 6u);
}

TEST(ProbeRow, none_without_probes) {
    auto scene = robots({"robot"});
    scene.magnetic_field.emplace();
    scene.probes.reset();
    EXPECT_TRUE(row_of(scene).columns.empty());
}

}  // namespace
}  // namespace magfsi::bodies
