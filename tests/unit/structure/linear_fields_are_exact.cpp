// Patch test: in a homogeneous deformation of a distorted mesh no inner node feels a
// force, and the springs' energy is that of eq. (1), G/2 tr(F F^T) a volume.
#include <gtest/gtest.h>

#include "tests/unit/structure/elements.h"
#include "tests/unit/structure/plain_element.h"

namespace magfsi::structure {
namespace {

using test::all_variants;

Eigen::Matrix3d some_deformation() {
    Eigen::Matrix3d f;
    f << 1.1, 0.2, -0.1, 0.05, 0.9, 0.15, -0.2, 0.1, 1.05;
    return f;
}

TEST(LinearFields, SpringMatrixTurnsPositionsIntoGradientIntegrals) {
    test::Random random(3);
    for (ElementVariant variant : all_variants) {
        for (int trial = 0; trial < 20; ++trial) {
            const Positions8 x = test::distorted_element(random);
            const HexahedronIntegrals in = integrate_hexahedron(x, 0);
            const Positions8 product = spring_matrix(x, in, variant) * x;
            // Rounding, times the condition of the 4x4 system behind mean_f.
            EXPECT_LT((product - in.gradient).norm(), 1e-12 * in.gradient.norm());
        }
    }
}

TEST(LinearFields, PairSpringsGiveTheEnergyOfTheHomogeneousState) {
    test::Random random(4);
    const Eigen::Matrix3d f = some_deformation();
    for (ElementVariant variant : all_variants) {
        const Positions8 reference = test::distorted_element(random);
        const HexahedronIntegrals in = integrate_hexahedron(reference, 0);
        const Matrix8 springs = -spring_matrix(reference, in, variant);
        const Positions8 x = reference * f.transpose();
        double energy = 0;
        for (int a = 0; a < 8; ++a) {
            for (int b = a + 1; b < 8; ++b) {
                energy += 0.5 * springs(a, b) * (x.row(a) - x.row(b)).squaredNorm();
            }
        }
        const double expected = 0.5 * in.volume * f.squaredNorm();
        EXPECT_NEAR(energy / expected, 1, 1e-12);  // rounding of 28 terms of both signs
    }
}

TEST(LinearFields, InnerNodesOfADistortedPatchFeelNoForce) {
    const Mesh mesh = test::distorted_block({{6e-4, 6e-4, 3e-4}, {3, 3, 3}}, 8e-6, 5);
    const Eigen::Matrix3d f = some_deformation();
    const Material material = test::soft_material();
    for (ElementVariant variant : all_variants) {
        std::vector<Eigen::Vector3d> force(mesh.nodes.size(), Eigen::Vector3d::Zero());
        double largest = 0;
        for (std::size_t e = 0; e < mesh.elements.size(); ++e) {
            const Positions8 reference = gather(mesh.nodes, mesh.elements[e]);
            const ElementState state =
                element_energy(element_reference(reference, variant, 0), material,
                               reference * f.transpose());
            largest = std::max(largest, state.force_n.cwiseAbs().maxCoeff());
            for (int a = 0; a < 8; ++a) {
                force[mesh.elements[e][a]] += state.force_n.row(a).transpose();
            }
        }
        for (int k = 1; k < 3; ++k) {
            for (int j = 1; j < 3; ++j) {
                for (int i = 1; i < 3; ++i) {
                    // Eight element forces cancel: rounding against the largest of them.
                    EXPECT_LT(force[i + 4 * (j + 4 * k)].norm(), 1e-12 * largest);
                }
            }
        }
    }
}

}  // namespace
}  // namespace magfsi::structure
