// SPDX-License-Identifier: GPL-2.0-or-later
// Strain stiffening: the laws against their definitions, elements and kernels against
// derivatives of the energy, and bodies against closed forms up to 90 % of the limiting
// stretch.
#include "structure/lattice/stiffening.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <functional>

#include "structure/equilibrium/newton.h"
#include "structure/lattice/plain_element.h"
#include "structure/lattice/stable_step.h"
#include "structure/lattice/strain.h"
#include "structure/lattice/tangent.h"
#include "tests/unit/structure/elements.h"

namespace magfsi::structure {
namespace {

Material rubber(const Stiffening& law) {
    Material material = test::soft_material();
    material.stiffening = law;
    return material;
}

std::vector<Material> materials() {
    return {rubber(Gent{2.0}), rubber(Yeoh{-2e3, 3e3}), rubber(ArrudaBoyce{1.5})};
}

// Root of a function that rises from below zero at `low` to above zero at `high`.
double root(const std::function<double(double)>& f, double low, double high) {
    for (int i = 0; i < 200; ++i) {
        const double middle = 0.5 * (low + high);
        (f(middle) < 0 ? low : high) = middle;
    }
    return 0.5 * (low + high);
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

// 45 elements, five batches and a part of one, of the four materials in turn.
Body mixed_block(bool bricks, ElementVariant variant) {
    const Box box{{10e-4, 6e-4, 1.5e-4}, {5, 3, 3}};
    Body body;
    body.name = "mixed";
    body.mesh = bricks ? box_mesh(box) : test::distorted_block(box, 3e-6, 14);
    body.material = test::soft_material();
    body.other_materials = materials();
    body.element = variant;
    for (std::size_t e = 0; e < body.mesh.elements.size(); ++e)
        body.element_material.push_back(static_cast<int>(e % 4));
    return body;
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

// --- bodies against closed forms ----------------------------------------------------

// Nearly incompressible, so that the closed forms are those of textbooks: the volume
// changes by stress / K, below 1e-4 of the stretches' effect.
Material incompressible(const Stiffening& law) {
    Material material = rubber(law);
    material.lame_lambda_pa = 1e5 * material.shear_modulus_pa;
    return material;
}

struct Mode {
    const char* name;
    std::vector<std::string> pulled;        // faces held along their normals
    std::function<Vec3(double)> stretches;  // of the first, incompressible
};

const std::vector<Mode>& modes() {
    static const std::vector<Mode> all{
        {"uniaxial",
         {"x_max"},
         [](double a) {
             return Vec3{a, 1 / std::sqrt(a), 1 / std::sqrt(a)};
         }},
        {"equibiaxial",
         {"x_max", "y_max"},
         [](double a) {
             return Vec3{a, a, 1 / (a * a)};
         }},
        {"pure shear",
         {"x_max", "y_max"},
         [](double a) {
             return Vec3{a, 1, 1 / a};
         }},
    };
    return all;
}

double invariant(const Vec3& stretches) {
    return dot(stretches, stretches);
}

// The cube, its faces at 0 on rollers, stretched affinely and let go.
double nominal_stress_pa(Body body, const Mode& mode, double stretch) {
    const auto roller = [&](const std::string& face) {
        body.rollers.push_back({{face}, face[0] - 'x'});
    };
    for (const char* face : {"x_min", "y_min", "z_min"}) roller(face);
    for (const std::string& face : mode.pulled) roller(face);
    const Vec3 stretches = mode.stretches(stretch);
    std::vector<Vec3> start = body.mesh.nodes;
    for (Vec3& x : start) {
        for (std::size_t d = 0; d < 3; ++d) x[d] *= stretches[d];
    }
    const Equilibrium found = NewtonSolver(body, {1e-8}).release(start, {});
    double pull_n = 0;
    for (const int node : body.mesh.faces.at("x_max")) pull_n += found.support_n[node][0];
    return pull_n / 1e-6;
}

TEST(StiffBody, FollowsTheClosedFormsTo90PercentOfTheLimit) {
    const struct {
        const char* name;
        Stiffening law;
        double limit;  // of I1 - 3
    } laws[] = {{"Gent", Gent{20}, 20},
                {"Arruda-Boyce", ArrudaBoyce{3}, 24},
                {"Yeoh", Yeoh{-1e3, 0.1e3}, 20}};  // no limit: as far as Gent's
    for (const auto& [name, law, limit] : laws) {
        for (const Mode& mode : modes()) {
            Body body;
            body.name = name;
            body.mesh = box_mesh({{1e-3, 1e-3, 1e-3}, {2, 2, 2}});
            body.material = incompressible(law);
            const StiffeningLaw factor = stiffening_law(body.material);
            const double most =
                root([&](double a) { return invariant(mode.stretches(a)) - 3 - limit; },
                     1, 100);
            double worst = 0;
            for (const double share : {0.3, 0.5, 0.7, 0.8, 0.9}) {
                const double a = share * most;
                if (a < 1.05) continue;
                const Vec3 stretches = mode.stretches(a);
                // dW/da1 - (a3/a1) dW/da3 of the nominal stress along the first axis.
                const double expected =
                    body.material.shear_modulus_pa *
                    stiffening_at(factor, invariant(stretches) - 3).factor *
                    (stretches[0] - stretches[2] * stretches[2] / stretches[0]);
                const double found = nominal_stress_pa(body, mode, a);
                worst = std::max(worst, std::abs(found / expected - 1));
            }
            std::printf("%s, %s to a stretch of %.2f: %.1e\n", name, mode.name,
                        0.9 * most, worst);
            EXPECT_LT(worst, 1e-3);
        }
    }
}

TEST(StiffBody, IsFoundByNewtonQuadratically) {
    Body body;
    body.name = "block";
    body.mesh = test::distorted_block({{1e-3, 1e-3, 1e-3}, {2, 2, 2}}, 3e-5, 3);
    body.material = rubber(Gent{5});
    body.clamps = {"x_min", "x_max"};
    StaticProblem problem(body);
    Eigen::VectorXd start = flat_positions(body.mesh.nodes);
    for (Eigen::Index q = 0; q < start.size(); q += 3) start[q] *= 1.8;
    const NodalLoads none = problem.load({});
    const Iterate found = energy_descent(problem, start, none, {0, 1e-13}, 60);
    test::Random random(4);
    Eigen::VectorXd x = found.x;
    for (Eigen::Index q = 0; q < x.size(); ++q)
        if (!held_axes(body)[q / 3][q % 3]) x[q] += 1e-6 * random.uniform();
    std::vector<double> error;
    for (int step = 0; step < 4; ++step) {
        error.push_back((x - found.x).cwiseAbs().maxCoeff() / 1e-3);
        problem.assemble(x, none);
        ASSERT_TRUE(problem.matrix().factorize());
        x += problem.matrix().solve(problem.response(x, none).residual_n);
    }
    std::printf("errors %.1e %.1e %.1e %.1e\n", error[0], error[1], error[2], error[3]);
    // Each error is the square of the one before, times the curvature of the law and of
    // the volume term; the last is rounding.
    EXPECT_LT(error[1], 100 * error[0] * error[0]);
    EXPECT_LT(error[2], std::max(100 * error[1] * error[1], 1e-11));
}

TEST(StiffBody, BeyondItsLimitIsRefusedWithItsPlace) {
    Body body;
    body.name = "block";
    body.mesh = box_mesh({{1e-3, 1e-3, 1e-3}, {2, 2, 2}});
    body.material = rubber(Gent{1});
    body.clamps = {"x_min", "x_max"};
    std::vector<Vec3> start = body.mesh.nodes;
    for (Vec3& x : start) x[0] *= 2;
    try {
        NewtonSolver(body).release(start, {});
        FAIL();
    } catch (const std::runtime_error& fault) {
        EXPECT_NE(std::string(fault.what()).find("of the limit of its material"),
                  std::string::npos)
            << fault.what();
    }
}

}  // namespace
}  // namespace magfsi::structure
