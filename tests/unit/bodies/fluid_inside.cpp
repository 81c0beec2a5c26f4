// SPDX-License-Identifier: GPL-2.0-or-later
// What of the fluid inside a body comes off its nodes' mass, and that nothing is lost.
#include "adapters/solvers/bodies/fluid_inside.h"

#include <gtest/gtest.h>

#include <numeric>

#include "adapters/solvers/bodies/scene_to_body.h"
#include "structure/lattice/lattice.h"

namespace magfsi::bodies {
namespace {

constexpr double fluid_kg_m3 = 1000, volume_m3 = 4e-3 * 2e-3 * 1e-3;

scene::Scene scene_with(std::initializer_list<double> densities) {
    scene::Scene scene;
    scene.fluid.emplace().density_kg_m3 = fluid_kg_m3;
    for (const double density : densities) {
        scene::Body& body = scene.bodies.emplace_back();
        body.name = "body";
        body.mesh = structure::Box{{4e-3, 2e-3, 1e-3}, {4, 2, 1}};
        body.material.shear_modulus_pa = 1e5;
        body.material.lame_lambda_pa = 1e6;
        body.material.density_kg_m3 = density;
    }
    return scene;
}

double off(const scene::Scene& scene, std::size_t body = 0) {
    return off_nodes_kg_m3(scene, to_body(scene.bodies[body]));
}

TEST(FluidInside, comes_off_whole_where_the_body_is_dense) {
    EXPECT_EQ(off(scene_with({10000})), fluid_kg_m3);
    EXPECT_EQ(off(scene_with({1860})), fluid_kg_m3);
    EXPECT_EQ(off(scene_with({1500})), fluid_kg_m3);
}

TEST(FluidInside, leaves_a_third_of_its_mass_to_a_light_body) {
    for (const double density : {1000.0, 500.0, 10.0})
        EXPECT_DOUBLE_EQ(density - off(scene_with({density})), density / 3);
}

TEST(FluidInside, of_several_materials_the_lightest_counts) {
    structure::Body body = to_body(scene_with({3000}).bodies[0]);
    body.other_materials.push_back({1e5, 1e6, 600, 0});
    body.element_material.assign(body.mesh.elements.size(), 0);
    EXPECT_EQ(off_nodes_kg_m3(scene_with({3000}), body), fluid_kg_m3);
    body.element_material.back() = 1;
    EXPECT_DOUBLE_EQ(off_nodes_kg_m3(scene_with({3000}), body), 400);
}

TEST(FluidInside, stays_without_a_fluid_and_where_nodes_are_slowed_by_their_mass) {
    scene::Scene scene = scene_with({10000});
    scene.damping.emplace();  // of rate 0
    EXPECT_EQ(off(scene), fluid_kg_m3);
    scene.damping->rate_1_s = 1e-9;
    EXPECT_EQ(off(scene), 0);
    scene.damping.reset();
    scene.fluid.reset();
    EXPECT_EQ(off(scene), 0);
}

TEST(FluidInside, is_what_the_nodes_lack_of_the_whole_mass) {
    const scene::Scene scene = scene_with({1860, 700});
    const Solids solids = to_bodies(scene);
    const auto whole = whole_masses_kg(solids);
    const auto inside = bodies_in_fluid(scene, solids);
    std::size_t first = 0;
    for (std::size_t b = 0; b < inside.size(); ++b) {
        const auto nodal = structure::build_lattice(inside[b]).node_mass_kg;
        double lacking = 0;
        for (std::size_t n = 0; n < nodal.size(); ++n)
            lacking += whole[first + n] - nodal[n];
        EXPECT_NEAR(lacking / (off(scene, b) * volume_m3), 1, 1e-12);  // rounding
        first += nodal.size();
    }
    EXPECT_EQ(first, whole.size());
    EXPECT_NEAR(std::accumulate(whole.begin(), whole.end(), 0.0) / (2560 * volume_m3), 1,
                1e-12);
}

}  // namespace
}  // namespace magfsi::bodies
