// Moving a body by a Newton step, its rigid rotation as a finite one.
#pragma once

#include "structure/equilibrium/static_problem.h"

namespace magfsi::structure {

// A linearised step stretches a body that it turns, by half the angle squared; a free
// body that follows the field's torque would thus be held up by its own stiffness. The
// step of a free body is split into its rotation (the least-squares fit, weighted by
// volume), carried out as such, and the rest. Its centre of volume stays.
class Motion {
  public:
    Motion(const StaticProblem& problem, const Eigen::VectorXd& x,
           const Eigen::VectorXd& step);

    // x moved by this fraction of the step; its derivative at 0 is the step (for a free
    // body, less its translation).
    Eigen::VectorXd at(double fraction) const;
    // Fraction of the step that turns the body by no more than half a radian.
    double largest_fraction() const;

  private:
    Eigen::VectorXd x_, step_;
    bool free_;
    Eigen::Vector3d centre_ = Eigen::Vector3d::Zero();
    Eigen::Vector3d rotation_ = Eigen::Vector3d::Zero();  // angle times axis
};

}  // namespace magfsi::structure
