#include <gtest/gtest.h>

#include "tests/unit/structure/elements.h"
#include "tests/unit/structure/plain_element.h"

namespace magfsi::structure {
namespace {

// Force of eq. (2)'s springs at rest, which the volume term balances: the scale of
// rounding.
double force_scale(const ElementReference& reference, const Material& material) {
    return material.shear_modulus_pa * reference.gradient.norm();
}
double energy_scale(const ElementReference& reference, const Material& material) {
    return material.shear_modulus_pa * reference.volume;
}

TEST(Rest, HasNoForceAndNoEnergy) {
    const Material material = test::soft_material();
    test::Random random(8);
    for (ElementVariant variant : test::all_variants) {
        const Positions8 x = test::distorted_element(random);
        const ElementReference reference = element_reference(x, variant, 0);
        const ElementState state = element_energy(reference, material, x);
        // ln J of a J that rounds to 1 + 1e-15, times K/G = 20.
        EXPECT_LT(state.force_n.norm(), 1e-12 * force_scale(reference, material));
        EXPECT_LT(std::abs(state.energy_j), 1e-12 * energy_scale(reference, material));
    }
}

TEST(Rotation, ChangesNoEnergyAndTurnsTheForces) {
    const Material material = test::soft_material();
    test::Random random(9);
    for (ElementVariant variant : test::all_variants) {
        for (int trial = 0; trial < 20; ++trial) {
            const Positions8 x0 = test::distorted_element(random);
            const ElementReference reference = element_reference(x0, variant, 0);
            const Positions8 x = random.moved(x0, 1.5e-5);
            const Eigen::Matrix3d r = random.rotation();
            const Eigen::RowVector3d shift(1e-3, -2e-3, 3e-3);
            const Positions8 turned = (x * r.transpose()).rowwise() + shift;
            const ElementState a = element_energy(reference, material, x);
            const ElementState b = element_energy(reference, material, turned);
            // The shift of 3e-3 m costs 1e-16 * 3e-3 / 1e-4 in relative positions, K/G =
            // 20 times that in forces.
            EXPECT_NEAR(a.energy_j, b.energy_j,
                        1e-12 * energy_scale(reference, material));
            EXPECT_LT((a.force_n * r.transpose() - b.force_n).norm(),
                      1e-12 * force_scale(reference, material));
        }
    }
}

TEST(Element, ExertsNoNetForceAndNoNetTorque) {
    const Material material = test::soft_material();
    test::Random random(10);
    for (ElementVariant variant : test::all_variants) {
        for (int trial = 0; trial < 20; ++trial) {
            const Positions8 x0 = test::distorted_element(random);
            const Positions8 x = random.moved(x0, 1.5e-5);
            const ElementState state =
                element_energy(element_reference(x0, variant, 0), material, x);
            Eigen::Vector3d torque = Eigen::Vector3d::Zero();
            for (int a = 0; a < 8; ++a) {
                torque += x.row(a).transpose().cross(
                    Eigen::Vector3d(state.force_n.row(a).transpose()));
            }
            // Sums of eight forces: rounding.
            EXPECT_LT(state.force_n.colwise().sum().norm(), 1e-13 * state.force_n.norm());
            EXPECT_LT(torque.norm(), 1e-13 * state.force_n.norm() * x.norm());
        }
    }
}

}  // namespace
}  // namespace magfsi::structure
