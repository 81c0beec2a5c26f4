#include "structure/lattice/stable_step.h"

#include <gtest/gtest.h>

#include <cmath>

#include "structure/lattice/element_kernel.h"
#include "tests/unit/structure/elements.h"

namespace magfsi::structure {
namespace {

Body block(const Box& box, ElementVariant variant) {
    Body body;
    body.name = "block";
    body.mesh = box_mesh(box);
    body.material = test::soft_material();
    body.element = variant;
    return body;
}

// Steps of h/c, h the thickness edge and c the longitudinal wave speed, measured on
// velocity-Verlet runs of plates to two digits.
TEST(StableStep, IsThatOfMeasuredPlates) {
    const Material material = test::soft_material();
    const double c =
        std::sqrt((material.lame_lambda_pa + 4 * material.shear_modulus_pa / 3) /
                  material.density_kg_m3);
    const double h = 1e-4;
    const double expected[4][2] = {
        {1, 0.59}, {std::sqrt(2.0), 0.72}, {2, 0.82}, {4, 0.94}};
    for (ElementVariant variant : test::all_variants) {
        for (const auto& [r, factor] : expected) {
            const Body body = block({{6 * r * h, 6 * r * h, 2 * h}, {6, 6, 2}}, variant);
            EXPECT_NEAR(stable_step_s(body) * c / h, factor, 0.006) << "r = " << r;
        }
    }
}

// Largest displacement after 4000 velocity-Verlet steps from a tiny random velocity.
double growth(const Body& body, double dt) {
    const Lattice lattice = build_lattice(body);
    const auto mass = lattice.node_mass_kg;
    ElementKernel kernel;
    kernel.assign(lattice);
    test::Random random(18);
    std::vector<double> x, v, f;
    for (const Vec3& node : body.mesh.nodes) {
        for (double coordinate : node) {
            x.push_back(coordinate);
            v.push_back(1e-9 * random.uniform());
        }
    }
    const auto start = x;
    double largest = 0;
    for (int step = 0; step < 4000 && largest < 1e-5; ++step) {
        f.assign(x.size(), 0.0);
        kernel.add_forces(x.data(), f.data());
        for (std::size_t q = 0; q < x.size(); ++q) {
            v[q] += dt * f[q] / mass[q / 3];
            x[q] += dt * v[q];
            largest = std::max(largest, std::abs(x[q] - start[q]));
        }
    }
    return largest;
}

TEST(StableStep, IsExactForOneElementAndSafeForABlock) {
    for (ElementVariant variant : test::all_variants) {
        const Body one = block({{2e-4, 2e-4, 1e-4}, {1, 1, 1}}, variant);
        const double step = stable_step_s(one);
        // A velocity of 1e-9 m/s over 4000 steps of 6e-7 s drifts by 3e-12 m.
        EXPECT_LT(growth(one, 0.99 * step), 1e-10);
        EXPECT_GT(growth(one, 1.01 * step), 1e-6);
        const Body many = block({{8e-4, 8e-4, 2e-4}, {4, 4, 2}}, variant);
        EXPECT_LT(growth(many, 0.99 * stable_step_s(many)), 1e-10);
    }
}

TEST(StableStep, RefusesABodyWithoutMass) {
    Body body = block({{1e-4, 1e-4, 1e-4}, {1, 1, 1}}, ElementVariant::full);
    body.material.density_kg_m3 = -100;
    EXPECT_THROW(stable_step_s(body), std::invalid_argument);
}

}  // namespace
}  // namespace magfsi::structure
