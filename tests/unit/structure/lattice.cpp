// SPDX-License-Identifier: GPL-2.0-or-later
#include "structure/lattice/lattice.h"
#include <gtest/gtest.h>
#include <cmath>
#include <numbers>
#include <numeric>
#include "structure/lattice/element_kernel.h"
#include "structure/lattice/stable_step.h"
#include "tests/support/checks.h"
#include "tests/unit/structure/elements.h"

namespace magfsi::structure {
namespace {

std::string message(const Mesh& mesh, ElementVariant variant) {
    return test::message_of<std::invalid_argument>([&] {
        build_lattice(mesh.nodes, mesh.elements, {test::soft_material()}, {}, variant);
    });
}

TEST(BadElements, AnInvertedElementIsNamed) {
    Mesh mesh = box_mesh({{4e-4, 2e-4, 1e-4}, {4, 2, 1}});
    std::swap(mesh.elements[5][0], mesh.elements[5][1]);
    test::expect_says(message(mesh, ElementVariant::full),
                      {"element 5 of the mesh is inverted"});
}

TEST(BadElements, AFoldedCornerIsFoundThoughTheVolumeIsPositive) {
    Mesh mesh = box_mesh({{1e-4, 1e-4, 1e-4}, {1, 1, 1}});
    for (double& coordinate : mesh.nodes[7]) coordinate -= 0.75e-4;
    test::expect_says(message(mesh, ElementVariant::full), {"at its corner 7"});
}

TEST(BadElements, ANodeThatTheMeshLacksIsNamed) {
    Mesh mesh = box_mesh({{1e-4, 1e-4, 1e-4}, {1, 1, 1}});
    mesh.elements[0][3] = 8;
    EXPECT_EQ(message(mesh, ElementVariant::full),
              "element 0 names node 8, but the mesh has nodes 0 to 7");
}

TEST(TwoMaterials, GiveANodeBetweenThemTheMassOfBoth) {
    const Body body = test::soft_and_stiff_bar();
    const Lattice lattice = build_lattice(body);
    const auto mass = lattice.node_mass_kg;
    const double volume = 8e-3 * 1e-3 * 0.5e-3;
    // Sums of some hundred numbers: rounding.
    EXPECT_NEAR(
        std::accumulate(mass.begin(), mass.end(), 0.0) / (0.5 * volume * (1860 + 930)), 1,
        1e-13);
    for (std::size_t n = 0; n < mass.size(); ++n) {
        const double x = body.mesh.nodes[n][0];
        const double density = std::abs(x - 4e-3) < 1e-9 ? 0.5 * (1860 + 930)
                               : x < 4e-3                ? 1860
                                                         : 930;
        EXPECT_NEAR(mass[n] / (density * lattice.node_volume_m3[n]), 1, 1e-13) << n;
    }
}

TEST(TwoMaterials, AreBitwiseOneWhereTheyAreTheSame) {
    Body one = test::soft_and_stiff_bar();
    one.other_materials.clear();
    one.element_material.clear();
    Body named = one;
    named.other_materials = {test::stiff_material()};
    named.element_material.assign(one.mesh.elements.size(), 0);
    EXPECT_EQ(build_lattice(one).node_mass_kg, build_lattice(named).node_mass_kg);
    std::vector<double> x;
    test::Random random(52);
    for (const Vec3& node : one.mesh.nodes) {
        for (double c : node) x.push_back(c + 2e-5 * random.uniform());
    }
    std::vector<double> a(x.size(), 0.0);
    std::vector<double> b(x.size(), 0.0);
    ElementKernel kernel;
    kernel.assign(build_lattice(one));
    kernel.add_forces(x.data(), a.data());
    kernel.assign(build_lattice(named));
    kernel.add_forces(x.data(), b.data());
    EXPECT_EQ(a, b);
}

// The bound of the elements: that of the material with the faster waves alone.
TEST(TwoMaterials, TakeTheStableStepOfTheFaster) {
    const Body both = test::soft_and_stiff_bar();
    Body soft = both;
    soft.other_materials.clear();
    soft.element_material.clear();
    Body stiff = soft;
    stiff.material = test::stiff_material();
    EXPECT_LT(stable_step_s(stiff), stable_step_s(soft));
    // The same brick elsewhere: rounded coordinates.
    EXPECT_NEAR(stable_step_s(both) / stable_step_s(stiff), 1, 1e-12);
}

TEST(StableStep, IsThatOfElementsThatCanMove) {
    Body bar = test::soft_and_stiff_bar();
    bar.mesh.faces["all"].resize(bar.mesh.nodes.size());
    std::iota(bar.mesh.faces["all"].begin(), bar.mesh.faces["all"].end(), 0);
    const double step = stable_step_s(bar);
    // The nodes of the stiff elements, which hold those beside them on one side only.
    for (std::size_t e = 0; e < bar.mesh.elements.size(); ++e) {
        if (bar.element_material[e] == 0) continue;
        const Hexahedron& nodes = bar.mesh.elements[e];
        bar.mesh.faces["stiff"].insert(bar.mesh.faces["stiff"].end(), nodes.begin(),
                                       nodes.end());
    }
    bar.clamps = {"stiff"};
    Body soft = bar;
    soft.clamps.clear();
    soft.other_materials.clear();
    soft.element_material.clear();
    EXPECT_NEAR(stable_step_s(bar) / stable_step_s(soft), 1, 1e-12);
    EXPECT_GT(stable_step_s(bar), 1.1 * step);
    bar.clamps = {"all"};
    EXPECT_EQ(stable_step_s(bar), INFINITY);
    EXPECT_EQ(step_limit_s(bar, 1e9), INFINITY);
    // Nor does it become finite where what holds the nodes presses them together.
    std::vector<Vec3> pressed = bar.mesh.nodes;
    for (Vec3& x : pressed) x[0] *= 0.5;
    EXPECT_EQ(CurrentStep(bar).rise_1_s2(pressed), 0);
    bar.clamps.clear();
    EXPECT_GT(CurrentStep(bar).rise_1_s2(pressed), 0);
}

TEST(TwoMaterials, AreRefusedWithoutANumberForEachElement) {
    Body body = test::soft_and_stiff_bar();
    body.element_material.back() = 2;
    EXPECT_THROW(build_lattice(body), std::invalid_argument);
    EXPECT_THROW(stable_step_s(body), std::invalid_argument);
    body.element_material.pop_back();
    EXPECT_THROW(build_lattice(body), std::invalid_argument);
    body.element_material.clear();
    EXPECT_THROW(build_lattice(body), std::invalid_argument);
}

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

// Axial oscillation of a confined Kelvin-Voigt rod, fixed at one end: rho u_tt = (K + 2
// G) u_xx + 2 eta u_xxt. Mode k: frequency omega^2 = (K + 2 G) k^2 / rho, decay rate eta
// k^2 / rho.
constexpr int elements = 20;
constexpr double length_m = 2e-3;

Body rod() {
    Body body;
    body.name = "rod";
    body.mesh = box_mesh({{length_m, 1e-4, 1e-4}, {elements, 1, 1}});
    body.material = test::soft_material();
    body.element = ElementVariant::assumed_strain;
    return body;
}

class Oscillation {
  public:
    Oscillation(const Body& body, double amplitude_m) : nodes_(body.mesh.nodes) {
        const Lattice lattice = build_lattice(body);
        mass_ = lattice.node_mass_kg;
        elastic_.assign(lattice);
        viscous_.assign(lattice);
        for (const Vec3& node : nodes_) {
            x_.insert(x_.end(), {node[0] + amplitude_m * shape(node), node[1], node[2]});
        }
        v_.assign(x_.size(), 0.0);
    }
    // One step of LAMMPS's velocity Verlet seen at the half steps; sides are confined.
    void advance(double dt) {
        std::vector<double> f(x_.size(), 0.0);
        elastic_.add_forces(x_.data(), f.data());
        viscous_.add_forces(x_.data(), v_.data(), f.data());
        for (std::size_t n = 0; n < nodes_.size(); ++n) {
            if (nodes_[n][0] == 0) continue;
            v_[3 * n] += dt * f[3 * n] / mass_[n];
            x_[3 * n] += dt * v_[3 * n];
        }
    }
    // Share of the first mode.
    double amplitude() const {
        double product = 0;
        double norm = 0;
        for (std::size_t n = 0; n < nodes_.size(); ++n) {
            const double s = shape(nodes_[n]);
            product += mass_[n] * s * (x_[3 * n] - nodes_[n][0]);
            norm += mass_[n] * s * s;
        }
        return product / norm;
    }

  private:
    static double shape(const Vec3& node) {
        return std::sin(0.5 * std::numbers::pi * node[0] / length_m);
    }
    std::vector<Vec3> nodes_;
    std::vector<double> mass_, x_, v_;
    ElementKernel elastic_;
    ViscousKernel viscous_;
};

TEST(ViscousRod, DecaysAsTheClosedForm) {
    Body body = rod();
    const Material& m = body.material;
    const double k = 0.5 * std::numbers::pi / length_m;
    const double modulus = m.lame_lambda_pa + 2 * m.shear_modulus_pa;
    const double omega = k * std::sqrt(modulus / m.density_kg_m3);
    for (double ratio : {0.02, 0.1, 0.3}) {  // of critical damping
        const double eta = ratio * omega * m.density_kg_m3 / (k * k);
        body.material.viscosity_pa_s = eta;
        const double decay = ratio * omega;
        const double damped = omega * std::sqrt(1 - ratio * ratio);
        const double dt = 0.25 * stable_step_s(body);
        const double amplitude = 1e-7;  // strain 1e-4: linear to that
        Oscillation oscillation(body, amplitude);
        double worst = 0;
        const int steps = static_cast<int>(3 * 2 * std::numbers::pi / omega / dt);
        for (int step = 1; step <= steps; ++step) {
            oscillation.advance(dt);
            const double t = step * dt;
            const double exact =
                std::exp(-decay * t) *
                (std::cos(damped * t) + decay / damped * std::sin(damped * t));
            worst =
                std::max(worst, std::abs(oscillation.amplitude() / amplitude - exact));
        }
        // Lumped masses: a phase of (k h)^2 / 24 = 2.6e-4 of 3 periods, 0.0048. The start
        // and the lag of the damping by half a step: below omega dt / 2 of it, 0.004,
        // which decays with the motion.
        EXPECT_LT(worst, 0.006) << ratio;
    }
}

TEST(ViscousRod, KeepsToItsStableStep) {
    Body body = rod();
    for (double eta : {1.0, 100.0}) {  // the stiffness limits the step, then the damping
        body.material.viscosity_pa_s = eta;
        const double dt = stable_step_s(body);
        EXPECT_LT(dt, stable_elastic_step_s(body));
        Oscillation safe(body, 1e-9);
        for (int step = 0; step < 3000; ++step) safe.advance(0.99 * dt);
        EXPECT_LT(std::abs(safe.amplitude()), 1.1e-9);
    }
}

}  // namespace
}  // namespace magfsi::structure
