// SPDX-License-Identifier: GPL-2.0-or-later
// Strain stiffening: the laws against their definitions, elements and kernels against
// derivatives of the energy.
#include "structure/lattice/stiffening.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <functional>

#include "structure/lattice/element_kernel.h"
#include "structure/lattice/lattice.h"
#include "structure/lattice/plain_element.h"
#include "structure/lattice/stable_step.h"
#include "structure/lattice/strain.h"
#include "structure/lattice/tangent.h"
#include "tests/unit/structure/rubber.h"

namespace magfsi::structure {
namespace {

using test::root;
using test::rubber;

std::vector<Material> materials() {
    return {rubber(Gent{2.0}), rubber(Yeoh{-2e3, 3e3}), rubber(ArrudaBoyce{1.5})};
}

double inverse_langevin(double y) {
    return root([y](double b) { return 1 / std::tanh(b) - 1 / b - y; }, 1e-6, 1e6);
}

TEST(Stiffening, OfChainsIsTheInverseLangevinFunction) {
    for (const double locking : {1.2, 3.0, 7.0}) {
        const StiffeningLaw law = stiffening_law(rubber(ArrudaBoyce{locking}));
        const double at_rest = inverse_langevin(1 / locking) * locking;
        double worst = 0;
        for (double y = 1 / locking; y < 0.98; y += 0.002) {
            const double s = 3 * locking * locking * y * y - 3;
            if (s > law.straight_from) break;
            const double exact = inverse_langevin(y) / y / at_rest;
            worst = std::max(worst, std::abs(stiffening_at(law, s).factor / exact - 1));
        }
        std::printf("chains that lock at %g: %.1e\n", locking, worst);
        // The fit of the smooth rest of the function, twice: here and at rest.
        EXPECT_LT(worst, 1e-4);
    }
}

TEST(Stiffening, HasTheDerivativeAndTheIntegralOfItsFactor) {
    for (const Material& material : materials()) {
        const StiffeningLaw law = stiffening_law(material);
        EXPECT_NEAR(stiffening_at(law, 0).factor, 1, 1e-14);
        EXPECT_EQ(stiffening_at(law, 0).integral, 0);
        const double end = law.limit < 1e100 ? law.limit : 5;
        const double h = 1e-5 * end;  // truncation h^2 times the pole's third derivative
        // The last is beyond the limit, where the law is straight.
        for (const double share : {-0.1, 0.0, 0.3, 0.9, 0.97, 1.2}) {
            const double s = share * end;
            const auto at = stiffening_at(law, s);
            const auto to = stiffening_at(law, s + h), from = stiffening_at(law, s - h);
            EXPECT_NEAR((to.factor - from.factor) / (2 * h) / at.slope, 1, 1e-6) << share;
            EXPECT_NEAR((to.integral - from.integral) / (2 * h) / at.factor, 1, 1e-6);
        }
    }
}

TEST(Stiffening, RefusesLawsThatLoseTheirStiffness) {
    EXPECT_THROW(stiffening_law(rubber(Yeoh{-20e3, 1e3})), std::invalid_argument);
    EXPECT_THROW(stiffening_law(rubber(Yeoh{1e3, -1e3})), std::invalid_argument);
    EXPECT_THROW(stiffening_law(rubber(Gent{0})), std::invalid_argument);
    EXPECT_THROW(stiffening_law(rubber(ArrudaBoyce{1})), std::invalid_argument);
}

// --- elements -----------------------------------------------------------------------

TEST(StiffElement, HasForceAndTangentOfItsEnergyInRandomStates) {
    const double h = 1e-9;  // of 1e-4: truncation (h/l)^2 = 1e-10, rounding about 1e-9
    test::Random random(7);
    for (const Material& material : materials()) {
        for (ElementVariant variant : test::all_variants) {
            for (int trial = 0; trial < 5; ++trial) {
                const Positions8 rest = test::distorted_element(random);
                const ElementReference reference = element_reference(rest, variant, 0);
                const Positions8 x =
                    random.moved(1.1 * rest * random.rotation().transpose(), 1.5e-5);
                const ElementState state = element_energy(reference, material, x);
                ASSERT_GT(state.volume_ratio, 0);
                const Matrix24 tangent = element_tangent(reference, material, x);
                for (int q = 0; q < 24; ++q) {
                    Positions8 plus = x, minus = x;
                    plus(q / 3, q % 3) += h;
                    minus(q / 3, q % 3) -= h;
                    const auto to = element_energy(reference, material, plus),
                               from = element_energy(reference, material, minus);
                    // As for the neo-Hookean element, times the law's stiffening.
                    EXPECT_NEAR(state.force_n(q / 3, q % 3),
                                (from.energy_j - to.energy_j) / (2 * h),
                                1e-6 * state.force_n.norm());
                    const Positions8 slope = (from.force_n - to.force_n) / (2 * h);
                    for (int p = 0; p < 24; ++p) {
                        EXPECT_NEAR(tangent(p, q), slope(p / 3, p % 3),
                                    1e-7 * tangent.norm());
                    }
                }
            }
        }
    }
}

TEST(StiffElement, HasTheStressOfItsForcesInAHomogeneousState) {
    Eigen::Matrix3d f;
    f << 1.3, 0.2, -0.1, 0.05, 0.9, 0.15, -0.2, 0.1, 1.05;
    test::Random random(8);
    for (const Material& material : materials()) {
        const Positions8 rest = test::distorted_element(random);
        const ElementReference reference =
            element_reference(rest, ElementVariant::assumed_strain, 0);
        const auto s = cauchy_stress_pa(material, f);
        Eigen::Matrix3d sigma;
        sigma << s[0], s[3], s[5], s[3], s[1], s[4], s[5], s[4], s[2];
        const Eigen::Matrix3d piola = f.determinant() * sigma * f.inverse().transpose();
        const Positions8 expected = -reference.gradient * piola.transpose();
        const Positions8 found =
            element_energy(reference, material, rest * f.transpose()).force_n;
        EXPECT_LT((found - expected).norm(), 1e-12 * expected.norm());  // rounding
    }
}

// --- kernels ------------------------------------------------------------------------

std::vector<double> moved(const Mesh& mesh, double amplitude_m) {
    test::Random random(13);
    std::vector<double> x;
    for (const Vec3& node : mesh.nodes) {
        for (double c : node) x.push_back(1.1 * c + amplitude_m * random.uniform());
    }
    return x;
}

Body mixed_block(bool bricks, ElementVariant variant) {
    return test::mixed_block(bricks, variant, materials());
}

class StiffKernel : public ::testing::TestWithParam<InstructionSet> {};

TEST_P(StiffKernel, MatchesThePlainElement) {
    for (const bool bricks : {true, false}) {
        for (ElementVariant variant : test::all_variants) {
            const Body body = mixed_block(bricks, variant);
            const std::vector<double> x = moved(body.mesh, 5e-6);
            std::vector<double> expected(x.size(), 0.0), force(x.size(), 0.0);
            double energy = 0, share = 0, scale = 0;
            int tight = -1;
            for (std::size_t e = 0; e < body.mesh.elements.size(); ++e) {
                const Hexahedron& nodes = body.mesh.elements[e];
                Positions8 xe;
                for (int q = 0; q < 24; ++q)
                    xe(q / 3, q % 3) = x[3 * nodes[q / 3] + q % 3];
                const ElementReference reference = element_reference(
                    gather(body.mesh.nodes, nodes), variant, static_cast<int>(e));
                const Material& material = material_of(body, e);
                const ElementState state = element_energy(reference, material, xe);
                energy += state.energy_j;
                for (int q = 0; q < 24; ++q)
                    expected[3 * nodes[q / 3] + q % 3] += state.force_n(q / 3, q % 3);
                if (!material.stiffening) continue;
                const Positions8 near = xe.rowwise() - xe.colwise().mean();
                const double its = distortion(reference, material, near).share;
                if (its <= share) continue;
                share = its;
                tight = static_cast<int>(e);
            }
            for (const double f : expected) scale = std::max(scale, std::abs(f));
            ElementKernel kernel(GetParam());
            kernel.assign(build_lattice(body));
            const KernelResult result =
                kernel.add_forces_and_energy(x.data(), force.data());
            // Other order of the same sums: a few roundings of K l^2 each.
            for (std::size_t q = 0; q < x.size(); ++q)
                ASSERT_NEAR(force[q], expected[q], 1e-11 * scale);
            EXPECT_NEAR(result.energy_j / energy, 1, 1e-11);
            EXPECT_NEAR(result.largest_share / share, 1, 1e-11);
            EXPECT_EQ(result.tight_element, tight);
            std::vector<double> again(x.size(), 0.0);
            EXPECT_EQ(kernel.add_forces(x.data(), again.data()).tight_element, tight);
            for (std::size_t q = 0; q < x.size(); ++q)
                ASSERT_NEAR(again[q], force[q], 1e-12 * scale);
        }
    }
}

// The same bytes: elements without stiffening beside others, and a Yeoh material whose
// constants are 0.
TEST_P(StiffKernel, LeavesNeoHookeanElementsAsTheyAre) {
    for (ElementVariant variant : test::all_variants) {
        Body body = mixed_block(true, variant);
        const std::vector<double> x = moved(body.mesh, 5e-6);
        body.other_materials.clear();
        body.element_material.clear();
        const auto forces = [&] {
            std::vector<double> force(x.size(), 0.0);
            ElementKernel kernel(GetParam());
            kernel.assign(build_lattice(body));
            const KernelResult result = kernel.add_forces(x.data(), force.data());
            EXPECT_EQ(result.tight_element, -1);
            return force;
        };
        const auto plain = forces();
        body.material.stiffening = Yeoh{0, 0};
        EXPECT_EQ(forces(), plain);
    }
}

INSTANTIATE_TEST_SUITE_P(Isa, StiffKernel,
                         ::testing::ValuesIn(available_instruction_sets()),
                         [](const auto& set) { return name(set.param); });

TEST(StiffStep, FallsAsTheElementsStiffen) {
    Body body;
    body.name = "bar";
    body.mesh = box_mesh({{4e-3, 1e-3, 1e-3}, {4, 1, 1}});
    body.material = test::soft_material();
    const double neo_hookean = stable_step_s(body);
    body.material.stiffening = Gent{3.0};
    // The term of f' at rest: 2 G f' beside K + 2 G = 22 G.
    EXPECT_NEAR(stable_step_s(body) / neo_hookean, 1, 0.03);
    const CurrentStep step(body);
    double last = 0;
    for (const double stretch : {1.2, 1.6, 2.0}) {
        std::vector<Vec3> nodes = body.mesh.nodes;
        for (Vec3& x : nodes) {
            x[0] *= stretch;
            x[1] /= std::sqrt(stretch);
            x[2] /= std::sqrt(stretch);
        }
        const double rise = step.rise_1_s2(nodes);
        EXPECT_GT(rise, last);
        last = rise;
        // No state vibrates faster than the step says: the largest eigenvalue of an
        // element's tangent over its masses, an eighth of the element's each.
        const ElementReference reference = element_reference(
            gather(body.mesh.nodes, body.mesh.elements[0]), body.element, 0);
        const Matrix24 tangent = element_tangent(reference, body.material,
                                                 gather(nodes, body.mesh.elements[0]));
        const double mass = body.material.density_kg_m3 * reference.volume / 8;
        const double omega = std::sqrt(
            Eigen::SelfAdjointEigenSolver<Matrix24>(tangent).eigenvalues()(23) / mass);
        const double limit = CurrentStep::step_s(stable_step_s(body), rise);
        std::printf("stretch %g: step %.3g of the rest's, the state's own %.3g\n",
                    stretch, limit / stable_step_s(body),
                    2 / omega / stable_step_s(body));
        EXPECT_LT(limit, 1.01 * 2 / omega);
    }
}

}  // namespace
}  // namespace magfsi::structure
