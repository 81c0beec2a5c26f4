// SPDX-License-Identifier: GPL-2.0-or-later
// Maxwell branches: the kernel against plain elements, and both against the closed forms
// of linear viscoelasticity: relaxation, creep, complex modulus; the energy that they
// take.
#include "structure/lattice/maxwell.h"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <cstdio>
#include <functional>
#include <numbers>

#include "structure/lattice/maxwell_kernel.h"
#include "structure/lattice/stable_step.h"
#include "tests/unit/structure/elements.h"

namespace magfsi::structure {
namespace {

Material rubber(std::vector<MaxwellBranch> branches) {
    Material material = test::soft_material();
    material.branches = std::move(branches);
    return material;
}

// --- the kernel ---------------------------------------------------------------------

// The branches are none, one and three in turn.
Body mixed_block(bool bricks, ElementVariant variant) {
    return test::mixed_block(
        bricks, variant,
        {rubber({{20e3, 0.1}}), rubber({{5e3, 1e-6}, {30e3, 0.03}, {10e3, 1e3}})});
}

std::vector<double> moved(const Mesh& mesh, unsigned seed) {
    test::Random random(seed);
    std::vector<double> x;
    for (const Vec3& node : mesh.nodes) {
        for (double c : node)
            x.push_back((1 + 0.05 * seed) * c + 5e-6 * random.uniform());
    }
    return x;
}

class BranchKernel : public ::testing::TestWithParam<InstructionSet> {};

TEST_P(BranchKernel, MatchesThePlainElementOverAFewSteps) {
    for (const bool bricks : {true, false}) {
        for (ElementVariant variant : test::all_variants) {
            const Body body = mixed_block(bricks, variant);
            const std::size_t count = body.mesh.elements.size();
            MaxwellKernel kernel(GetParam());
            kernel.assign(build_lattice(body));
            std::vector<MaxwellElement> plain(count);
            for (unsigned step = 0; step < 4; ++step) {
                const std::vector<double> x = moved(body.mesh, step);
                const double dt_s = step == 0 ? 0 : 0.02;
                std::vector<double> expected(x.size(), 0.0), force(x.size(), 0.0);
                double energy = 0, lost = 0, scale = 0;
                for (std::size_t e = 0; e < count; ++e) {
                    const Hexahedron& nodes = body.mesh.elements[e];
                    Positions8 xe;
                    for (int q = 0; q < 24; ++q)
                        xe(q / 3, q % 3) = x[3 * nodes[q / 3] + q % 3];
                    const ElementReference reference = element_reference(
                        gather(body.mesh.nodes, nodes), variant, static_cast<int>(e));
                    const Material& material = material_of(body, e);
                    if (step == 0)
                        plain[e] = MaxwellElement::at_rest(reference, material, xe);
                    const auto state = plain[e].advance(reference, material, xe, dt_s);
                    energy += state.energy_j;
                    lost += state.dissipation_w;
                    for (int q = 0; q < 24; ++q)
                        expected[3 * nodes[q / 3] + q % 3] += state.force_n(q / 3, q % 3);
                }
                const MaxwellResult result =
                    kernel.add_forces(x.data(), dt_s, force.data(), false);
                std::vector<double> again(x.size(), 0.0);
                const MaxwellResult stored =
                    kernel.add_forces(x.data(), 0, again.data(), true);
                for (const double f : expected) scale = std::max(scale, std::abs(f));
                for (std::size_t q = 0; q < x.size(); ++q) {
                    ASSERT_NEAR(force[q], expected[q], 1e-11 * scale);
                    ASSERT_NEAR(again[q], force[q], 1e-11 * scale);
                }
                if (step == 0) {
                    EXPECT_EQ(scale, 0);
                    continue;
                }
                // The other order of sums, and what cancels in energies of small strain.
                EXPECT_NEAR(result.dissipation_w / lost, 1, 1e-9);
                EXPECT_NEAR(stored.energy_j / energy, 1, 1e-9);
            }
        }
    }
}

// The states taken out and put into another kernel, in which elements have other places.
TEST_P(BranchKernel, GoesOnFromAStateThatItIsGiven) {
    const Body body = mixed_block(true, ElementVariant::assumed_strain);
    const Lattice lattice = build_lattice(body);
    MaxwellKernel first(GetParam()), second(GetParam());
    first.assign(lattice);
    std::vector<int> order;
    std::vector<std::array<int, 8>> nodes;
    for (int e = static_cast<int>(lattice.elements.size()) - 1; e >= 0; --e) {
        order.push_back(e);
        nodes.push_back(lattice.elements[e]);
    }
    second.assign(lattice, order, nodes);
    std::vector<double> dropped(3 * body.mesh.nodes.size());
    for (unsigned step = 0; step < 3; ++step) {
        first.add_forces(moved(body.mesh, step).data(), step * 0.01, dropped.data(),
                         false);
    }
    for (const int e : order) {
        const std::size_t numbers = maxwell_numbers;
        EXPECT_EQ(first.values(e), numbers * (e % 3 == 0 ? 0u : e % 3 == 1 ? 2u : 4u));
        if (!first.has(e)) continue;
        std::vector<double> state(first.values(e));
        first.get(e, state);
        second.set(e, state);
    }
    std::vector<double> here(dropped.size(), 0.0), there(dropped.size(), 0.0);
    const auto x = moved(body.mesh, 3);
    first.add_forces(x.data(), 0.01, here.data(), false);
    second.add_forces(x.data(), 0.01, there.data(), false);
    double scale = 0;
    for (const double f : here) scale = std::max(scale, std::abs(f));
    for (std::size_t q = 0; q < here.size(); ++q)
        ASSERT_NEAR(here[q], there[q], 1e-13 * scale);  // other order of sums
}

INSTANTIATE_TEST_SUITE_P(Isa, BranchKernel,
                         ::testing::ValuesIn(available_instruction_sets()),
                         [](const auto& set) { return name(set.param); });

TEST(Branches, RefuseWhatIsNotPositive) {
    Body body;
    body.mesh = box_mesh({{1e-3, 1e-3, 1e-3}, {1, 1, 1}});
    for (const MaxwellBranch& branch :
         {MaxwellBranch{-1, 1}, MaxwellBranch{1, 0}, MaxwellBranch{NAN, 1}}) {
        body.material = rubber({branch});
        MaxwellKernel kernel;
        EXPECT_THROW(kernel.assign(build_lattice(body)), std::invalid_argument);
    }
}

// --- closed forms -------------------------------------------------------------------

// A cube of 1 mm in simple shear, or pulled at constant volume.
class Cube {
  public:
    explicit Cube(const Material& material, ElementVariant variant = {}) {
        body_.mesh = box_mesh({{1e-3, 1e-3, 1e-3}, {1, 1, 1}});
        body_.material = material;
        body_.element = variant;
        const Lattice lattice = build_lattice(body_);
        elastic_.assign(lattice);
        branches_.assign(lattice);
        (void)take(Eigen::Matrix3d::Identity(), 0);
    }
    // Nominal shear stress P_xz [Pa] of the branches, or of all, after a step to F.
    double take(const Eigen::Matrix3d& f, double dt_s, bool all = false) {
        std::vector<double> force(24, 0.0);
        const auto x = places(f);
        const MaxwellResult result =
            branches_.add_forces(x.data(), dt_s, force.data(), false);
        dissipation_w = result.dissipation_w;
        if (all) elastic_.add_forces(x.data(), force.data());
        double pull = 0;
        for (std::size_t n = 0; n < 8; ++n)
            if (body_.mesh.nodes[n][2] > 0.5e-3) pull -= force[3 * n];
        return pull / 1e-6;
    }
    double stored_j(const Eigen::Matrix3d& f) {
        std::vector<double> force(24, 0.0);
        return branches_.add_forces(places(f).data(), 0, force.data(), true).energy_j;
    }
    double dissipation_w = 0;

  private:
    std::vector<double> places(const Eigen::Matrix3d& f) const {
        std::vector<double> x;
        for (const Vec3& node : body_.mesh.nodes) {
            const Eigen::Vector3d at = f * Eigen::Vector3d(node[0], node[1], node[2]);
            x.insert(x.end(), at.data(), at.data() + 3);
        }
        return x;
    }
    Body body_;
    ElementKernel elastic_;
    MaxwellKernel branches_;
};

Eigen::Matrix3d shear(double gamma) {
    Eigen::Matrix3d f = Eigen::Matrix3d::Identity();
    f(0, 2) = gamma;
    return f;
}

const std::vector<MaxwellBranch> three{{20e3, 1e-3}, {10e3, 0.1}, {40e3, 3.0}};

TEST(Branches, RelaxAsExponentialsFromTheirModuliAtOnce) {
    for (const double gamma : {1e-4, 0.8}) {
        Cube cube(rubber(three));
        double t = 0;
        // At once, against every time; then by steps of all lengths.
        (void)cube.take(shear(gamma), 1e-9);
        for (const double dt : {1e-5, 1e-3, 0.02, 0.3, 1.0, 5.0}) {
            t += dt;
            double expected = 0;  // G gamma: C^-1 is linear in gamma off its diagonal
            for (const auto& [modulus, time] : three)
                expected += modulus * gamma * std::exp(-t / time);
            // The jump took 1e-9 s: 5e-7 of the fastest time.
            EXPECT_NEAR(cube.take(shear(gamma), dt) / expected, 1, 1e-6) << gamma << t;
        }
    }
}

// C^-1 of this motion changes evenly: one step is as good as many.
TEST(Branches, AreExactInAStepAtAConstantRate) {
    const auto pulled = [](double t) {
        Eigen::Matrix3d f = Eigen::Matrix3d::Identity();
        f(0, 0) = 1 / std::sqrt(1 - 0.2 * t);
        f(2, 2) = 1 / std::sqrt(1 + 0.3 * t);
        return f;
    };
    Cube once(rubber(three)), often(rubber(three));
    (void)once.take(pulled(1), 1);
    for (int i = 1; i <= 1000; ++i) (void)often.take(pulled(i / 1000.0), 1e-3);
    const double stored = often.stored_j(pulled(1));
    EXPECT_NEAR(once.stored_j(pulled(1)) / stored, 1, 1e-10);  // rounding of 1000 steps
    EXPECT_GT(stored, 0);
}

// Creep of the standard solid: gamma = s/G [1 - G1/(G + G1) exp(-t G / ((G + G1) tau))].
TEST(Branches, CreepAsTheStandardSolid) {
    const double g = test::soft_material().shear_modulus_pa, g1 = 50e3, tau = 0.2;
    Cube cube(rubber({{g1, tau}}));
    const double stress = 1e-4 * g, dt = 5e-3;
    const double time = tau * (g + g1) / g;
    double gamma = stress / (g + g1);
    double worst = std::abs(cube.take(shear(gamma), 1e-9, true) / stress - 1);
    // The strain of each step is the root of a linear equation: the stress of no further
    // strain, and the stiffness g + g1 times the gain of the step.
    const double gain = -std::expm1(-dt / tau) * tau / dt;
    double branch = g1 * gamma;
    for (int i = 1; i <= 400; ++i) {
        branch *= std::exp(-dt / tau);
        const double change = (stress - g * gamma - branch) / (g + g1 * gain);
        gamma += change;
        branch += g1 * gain * change;
        worst = std::max(worst, std::abs(cube.take(shear(gamma), dt, true) / stress - 1));
        const double expected =
            stress / g * (1 - g1 / (g + g1) * std::exp(-i * dt / time));
        worst = std::max(worst, std::abs(gamma / expected - 1));
    }
    std::printf("creep: %.1e\n", worst);
    // (dt/tau)^2 / 24 of steps between which the strain is not linear.
    EXPECT_LT(worst, 1e-3);
}

TEST(Branches, HaveTheirComplexModulusOverFourDecades) {
    Material material = rubber(three);
    material.viscosity_pa_s = 0;
    double worst = 0;
    for (double omega = 0.1; omega < 2e3; omega *= 10) {
        Cube cube(material);
        const double amplitude = 1e-4;
        constexpr int steps = 200;  // (omega dt)^2 / 24 = 4e-5
        const double dt = 2 * std::numbers::pi / omega / steps;
        // Until the slowest branch has forgotten the start, to 1e-4; a whole period.
        const int periods = 1 + static_cast<int>(10 * three.back().time_s * omega /
                                                 (2 * std::numbers::pi));
        std::complex<double> sum = 0;
        for (int i = 1; i <= periods * steps + steps; ++i) {
            const double angle = 2 * std::numbers::pi * i / steps;
            const double stress = cube.take(shear(amplitude * std::sin(angle)), dt, true);
            if (i > periods * steps)
                sum += 2.0 / steps / amplitude * stress *
                       std::complex<double>(std::sin(angle), std::cos(angle));
        }
        const ComplexModulus expected = complex_modulus(material, omega);
        const double storage = sum.real() / expected.storage_pa - 1;
        const double loss = sum.imag() / expected.loss_pa - 1;
        std::printf("%.3g rad/s: G' %.4g (%+.1e), G'' %.4g (%+.1e) Pa\n", omega,
                    expected.storage_pa, storage, expected.loss_pa, loss);
        worst = std::max({worst, std::abs(storage), std::abs(loss)});
    }
    EXPECT_LT(worst, 5e-3);
}

// The work on a cube that is sheared to and fro is stored or lost, to second order.
TEST(Branches, StoreOrLoseTheWorkOnThem) {
    const auto imbalance = [](int steps) {
        Cube cube(rubber(three));
        double work = 0, lost = 0, before_pa = 0, before_w = 0, before = 0;
        for (int i = 1; i <= steps; ++i) {
            const double t = 1.0 * i / steps, gamma = 0.6 * std::sin(4 * t);
            const double now_pa = cube.take(shear(gamma), 1.0 / steps);
            work += 0.5 * (before_pa + now_pa) * (gamma - before) * 1e-9;
            lost += 0.5 * (before_w + cube.dissipation_w) / steps;
            before_pa = now_pa;
            before_w = cube.dissipation_w;
            before = gamma;
        }
        EXPECT_GT(lost, 0);
        return std::abs(work - lost - cube.stored_j(shear(before))) / work;
    };
    const double coarse = imbalance(1000), fine = imbalance(2000);
    std::printf("imbalance %.1e, %.1e\n", coarse, fine);
    EXPECT_LT(coarse, 1e-4);
    EXPECT_LT(fine, 0.35 * coarse);
}

// Rotations of the whole cube change no stress in its own frame.
TEST(Branches, TurnWithTheBody) {
    const Material material = rubber(three);
    test::Random random(5);
    const Positions8 rest = test::distorted_element(random);
    const ElementReference reference = element_reference(rest, ElementVariant::full, 0);
    const Positions8 x = random.moved(rest, 1e-5);
    const Eigen::Matrix3d turn = random.rotation();
    auto still = MaxwellElement::at_rest(reference, material, rest);
    auto turned = still;
    const auto a = still.advance(reference, material, x, 0.01);
    const auto b = turned.advance(reference, material, x * turn.transpose(), 0.01);
    EXPECT_LT((b.force_n - a.force_n * turn.transpose()).norm(),
              1e-11 * a.force_n.norm());
    EXPECT_NEAR(b.energy_j / a.energy_j, 1, 1e-9);
}

// The stable step is that of the unrelaxed solid, whatever the times.
TEST(Branches, AskForTheStepOfAllTheirModuli) {
    Body body;
    body.name = "bar";
    body.mesh = box_mesh({{4e-3, 1e-3, 1e-3}, {4, 1, 1}});
    body.material = rubber(three);
    const double step = stable_step_s(body);
    for (MaxwellBranch& branch : body.material.branches) branch.time_s = 1e-9;
    EXPECT_DOUBLE_EQ(stable_step_s(body), step);
    body.material.branches.clear();
    const double slow = stable_step_s(body);
    body.material.shear_modulus_pa += 70e3;
    const double unrelaxed = stable_step_s(body);
    std::printf("step %.3g of the relaxed one, unrelaxed solid %.3g\n", step / slow,
                unrelaxed / slow);
    EXPECT_LT(step, slow);
    // A solid of the sum has the same K; its hourglass law has another thinning.
    EXPECT_NEAR(step / unrelaxed, 1, 0.02);
}

}  // namespace
}  // namespace magfsi::structure
