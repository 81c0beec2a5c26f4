#include "structure/equilibrium/mixed_iteration.h"

#include <cmath>

#include "structure/equilibrium/foundation.h"
#include "structure/equilibrium/motion.h"
#include "structure/equilibrium/tangent.h"

namespace magfsi::structure {
namespace {

// Elements beyond this have lost their way; U is not convex above J = e^(1 + G/K).
constexpr double smallest_ratio = 0.1;
constexpr double largest_ratio = 2.5;

class MixedVolumes {
  public:
    MixedVolumes(StaticProblem& problem, const Eigen::VectorXd& x) : problem_(problem) {
        const auto& references = problem.references();
        for (std::size_t e = 0; e < references.size(); ++e) {
            const Positions8 xe = problem.element_positions(e, x);
            const double ratio =
                volume_slope(references[e], xe).volume_m3 / references[e].volume;
            ratio_.push_back(ratio);
            pressure_.push_back(
                volumetric_stress(problem.material(e), ratio).pressure_pa);
        }
    }

    // Fills the matrix and returns the right side.
    Eigen::VectorXd assemble(const Eigen::VectorXd& x, const Eigen::VectorXd& load,
                             double foundation) {
        Eigen::VectorXd right = load;
        problem_.clear_matrix();
        for (std::size_t e = 0; e < ratio_.size(); ++e) add_element(e, x, right);
        problem_.finish_matrix(foundation);
        return right;
    }

    // theta and p to their linearised values. False if an element has lost its way.
    bool advance(const Eigen::VectorXd& x, const Eigen::VectorXd& step, double fraction) {
        const auto& references = problem_.references();
        bool sound = true;
        for (std::size_t e = 0; e < ratio_.size(); ++e) {
            const VolumeSlope v =
                volume_slope(references[e], problem_.element_positions(e, x));
            double change = v.volume_m3 / references[e].volume - ratio_[e];
            const Hexahedron& nodes = problem_.body().mesh.elements[e];
            for (int a = 0; a < 8; ++a) {
                change +=
                    v.gradient_m2.segment<3>(3 * a).dot(step.segment<3>(3 * nodes[a])) /
                    references[e].volume;
            }
            const VolumetricStress stress =
                volumetric_stress(problem_.material(e), ratio_[e]);
            const double goal = stress.pressure_pa + stress.modulus_pa * change;
            pressure_[e] += fraction * (goal - pressure_[e]);
            ratio_[e] += fraction * change;
            sound = sound && ratio_[e] > smallest_ratio && ratio_[e] < largest_ratio;
        }
        return sound;
    }

  private:
    void add_element(std::size_t e, const Eigen::VectorXd& x, Eigen::VectorXd& right) {
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
        problem_.add_element(e, tangent);
        const Hexahedron& nodes = problem_.body().mesh.elements[e];
        for (int a = 0; a < 8; ++a) {
            right.segment<3>(3 * nodes[a]) -=
                inner.row(a).transpose() + pressure * v.gradient_m2.segment<3>(3 * a);
        }
    }

    StaticProblem& problem_;
    std::vector<double> ratio_, pressure_;
};

// A stretched state on the way (a body half turned by a linearised step) can make the
// tangent indefinite although the equilibrium is stable. A foundation in rough steps then
// holds the unknowns back that have lost their stiffness; the volumes still move on.
bool factorize(StaticProblem& problem, MixedVolumes& volumes, const Eigen::VectorXd& x,
               const Eigen::VectorXd& load, Eigen::VectorXd& right) {
    double foundation = rigid_foundation(problem);
    for (double next : {1e4, 1e6, 1e8}) {
        right = volumes.assemble(x, load, foundation);
        if (problem.matrix().factorize()) return true;
        foundation = next * problem.bending_stiffness_scale();
    }
    return false;
}

}  // namespace

Correction mixed_iteration(StaticProblem& problem, const Eigen::VectorXd& start,
                           const Eigen::VectorXd& load, double tolerance,
                           int most_iterations, double largest_move_m) {
    Correction out;
    out.x = start;
    MixedVolumes volumes(problem, start);
    for (;; ++out.iterations) {
        out.response = problem.response(out.x, load);
        const bool upright = out.response.smallest_j > 0;
        out.residual = upright ? problem.relative_residual(out.response, load) : INFINITY;
        out.converged = out.residual < tolerance;
        if (out.converged || out.iterations == most_iterations) return out;
        Eigen::VectorXd right;
        if (!factorize(problem, volumes, out.x, load, right)) return out;
        const Eigen::VectorXd step = problem.solve(right);
        if (out.iterations == 0) out.first_step_m = step.cwiseAbs().maxCoeff();
        const Motion motion(problem, out.x, step);
        const double fraction = motion.largest_fraction();
        const bool sound = volumes.advance(out.x, step, fraction);
        out.x = motion.at(fraction);
        if (!sound || !((out.x - start).cwiseAbs().maxCoeff() <= largest_move_m)) {
            ++out.iterations;
            return out;
        }
    }
}

}  // namespace magfsi::structure
