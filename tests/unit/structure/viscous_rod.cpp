// Axial oscillation of a confined Kelvin-Voigt rod, fixed at one end: rho u_tt = (K + 2
// G) u_xx + 2 eta u_xxt. Mode k: frequency omega^2 = (K + 2 G) k^2 / rho, decay rate eta
// k^2 / rho.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <numbers>

#include "structure/lattice/element_kernel.h"
#include "structure/lattice/stable_step.h"
#include "tests/unit/structure/elements.h"

namespace magfsi::structure {
namespace {

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
        std::printf("damping ratio %.2f: largest error %.4f of the amplitude, %d steps\n",
                    ratio, worst, steps);
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
