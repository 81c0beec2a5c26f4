#include "structure/lattice/stable_step.h"

#include <gtest/gtest.h>

#include <cmath>

#include "structure/mesh/block_mesh.h"
#include "tests/unit/structure/elements.h"

namespace magfsi::structure {
namespace {

constexpr double edge_m = 1e-3;

// A cube of one element.
Body cube(ElementVariant variant) {
    Body body;
    body.name = "cube";
    body.mesh = box_mesh({{edge_m, edge_m, edge_m}, {1, 1, 1}});
    body.material = test::soft_material();
    body.element = variant;
    return body;
}

std::vector<Vec3> stretched(const Body& body, const Vec3& by) {
    std::vector<Vec3> nodes = body.mesh.nodes;
    for (Vec3& x : nodes) {
        for (std::size_t d = 0; d < 3; ++d) x[d] *= by[d];
    }
    return nodes;
}

// r at rest: |dV/dx_a|^2 is 3 l^4 / 16 at each of eight nodes of an eighth of the mass.
double at_rest_1_s2(const Material& m) {
    return 12 * (m.lame_lambda_pa + m.shear_modulus_pa) /
           (m.density_kg_m3 * edge_m * edge_m);
}

TEST(CurrentStep, rises_as_the_faces_of_an_element_grow_and_with_its_pressure) {
    for (const auto variant : {ElementVariant::full, ElementVariant::assumed_strain}) {
        const Body body = cube(variant);
        const Material& m = body.material;
        const CurrentStep step(body);
        const double rest = at_rest_1_s2(m);
        EXPECT_NEAR(step.rise_1_s2(body.mesh.nodes) / rest, 0, 1e-12);
        // Flat at its volume: faces of 2, 0.71 and 0.71.
        const double r2 = std::sqrt(2.0);
        EXPECT_NEAR(step.rise_1_s2(stretched(body, {0.5, r2, r2})) / rest, 5.0 / 3 - 1,
                    1e-12);
        // Held at its sides: J = 1/2, faces of 1, 1/2 and 1/2.
        const double modulus =
            4 * (m.lame_lambda_pa * (1 + std::log(2.0)) + m.shear_modulus_pa);
        EXPECT_NEAR(step.rise_1_s2(stretched(body, {0.5, 1, 1})) / rest,
                    0.5 * modulus / (m.lame_lambda_pa + m.shear_modulus_pa) - 1, 1e-12);
        // Drawn apart it is softer.
        EXPECT_EQ(step.rise_1_s2(stretched(body, {1.2, 1.2, 1.2})), 0);
        EXPECT_TRUE(std::isinf(step.rise_1_s2(stretched(body, {-1, 1, 1}))));
    }
}

TEST(CurrentStep, falls_with_the_frequency) {
    EXPECT_DOUBLE_EQ(CurrentStep::step_s(1e-5, 0), 1e-5);
    // omega^2 four times as large.
    EXPECT_DOUBLE_EQ(CurrentStep::step_s(1e-5, 3 * 4 / 1e-10), 0.5e-5);
}

}  // namespace
}  // namespace magfsi::structure
