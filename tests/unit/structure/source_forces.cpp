// SPDX-License-Identifier: GPL-2.0-or-later
// Forces and torques of magnets and coils on bodies against closed forms.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>

#include "structure/equilibrium/static_problem.h"
#include "structure/magnetics/magnetic_forces.h"
#include "structure/magnetics/source_field.h"
#include "tests/unit/structure/derivatives.h"
#include "tests/unit/structure/elements.h"
#include "tests/unit/structure/sources.h"

namespace magfsi::structure {
namespace {

using Eigen::Matrix3d, Eigen::Vector3d;

struct Load {
    Vector3d force = Vector3d::Zero(), torque = Vector3d::Zero();  // about the origin
    double energy = 0;
};

// A block of 0.4 mm about the origin.
Body small_magnet() {
    Body body;
    body.mesh = box_mesh({{4e-4, 4e-4, 4e-4}, {3, 3, 3}});
    for (Vec3& node : body.mesh.nodes)
        for (double& x : node) x -= 2e-4;
    body.material = test::soft_material();
    body.magnetization_a_m = uniform_magnetization(body.mesh, {3e4, 2e4, 6e4});
    return body;
}

Load load_in(const std::vector<FieldSource>& sources, const Body& body,
             const std::vector<Vec3>& nodes_m) {
    SourceField field(sources);
    std::vector<FieldSample> samples;
    for (const Vec3& node : nodes_m) samples.push_back(field.sample(node));
    std::vector<Vec3> force(nodes_m.size());
    Load out;
    out.energy = add_source_forces(
        moment_elements(body.mesh.nodes, body.mesh.elements, body.magnetization_a_m),
        body.mesh.elements, samples, nodes_m.front().data(), force.front().data());
    for (std::size_t n = 0; n < force.size(); ++n) {
        const Vector3d f(force[n].data()), x(nodes_m[n].data());
        out.force += f;
        out.torque += x.cross(f);
    }
    return out;
}

// Between two dipoles: force (m . grad) B and torque m x B. A block of 0.4 mm at 15 mm is
// a point within 1e-4.
TEST(SourceForces, OnASmallMagnetAreThoseOnADipole) {
    const Body body = small_magnet();
    const Vector3d moment = 6.4e-11 * Vector3d(3e4, 2e4, 6e4);
    for (const SourceShape& shape :
         std::vector<SourceShape>{DipoleSource{{0.1, -0.3, 1}},
                                  CuboidMagnet{{8e-3, 6e-3, 4e-3}, {0.2, 0.5, 1}},
                                  CircularCoil{12e-3, {1, 1, 2}, 50, 10}}) {
        const std::vector<FieldSource> sources{source(shape, {9e-3, 4e-3, -12e-3})};
        const FieldSample here = at(sources, {});
        const Load load = load_in(sources, body, body.mesh.nodes);
        const Vector3d force = here.gradient_t_m.transpose() * moment;
        const Vector3d torque = moment.cross(here.field_t);
        EXPECT_LT((load.force - force).norm(), 1e-3 * force.norm());
        EXPECT_LT((load.torque - torque).norm(), 1e-3 * torque.norm());
        EXPECT_NEAR(load.energy / -moment.dot(here.field_t), 1, 1e-3);
    }
}

// In a field that is linear in space they are those of the gradient effect.
TEST(SourceForces, InALinearFieldAreThoseOfTheGradient) {
    Body body = small_magnet();
    test::Random random(3);
    std::vector<Vec3> now = body.mesh.nodes;
    for (Vec3& node : now)
        for (double& x : node) x += 3e-5 * random.uniform();
    Matrix3d a;
    a << 0.3, 0.1, -0.2, 0.1, 0.4, 0.5, -0.2, 0.5, -0.7;
    std::vector<FieldSample> samples;
    for (const Vec3& node : now) samples.push_back({a * Vector3d(node.data()), a});
    std::vector<Vec3> by_sources(now.size()), by_gradient(now.size());
    const double energy = add_source_forces(
        moment_elements(body.mesh.nodes, body.mesh.elements, body.magnetization_a_m),
        body.mesh.elements, samples, now.front().data(), by_sources.front().data());
    const double right = add_gradient_forces(
        gradient_elements(body.mesh.nodes, body.mesh.elements, body.magnetization_a_m),
        body.mesh.elements, FieldGradient(a, {}), now.front().data(),
        by_gradient.front().data());
    double largest = 0, off = 0;
    for (std::size_t n = 0; n < now.size(); ++n) {
        for (std::size_t d = 0; d < 3; ++d) {
            largest = std::max(largest, std::abs(by_gradient[n][d]));
            off = std::max(off, std::abs(by_gradient[n][d] - by_sources[n][d]));
        }
    }
    EXPECT_LT(off, 1e-12 * largest);  // rounding
    EXPECT_NEAR(energy / right, 1, 1e-12);
}

// Forces against differences of the energy, the tangent against differences of the
// forces, near a magnet, where the field bends strongly.
TEST(SourceForces, AndTheirTangentAreDerivativesOfTheEnergy) {
    Body body = small_magnet();
    body.mesh = box_mesh({{4e-4, 4e-4, 4e-4}, {2, 1, 1}});
    body.magnetization_a_m = uniform_magnetization(body.mesh, {3e6, 2e6, 6e6});
    body.clamps = {"x_min"};
    Surroundings around;
    around.sources = std::make_shared<SourceField>(std::vector<FieldSource>{
        source(CuboidMagnet{{2e-3, 2e-3, 2e-3}, {0.3, 0.2, 1}}, {1e-3, 0, 2e-3})});
    StaticProblem problem(body, around);
    test::Random random(4);
    Eigen::VectorXd x = flat_positions(body.mesh.nodes);
    for (double& value : x) value += 1e-5 * random.uniform();
    StaticLoads full;
    full.sources = 0.8;
    const NodalLoads loads = problem.load(full);
    problem.assemble(x, loads);
    const Eigen::MatrixXd tangent = test::whole_tangent(problem);
    problem.assemble(x);
    const Eigen::MatrixXd elastic = test::whole_tangent(problem);
    const double of_sources = (tangent - elastic).cwiseAbs().maxCoeff();
    ASSERT_GT(of_sources, 1e-3 * elastic.cwiseAbs().maxCoeff());
    // Rounding of the differences: 1e-6 of the stiffness of the elements.
    test::expect_derivatives(problem, body, x, loads, tangent, 0.02 * of_sources, 1e-5);
}

}  // namespace
}  // namespace magfsi::structure
