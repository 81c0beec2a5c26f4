// SPDX-License-Identifier: GPL-2.0-or-later
// What else loads a body at rest: a field gradient, a platform, faces that are moved; and
// what holds it there.
#include <gtest/gtest.h>

#include <cmath>

#include "structure/equilibrium/newton.h"
#include "structure/mesh/surface.h"
#include "tests/unit/structure/derivatives.h"
#include "tests/unit/structure/elements.h"

namespace magfsi::structure {
namespace {

constexpr Vec3 size_m{4e-3, 1e-3, 1e-3};
constexpr double volume_m3 = 4e-9, area_m2 = 1e-6;
constexpr double magnetization_a_m = 50e3;

Body bar() {
    Body body;
    body.name = "bar";
    body.mesh = box_mesh({size_m, {8, 2, 2}});
    body.material = test::soft_material();
    return body;
}

FieldGradient gradient() {
    return FieldGradient(GradientInput{
        {{{2.0, 0.5, 0.3}, {0.5, -3.0, 0.2}, {0.3, 0.2, 1.0}}}, {1e-3, -2e-3, 5e-3}});
}

Vec3 sum(const std::vector<Vec3>& forces) {
    Vec3 out{};
    for (const Vec3& f : forces) out += f;
    return out;
}

// Central differences of the residual, with nodes behind the platform and before it.
TEST(Surroundings, TangentIsTheDerivativeOfTheForces) {
    Body body = bar();
    body.mesh = box_mesh({size_m, {2, 1, 1}});
    body.clamps = {"x_min"};
    body.magnetization_a_m =
        uniform_magnetization(body.mesh, {magnetization_a_m, 2e4, -1e4});
    Surroundings around{.gradient = gradient()};
    around.platform = Platform{{0, 0, 0.4e-3}, {0.6, 0, 0.8}, 1e8};
    StaticProblem problem(body, around);
    test::Random random(4);
    Eigen::VectorXd x = flat_positions(body.mesh.nodes);
    for (double& value : x) value += 2e-5 * random.uniform();
    const NodalLoads loads = problem.load({{1e-3, 0, 2e-3}, {}, 0.7});
    problem.assemble(x, loads);
    const Eigen::MatrixXd tangent = test::whole_tangent(problem);
    // Forces of order 1e-2 N / 1e-9 m: differences have 1e-6 of the largest entry, and
    // gradient and platform are far above that.
    test::expect_derivatives(problem, body, x, loads, tangent,
                             1e-5 * tangent.cwiseAbs().maxCoeff(), 1e-6);
}

// Of an elongated bar on rollers all around: lambda along x, nothing across. The energy
// G/2 (lambda^2 - 1) + K/2 (ln lambda)^2 - G ln lambda a volume pulls its end by
// A (G lambda + (K ln lambda - G) / lambda), by whichever element.
TEST(Surroundings, DrivenEndPullsAsTheStretchedSolidDoes) {
    for (const ElementVariant variant : test::all_variants) {
        for (const double stretch : {0.7, 1.5}) {
            Body body = bar();
            body.element = variant;
            body.clamps = {"x_max"};
            body.rollers = {
                {{"x_min"}, 0}, {{"y_min", "y_max"}, 1}, {{"z_min", "z_max"}, 2}};
            NewtonSolver solver(body, {}, {.driven = {body.mesh.faces.at("x_max")}});
            const StaticLoads pulled{.driven_m = {{(stretch - 1) * size_m[0], 0, 0}}};
            const Equilibrium found =
                solver.follow(body.mesh.nodes, {}, {&pulled, 1}).front();
            double reaction_n = 0;
            for (const int n : body.mesh.faces.at("x_max"))
                reaction_n += found.support_n[static_cast<std::size_t>(n)][0];
            const double g = body.material.shear_modulus_pa;
            const double k = body.material.lame_lambda_pa;
            const double expected =
                area_m2 * (g * stretch + (k * std::log(stretch) - g) / stretch);
            EXPECT_NEAR(reaction_n / expected, 1, 1e-8)
                << stretch;  // the tolerance, 1e-9
            EXPECT_NEAR(sum(found.support_n)[0] / expected, 0, 1e-8);
            EXPECT_EQ(found.releases, 0);
        }
    }
}

// The whole load goes into what holds the body, whatever its shape. In a uniform field
// there is none; a gradient A pulls at integral of A F M, F M V from the shape.
TEST(Surroundings, SupportsBearTheWholeLoad) {
    Body body = bar();
    body.clamps = {"x_min"};
    body.rollers = {{{"x_max"}, 1}};
    body.magnetization_a_m = uniform_magnetization(body.mesh, {magnetization_a_m, 0, 0});
    const StaticLoads loads{{0, 0, 5e-3}, {0, 3, -9.81}, 1};
    const Equilibrium found =
        NewtonSolver(body, {}, {.gradient = gradient()}).solve(loads);
    const auto charge =
        nodal_charges(body.mesh.nodes, body.mesh.elements, body.magnetization_a_m);
    Eigen::Vector3d moment = Eigen::Vector3d::Zero();  // integral of F M
    for (std::size_t n = 0; n < charge.size(); ++n)
        moment += charge[n] * Eigen::Map<const Eigen::Vector3d>(found.nodes_m[n].data());
    const Eigen::Vector3d pull = gradient().tesla_per_m() * moment;
    const Vec3 borne = sum(found.support_n);
    for (int d = 0; d < 3; ++d) {
        const double mass_kg = body.material.density_kg_m3 * volume_m3;
        const auto axis = static_cast<std::size_t>(d);
        const double load_n = mass_kg * loads.gravity_m_s2[axis] + pull[d];
        // Residuals of 1e-9 of the largest nodal load on 100 nodes.
        EXPECT_NEAR(borne[axis], -load_n, 1e-7 * mass_kg * 9.81);
    }
    EXPECT_GT(std::abs(pull[2]) / (7.4e-6 * 9.81), 0.1);  // it counts
}

// In dB_z/dx = dB_x/dz = a a cantilever along x, magnetised along itself, has for the
// deflection w the energy - M a A integral of (w + x w') dx = - M a A L w(L): a load
// M a A L at its tip, which deflects it 8/3 times as far as spread evenly over it, less
// what shear adds (Timoshenko's beam, s = E I / (k G A L^2), k = 5/6).
TEST(Surroundings, GradientBendsAsALoadAtTheTip) {
    Body body = bar();
    body.mesh = box_mesh({{8e-3, 1e-3, 1e-3}, {32, 2, 2}});
    body.clamps = {"x_min"};
    body.magnetization_a_m = uniform_magnetization(body.mesh, {magnetization_a_m, 0, 0});
    const double a = 1e-5;
    const FieldGradient along(
        GradientInput{{{{0, 0, a}, {0, 0, 0}, {a, 0, 0}}}, {0, 0, 0}});
    const auto tip_m = [](const Equilibrium& found) {
        return found.nodes_m.back()[2] - size_m[2];
    };
    const double pulled =
        tip_m(NewtonSolver(body, {}, {.gradient = along}).solve({{}, {}, 1}));
    const double spread = tip_m(NewtonSolver(body).solve(
        {{}, {0, 0, a * magnetization_a_m / body.material.density_kg_m3}}));
    const double g = body.material.shear_modulus_pa, k = body.material.lame_lambda_pa;
    const double s = (3 * k + 2 * g) / (k + g) / 12 / (64 * 5.0 / 6);
    // The mesh is the same; Timoshenko's k is not exact.
    EXPECT_NEAR(pulled / spread / (8.0 / 3 * (1 + 3 * s) / (1 + 4 * s)), 1, 0.01);
}

// A block sinks in by its weight over the stiffness, and the platform bears all of it.
TEST(Surroundings, PlatformBearsTheWeight) {
    Body body = bar();
    const double gravity = 9.81, pa_m = 1e8;
    Surroundings around;
    around.platform = Platform{{0, 0, -1e-4}, {0, 0, 1}, pa_m};
    NewtonSolver solver(body, {}, around);
    const Equilibrium found = solver.release(body.mesh.nodes, {{}, {0, 0, -gravity}});
    double pushed_n = 0;
    const auto surface = surface_areas(body.mesh.nodes, body.mesh.elements);
    for (std::size_t n = 0; n < surface.size(); ++n)
        pushed_n += pa_m * surface[n] * std::max(0.0, -1e-4 - found.nodes_m[n][2]);
    const double weight_n = body.material.density_kg_m3 * volume_m3 * gravity;
    EXPECT_NEAR(pushed_n / weight_n, 1, 1e-7);  // as above
    EXPECT_EQ(found.negative_eigenvalues, 0);
    // It stays where it lies, and falls without end where the plane is not level.
    EXPECT_THROW(solver.release(body.mesh.nodes, {{}, {1, 0, -gravity}}),
                 std::invalid_argument);
    EXPECT_THROW(solver.release(body.mesh.nodes, {{}, {0, 0, gravity}}),
                 std::invalid_argument);
}

TEST(Surroundings, GradientTakesAFreeBodyAway) {
    Body body = bar();
    body.magnetization_a_m = uniform_magnetization(body.mesh, {magnetization_a_m, 0, 0});
    EXPECT_THROW(NewtonSolver(body, {}, {.gradient = gradient()}), std::invalid_argument);
}

TEST(HeldFaces, ShareTheNodesOfTheirEdges) {
    Body body = bar();
    body.clamps = {"x_min", "x_max"};
    body.rollers = {{{"y_min"}, 1}, {{"y_min", "z_min"}, 2}};
    const auto faces = held_faces(body);
    ASSERT_EQ(faces.size(), 4);
    const auto held = held_axes(body);
    for (std::size_t d = 0; d < 3; ++d) {
        std::vector<int> times(body.mesh.nodes.size(), 0);
        for (const HeldFace& face : faces) {
            for (const int node : face.nodes[d]) ++times[static_cast<std::size_t>(node)];
        }
        for (std::size_t n = 0; n < times.size(); ++n)
            EXPECT_EQ(times[n], held[n][d] ? 1 : 0);
    }
}

}  // namespace
}  // namespace magfsi::structure
