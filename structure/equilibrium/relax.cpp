#include "structure/equilibrium/relax.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "structure/held_nodes.h"
#include "structure/lattice/element_kernel.h"
#include "structure/lattice/stable_step.h"
#include "structure/magnetics/nodal_charge.h"

namespace magfsi::structure {
namespace {

// Small against any load; forces are resolved to about 1e-11 of it.
constexpr double tolerance = 1e-6;
constexpr int most_steps = 2'000'000;

using Array = Eigen::ArrayXd;  // three values a node

Array magnetic_forces(const Body& body, const Vec3& field_t) {
    const auto charge =
        nodal_charges(body.mesh.nodes, body.mesh.elements, body.magnetization_a_m);
    Array out(3 * static_cast<Eigen::Index>(charge.size()));
    for (std::size_t a = 0; a < charge.size(); ++a) {
        for (std::size_t d = 0; d < 3; ++d) {
            out[static_cast<Eigen::Index>(3 * a + d)] = charge[a] * field_t[d];
        }
    }
    return out;
}

// One where a node may move, zero where it is held.
Array free_axes(const std::vector<HeldAxes>& held) {
    Array out = Array::Ones(3 * static_cast<Eigen::Index>(held.size()));
    for (Eigen::Index q = 0; q < out.size(); ++q) {
        if (held[static_cast<std::size_t>(q / 3)][static_cast<std::size_t>(q % 3)])
            out[q] = 0;
    }
    return out;
}

// Velocity and step control of FIRE, with the constants of the paper.
class Fire {
  public:
    Fire(double largest_step_s, Eigen::Index size)
        : velocity_(Array::Zero(size)),
          step_s_(0.5 * largest_step_s),
          largest_step_s_(largest_step_s) {}

    // Advances the velocity and returns the displacement.
    Array advance(const Array& force, const Array& mass) {
        if ((force * velocity_).sum() > 0) {
            const double ratio =
                std::sqrt(velocity_.square().sum() / force.square().sum());
            velocity_ = (1 - mixing_) * velocity_ + mixing_ * ratio * force;
            if (++downhill_ > 5) {
                step_s_ = std::min(1.1 * step_s_, largest_step_s_);
                mixing_ *= 0.99;
            }
        } else {
            velocity_.setZero();
            step_s_ *= 0.5;
            mixing_ = 0.1;
            downhill_ = 0;
        }
        velocity_ += step_s_ * force / mass;
        return step_s_ * velocity_;
    }

  private:
    Array velocity_;
    double step_s_, largest_step_s_;
    double mixing_ = 0.1;
    int downhill_ = 0;
};

// FIRE mixes forces into velocities without regard to mass, which moves a free body's
// centre.
void put_centre_back(Array& x, const Array& start, const Array& mass) {
    for (int d = 0; d < 3; ++d) {
        const auto along = Eigen::seqN(d, x.size() / 3, 3);
        const double shift =
            (mass(along) * (x(along) - start(along))).sum() / mass(along).sum();
        x(along) -= shift;
    }
}

[[noreturn]] void give_up(const Body& body, const Vec3& b, const std::string& why) {
    throw std::runtime_error(
        fmt::format("body {}: no relaxed shape in the field ({:g}, {:g}, {:g}) T, {}: "
                    "use a weaker field "
                    "or a finer mesh",
                    body.name, b[0], b[1], b[2], why));
}

RelaxedBody descend(const Body& body, const Vec3& field_t, const Array& magnetic,
                    Array& x, const Array& mass) {
    ElementKernel kernel;
    kernel.assign(build_lattice(body));
    const Array free = free_axes(held_axes(body));
    const double scale = magnetic.abs().maxCoeff();
    Fire fire(0.9 * stable_elastic_step_s(body), x.size());
    RelaxedBody out;
    Array force(x.size());
    for (;; ++out.steps) {
        force = magnetic;
        const KernelResult result = kernel.add_forces(x.data(), force.data());
        if (!(result.smallest_j > 0)) {
            give_up(body, field_t, fmt::format("element {} inverted", result.element));
        }
        force *= free;
        out.residual = force.abs().maxCoeff() / scale;
        if (out.residual < tolerance) return out;
        if (out.steps == most_steps) {
            give_up(body, field_t,
                    fmt::format("a residual of {:.2g} was left after {} steps",
                                out.residual, out.steps));
        }
        x += fire.advance(force, mass);
    }
}

}  // namespace

RelaxedBody relax(const Body& body, const Vec3& field_t) {
    const Array magnetic = magnetic_forces(body, field_t);
    RelaxedBody out;
    out.nodes_m = body.mesh.nodes;
    if (!(magnetic.abs().maxCoeff() > 0)) return out;
    const auto masses = node_masses(build_lattice(body));
    Array x(magnetic.size());
    Array mass(magnetic.size());
    for (Eigen::Index q = 0; q < x.size(); ++q) {
        const auto node = static_cast<std::size_t>(q / 3);
        x[q] = body.mesh.nodes[node][static_cast<std::size_t>(q % 3)];
        mass[q] = masses[node];
    }
    const Array start = x;
    out = descend(body, field_t, magnetic, x, mass);
    if (body.clamps.empty() && body.rollers.empty()) put_centre_back(x, start, mass);
    out.nodes_m.resize(body.mesh.nodes.size());
    for (Eigen::Index q = 0; q < x.size(); ++q) {
        out.nodes_m[static_cast<std::size_t>(q / 3)][static_cast<std::size_t>(q % 3)] =
            x[q];
    }
    return out;
}

}  // namespace magfsi::structure
