#include "structure/equilibrium/motion.h"

#include <algorithm>

namespace magfsi::structure {

Motion::Motion(const StaticProblem& problem, const Eigen::VectorXd& x,
               const Eigen::VectorXd& step)
    : x_(x), step_(step), free_(problem.free()) {
    if (!free_) return;
    const auto& volume = problem.node_volumes_m3();
    const Eigen::Index nodes = x.size() / 3;
    Eigen::Vector3d shift = Eigen::Vector3d::Zero();
    for (Eigen::Index n = 0; n < nodes; ++n) {
        const double share = volume[n] / problem.volume_m3();
        centre_ += share * x.segment<3>(3 * n);
        shift += share * step.segment<3>(3 * n);
    }
    Eigen::Matrix3d inertia = Eigen::Matrix3d::Zero();
    Eigen::Vector3d momentum = Eigen::Vector3d::Zero();
    for (Eigen::Index n = 0; n < nodes; ++n) {
        const Eigen::Vector3d r = x.segment<3>(3 * n) - centre_;
        step_.segment<3>(3 * n) -= shift;
        momentum += volume[n] * r.cross(step_.segment<3>(3 * n));
        inertia += volume[n] *
                   (r.squaredNorm() * Eigen::Matrix3d::Identity() - r * r.transpose());
    }
    rotation_ = inertia.ldlt().solve(momentum);
    for (Eigen::Index n = 0; n < nodes; ++n) {
        step_.segment<3>(3 * n) -= rotation_.cross(x.segment<3>(3 * n) - centre_);
    }
}

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

}  // namespace magfsi::structure
