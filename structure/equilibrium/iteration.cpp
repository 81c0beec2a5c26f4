// SPDX-License-Identifier: GPL-2.0-or-later
#include "structure/equilibrium/iteration.h"
#include "base/fitted/constants.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include "structure/lattice/stiffening.h"

namespace magfsi::structure {
namespace {

// Moves a body by a Newton step with the rotation in it as a finite one. A linearised
// step stretches a body that it turns, by half the angle squared, and a free body that
// follows the field's torque would be held back by its own stiffness. The step is
// therefore split into its rotation (least-squares fit, weighted by volume), which is
// carried out exactly, and the rest. The centre of volume stays along the axes on which
// nothing holds the body.
class Motion {
  public:
    Motion(const StaticProblem& problem, const Eigen::VectorXd& x,
           const Eigen::VectorXd& step);

    // Positions after a fraction of the step. The derivative at 0 is the step without the
    // translation of a free body.
    Eigen::VectorXd at(double fraction) const;
    // Largest fraction, at most 1, that turns the body by no more than half a radian.
    double largest_fraction() const;
    // The step without free translation and rotation.
    const Eigen::VectorXd& deformation() const { return step_; }

  private:
    Eigen::VectorXd x_, step_;
    Eigen::Vector3d centre_ = Eigen::Vector3d::Zero();
    Eigen::Vector3d rotation_ = Eigen::Vector3d::Zero();  // angle times axis
};

// Fits shift and rotation to the step: the angular velocity of a rigid body with the
// step's angular momentum, nodes weighted by volume.
Motion::Motion(const StaticProblem& problem, const Eigen::VectorXd& x,
               const Eigen::VectorXd& step)
    : x_(x), step_(step) {
    const HeldAxes& held = problem.held_along();
    if (held == HeldAxes{true, true, true}) return;
    const auto& volume = problem.node_volumes_m3();
    const Eigen::Index nodes = x.size() / 3;
    Eigen::Vector3d shift = Eigen::Vector3d::Zero();
    for (Eigen::Index n = 0; n < nodes; ++n) {
        const double share = volume[n] / problem.volume_m3();
        centre_ += share * x.segment<3>(3 * n);
        shift += share * step.segment<3>(3 * n);
    }
    for (int d = 0; d < 3; ++d) {
        if (held[d]) shift[d] = 0;
    }
    const Eigen::Vector3d& normal = problem.platform_normal();
    shift -= normal.dot(shift) * normal;
    Eigen::Matrix3d inertia = Eigen::Matrix3d::Zero();
    Eigen::Vector3d momentum = Eigen::Vector3d::Zero();
    for (Eigen::Index n = 0; n < nodes; ++n) {
        const Eigen::Vector3d r = x.segment<3>(3 * n) - centre_;
        step_.segment<3>(3 * n) -= shift;
        momentum += volume[n] * r.cross(step_.segment<3>(3 * n));
        inertia += volume[n] *
                   (r.squaredNorm() * Eigen::Matrix3d::Identity() - r * r.transpose());
    }
    for (int d = 0; d < 3; ++d) {  // no turn about an axis where another one is held
        if (!held[(d + 1) % 3] && !held[(d + 2) % 3]) continue;
        inertia.row(d).setZero();
        inertia.col(d).setZero();
        inertia(d, d) = 1;
        momentum[d] = 0;
    }
    rotation_ = inertia.ldlt().solve(momentum);
    for (Eigen::Index n = 0; n < nodes; ++n) {
        step_.segment<3>(3 * n) -= rotation_.cross(x.segment<3>(3 * n) - centre_);
    }
}

// Adds the rest of the step first, then rotates about the centre of volume.
Eigen::VectorXd Motion::at(double fraction) const {
    Eigen::VectorXd out = x_ + fraction * step_;
    const double angle = fraction * rotation_.norm();
    if (angle == 0) return out;
    const Eigen::Matrix3d turn =
        Eigen::AngleAxisd(angle, rotation_.normalized()).toRotationMatrix();
    for (Eigen::Index n = 0; n < out.size() / 3; ++n) {
        out.segment<3>(3 * n) = centre_ + turn * (out.segment<3>(3 * n) - centre_);
    }
    return out;
}

double Motion::largest_fraction() const {
    constexpr double largest_angle = 0.5;
    const double angle = rotation_.norm();
    return angle > largest_angle ? largest_angle / angle : 1.0;
}

// The independent volume ratios theta and pressures p [Pa] of the mixed method, by
// element.
class MixedVolumes {
  public:
    MixedVolumes(StaticProblem& problem, const Eigen::VectorXd& x) : problem_(problem) {
        const auto& references = problem.references();
        for (std::size_t e = 0; e < references.size(); ++e) {
            const Positions8 xe = problem.element_positions(e, x);
            const double ratio =
                element_volume(references[e], xe).volume_m3 / references[e].volume;
            ratio_.push_back(ratio);
            pressure_.push_back(
                volumetric_stress(problem.material(e), ratio).pressure_pa);
        }
    }

    // Fills the problem's matrix and returns the right side [N]. drive_m: as for
    // mixed_iteration.
    Eigen::VectorXd assemble(const Eigen::VectorXd& x, const NodalLoads& load,
                             const Eigen::VectorXd& drive_m) {
        Eigen::VectorXd right = problem_.surrounding_n(x, load);
        problem_.matrix().set_zero();
        for (std::size_t e = 0; e < ratio_.size(); ++e) add_element(e, x, drive_m, right);
        problem_.add_surroundings(x, load);
        return right;
    }

    // Moves theta and p by a fraction of the way to their linearised values. False if a
    // ratio is out of range.
    bool advance(const Eigen::VectorXd& x, const Eigen::VectorXd& step, double fraction) {
        const auto& references = problem_.references();
        bool sound = true;
        for (std::size_t e = 0; e < ratio_.size(); ++e) {
            const VolumeAndGradient v =
                element_volume(references[e], problem_.element_positions(e, x));
            double change = v.volume_m3 / references[e].volume - ratio_[e];
            const Hexahedron& nodes = problem_.body().mesh.elements[e];
            for (int a = 0; a < 8; ++a) {
                change += v.gradient_m2.row(a).dot(step.segment<3>(3 * nodes[a])) /
                          references[e].volume;
            }
            const VolumetricStress stress =
                volumetric_stress(problem_.material(e), ratio_[e]);
            const double goal = stress.pressure_pa + stress.modulus_pa * change;
            pressure_[e] += fraction * (goal - pressure_[e]);
            ratio_[e] += fraction * change;
            sound = sound && ratio_[e] > fitted::smallest_volume_ratio &&
                    ratio_[e] < fitted::largest_volume_ratio;
        }
        return sound;
    }

  private:
    // Adds an element's tangent to the matrix and subtracts its inner forces, and the
    // pull of driven nodes, from the right side.
    void add_element(std::size_t e, const Eigen::VectorXd& x,
                     const Eigen::VectorXd& drive_m, Eigen::VectorXd& right) {
        const ElementReference& reference = problem_.references()[e];
        const Material& material = problem_.material(e);
        const Positions8 xe = problem_.element_positions(e, x);
        const VolumeDerivatives v = volume_derivatives(reference, xe);
        const VolumetricStress stress = volumetric_stress(material, ratio_[e]);
        Matrix24 tangent =
            element_tangent(reference, material, v, {pressure_[e], stress.modulus_pa});
        const double pressure =
            stress.pressure_pa +
            stress.modulus_pa * (v.volume_m3 / reference.volume - ratio_[e]);
        Positions8 inner = material.shear_modulus_pa * reference.spring_matrix * xe;
        if (reference.variant == ElementVariant::assumed_strain) {
            inner += hourglass_energy(reference.hourglass, material, xe).gradient_n;
            tangent += hourglass_tangent(reference.hourglass, material, xe);
        }
        if (stiffens(material)) stiffen(reference, material, xe, inner, tangent);
        problem_.matrix().add_element(e, tangent);
        const Hexahedron& nodes = problem_.body().mesh.elements[e];
        for (int a = 0; a < 8; ++a) {
            right.segment<3>(3 * nodes[a]) -=
                (inner.row(a) + pressure * v.gradient_m2.row(a)).transpose();
        }
        if (drive_m.size() == 0) return;
        Eigen::Matrix<double, 24, 1> ahead;
        for (int a = 0; a < 8; ++a)
            ahead.segment<3>(3 * a) = drive_m.segment<3>(3 * nodes[a]);
        if (ahead.isZero(0)) return;
        const Eigen::Matrix<double, 24, 1> pull = tangent * ahead;
        for (int a = 0; a < 8; ++a)
            right.segment<3>(3 * nodes[a]) -= pull.segment<3>(3 * a);
    }

    // Inner forces and tangent of springs and hourglass energy with stiffening.
    static void stiffen(const ElementReference& reference, const Material& material,
                        const Positions8& xe, Positions8& inner, Matrix24& tangent) {
        const Distortion state = distortion(reference, material, xe);
        Matrix24 hourglass = Matrix24::Zero();
        if (reference.variant == ElementVariant::assumed_strain)
            hourglass = hourglass_tangent(reference.hourglass, material, xe);
        inner = state.gradient_n;
        tangent += stiffening_tangent(reference, material, state, hourglass);
    }

    StaticProblem& problem_;
    std::vector<double> ratio_, pressure_;
};

// Factorises the matrix of the mixed method. A stretched state on the way (a body half
// turned by a linearised step) can make the tangent indefinite although the equilibrium
// is stable; a foundation in rough steps then holds those unknowns back that have lost
// their stiffness, while the volumes still move on. Moments that turn with the body make
// the tangent of a free one slightly indefinite where the field has just been turned: by
// |m| |B| (1 - cos d) / 2 at the angle d between moment and field. Steps from a weak
// foundation on then hold only that. stable: true if no foundation was needed. False if
// none of them is enough.
bool factorize_mixed(StaticProblem& problem, bool& stable) {
    constexpr std::array<double, 6> all{1, 10, 100, 1e3, 1e4, 1e6};
    const std::size_t first = is_turned(problem.body()) ? 0 : 4;
    const auto stands_on = [&](double foundation) {
        problem.matrix().raise_foundation(foundation);
        return problem.matrix().factorize();
    };
    stable = stands_on(problem.rigid_foundation());
    if (stable) return true;
    const double scale = problem.bending_stiffness_scale();
    return std::ranges::any_of(std::span(all).subspan(first),
                               [&](double part) { return stands_on(part * scale); });
}

// Factorises the tangent on the weakest foundation [Pa/m2] that makes it positive
// definite, in factors of ten from a tenth of the last one on. Returns the foundation, or
// infinity if 30 attempts fail.
double factorize_shifted(StaticProblem& problem, const Eigen::VectorXd& x,
                         const NodalLoads& load, double last) {
    const double first = 1e-2 * problem.bending_stiffness_scale();
    double foundation = 0.1 * last > first ? 0.1 * last : problem.rigid_foundation();
    problem.assemble(x, load);
    for (int attempt = 0; attempt < 30; ++attempt) {
        problem.matrix().raise_foundation(foundation);
        if (problem.matrix().factorize()) return foundation;
        foundation = std::max(10 * foundation, first);
    }
    return INFINITY;
}

// Fraction of the step that lowers the energy enough, by halving; zero if there is none.
// slope: work of the residual along the whole step [J].
double line_search(const StaticProblem& problem, const Motion& motion, const Iterate& now,
                   const NodalLoads& load, double slope) {
    const double before = now.response.total_j;
    // Rounding of the energy: the springs and volume terms, each about G V, cancel at
    // rest.
    const double rounding =
        1e-14 * problem.largest_shear_modulus_pa() * problem.volume_m3();
    double fraction = motion.largest_fraction();
    for (int halving = 0; halving < 40; ++halving, fraction *= 0.5) {
        const Eigen::VectorXd x = motion.at(fraction);
        const auto response = problem.response(x, load);
        if (!(response.smallest_j > 0)) continue;
        if (response.total_j <= before - 1e-4 * fraction * slope + rounding) {
            return fraction;
        }
    }
    return 0;
}

}  // namespace

Iterate mixed_iteration(StaticProblem& problem, const Eigen::VectorXd& start,
                        const NodalLoads& load, const Goal& goal, int max_iterations,
                        double largest_move_m, Eigen::VectorXd drive_m) {
    Iterate out;
    out.x = start;
    MixedVolumes volumes(problem, start);
    for (;; ++out.iterations) {
        out.response = problem.response(out.x, load);
        out.converged = out.response.sound() && drive_m.isZero(0) &&
                        StaticProblem::reached(goal, out.response);
        if (out.converged || out.iterations == max_iterations) return out;
        const Eigen::VectorXd right = volumes.assemble(out.x, load, drive_m);
        bool stable = true;
        const bool solved = factorize_mixed(problem, stable);
        if (out.iterations == 0) out.stable_start = stable;
        if (!solved) return out;
        Eigen::VectorXd step = problem.matrix().solve(right);
        if (drive_m.size() > 0) step += drive_m;
        if (out.iterations == 0) out.first_step_m = step.cwiseAbs().maxCoeff();
        const Motion motion(problem, out.x, step);
        const double fraction = motion.largest_fraction();
        const bool sound = volumes.advance(out.x, step, fraction);
        out.x = motion.at(fraction);
        drive_m *= 1 - fraction;
        if (!sound || !((out.x - start).cwiseAbs().maxCoeff() <= largest_move_m)) {
            ++out.iterations;
            return out;
        }
    }
}

Iterate energy_descent(StaticProblem& problem, const Eigen::VectorXd& start,
                       const NodalLoads& load, const Goal& goal, int max_iterations) {
    Iterate out;
    out.x = start;
    double foundation = 0;
    for (;; ++out.iterations) {
        out.response = problem.response(out.x, load);
        if (!(out.response.smallest_j > 0)) return out;
        const bool reached = StaticProblem::reached(goal, out.response);
        out.converged = reached && out.response.sound();
        if (reached || out.iterations == max_iterations) return out;
        foundation = factorize_shifted(problem, out.x, load, foundation);
        if (!std::isfinite(foundation)) return out;
        const Eigen::VectorXd step = problem.matrix().solve(out.response.residual_n);
        const Motion motion(problem, out.x, step);
        const double fraction =
            line_search(problem, motion, out, load, out.response.residual_n.dot(step));
        if (!(fraction > 0)) return out;
        out.x = motion.at(fraction);
    }
}

Eigen::VectorXd deformation(const StaticProblem& problem, const Eigen::VectorXd& x,
                            const Eigen::VectorXd& step) {
    return Motion(problem, x, step).deformation();
}

}  // namespace magfsi::structure
