// SPDX-License-Identifier: GPL-2.0-or-later
#include "structure/rigid_motion.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "structure/eigen_vector.h"
#include "structure/refuse.h"

namespace magfsi::structure {
namespace {

using Eigen::Matrix3d;
using Eigen::Quaterniond;
using Eigen::Vector3d;

// The smallest principal moment over the largest that counts as more than rounding: a
// needle a million times longer than thick has 1e-12.
constexpr double least_ratio = 1e-13;

// Inertia about another point, by the parallel-axis theorem.
Matrix3d about(const RigidInertia& of, const Vec3& point_m) {
    const Vector3d arm = as_eigen(of.centre_m - point_m);
    return of.inertia_kg_m2 + of.mass_kg * (arm.squaredNorm() * Matrix3d::Identity() -
                                            arm * arm.transpose());
}

// The hold of the part if it is of this kind, else null.
template <class Kind>
const Kind* hold_of(const RigidInertia& part) {
    return part.hold ? std::get_if<Kind>(&*part.hold) : nullptr;
}

// Turn about one principal axis, as the kinetic energy of that axis alone would make it:
// it leaves the angular momentum in space unchanged. momentum: in the principal axes.
void turn_about(int k, double time_s, const Vector3d& moment, Quaterniond& turn,
                Vector3d& momentum) {
    const double angle = time_s * momentum[k] / moment[k];
    const int p = (k + 1) % 3, q = (k + 2) % 3;
    const double c = std::cos(angle), s = std::sin(angle);
    const double before = momentum[p];
    momentum[p] = c * before + s * momentum[q];
    momentum[q] = c * momentum[q] - s * before;
    Vector3d axis = Vector3d::Zero();
    axis[k] = std::sin(0.5 * angle);
    turn = turn * Quaterniond(std::cos(0.5 * angle), axis[0], axis[1], axis[2]);
}

// Free rotation, of second order in the step.
void symmetric_turn(double time_s, const Vector3d& moment, Quaterniond& turn,
                    Vector3d& momentum) {
    turn_about(0, 0.5 * time_s, moment, turn, momentum);
    turn_about(1, 0.5 * time_s, moment, turn, momentum);
    turn_about(2, time_s, moment, turn, momentum);
    turn_about(1, 0.5 * time_s, moment, turn, momentum);
    turn_about(0, 0.5 * time_s, moment, turn, momentum);
}

// Free rotation by Suzuki's five steps of second order, which cancel the error of third
// order. momentum_: in space, constant.
void turn_freely(double time_s, const Vector3d& moment, const Vector3d& momentum_in_space,
                 Quaterniond& turn) {
    static const double part = 1 / (4 - std::cbrt(4.0));
    Vector3d momentum = turn.conjugate() * momentum_in_space;
    for (const double share : {part, part, 1 - 4 * part, part, part})
        symmetric_turn(share * time_s, moment, turn, momentum);
    turn.normalize();
}

}  // namespace

RigidMotion::RigidMotion(const RigidInertia& of) : start_(of) {
    if (!(of.mass_kg > 0))
        refuse("a rigid part with a mass of {:g} kg found, it must be positive",
               of.mass_kg);
    start_place_m_ = of.centre_m;
    const auto* hinge = hold_of<Hinge>(of);
    if (hinge) start_place_m_ = hinge->about_m;
    if (const auto* pivot = hold_of<Pivot>(of)) start_place_m_ = pivot->about_m;
    if (const auto* course = hold_of<RigidCourse>(of)) courses_ = course->courses();
    const Matrix3d inertia = about(of, start_place_m_);
    const Eigen::SelfAdjointEigenSolver<Matrix3d> solver(inertia);
    moment_ = solver.eigenvalues();
    if (!(moment_[0] > least_ratio * moment_[2]))
        refuse(
            "a rigid part with the principal moments of inertia {:g}, {:g} and {:g} "
            "kg m2 found, all must be positive: a single node or nodes along a line "
            "cannot turn as a body",
            moment_[0], moment_[1], moment_[2]);
    Matrix3d axes = solver.eigenvectors();
    if (axes.determinant() < 0) axes.col(0) *= -1;
    axes_ = Quaterniond(axes).normalized();
    if (hinge) {
        if (!(norm(hinge->axis) > 0)) refuse("a hinge needs an axis with a direction");
        axis_ = as_eigen(hinge->axis).normalized();
        about_axis_kg_m2_ = axis_.dot(inertia * axis_);
    }
    place_m_ = start_place_m_;
    turn_ = axes_;
}

void RigidMotion::set_velocity(const Vec3& velocity_m_s,
                               const Vec3& angular_velocity_rad_s) {
    if (is_prescribed()) return;
    velocity_ = is_held() ? Vec3{} : velocity_m_s;
    const Vector3d rate = as_eigen(angular_velocity_rad_s);
    if (about_axis_kg_m2_ > 0) {
        momentum_ = as_vec3(about_axis_kg_m2_ * axis_.dot(rate) * axis_);
        return;
    }
    momentum_ = momentum_of(angular_velocity_rad_s);
}

Vec3 RigidMotion::momentum_of(const Vec3& rate_rad_s) const {
    const Vector3d in_axes = turn_.conjugate() * as_eigen(rate_rad_s);
    return as_vec3(turn_ * moment_.cwiseProduct(in_axes).eval());
}

void RigidMotion::set_load(const Vec3& force_n, const Vec3& torque_n_m) {
    force_n_ = force_n;
    torque_n_m_ = torque_n_m;
}

void RigidMotion::push(double time_s) {
    if (about_axis_kg_m2_ > 0) {
        momentum_ += as_vec3(time_s * axis_.dot(as_eigen(torque_n_m_)) * axis_);
        return;
    }
    momentum_ += time_s * torque_n_m_;
    if (!is_held()) velocity_ += time_s / start_.mass_kg * force_n_;
}

void RigidMotion::drift(double time_s) {
    place_m_ += time_s * velocity_;
    const Vector3d momentum = as_eigen(momentum_);
    if (about_axis_kg_m2_ > 0) {
        const double half = 0.5 * time_s * axis_.dot(momentum) / about_axis_kg_m2_;
        const Vector3d v = std::sin(half) * axis_;
        turn_ = (Quaterniond(std::cos(half), v[0], v[1], v[2]) * turn_).normalized();
        return;
    }
    turn_freely(time_s, moment_, momentum, turn_);
}

void RigidMotion::slow_down(double left) {
    velocity_ *= left;
    momentum_ *= left;
}

// The course turns the part about its axis first and moves it then.
void RigidMotion::follow(double time_s) {
    Vec3 shift_m{}, linear_m_s{}, rate_rad_s{};
    Turn turn;
    for (const MotionCourse& course : courses_) {
        shift_m += displacement_m(course, time_s);
        linear_m_s += magfsi::structure::velocity_m_s(course, time_s);
        rate_rad_s += turn_rate_rad_s(course, time_s).vector;
        const Turn one = turn_rad(course, time_s);
        turn.vector += one.vector;
        turn.about_m += one.about_m;
    }
    const Vec3 arm_m = start_place_m_ - turn.about_m;
    const Vec3 turned_m = arm_m + turned_by_m(turn.vector, arm_m);
    place_m_ = turn.about_m + turned_m + shift_m;
    velocity_ = linear_m_s + cross(rate_rad_s, turned_m);
    momentum_ = rate_rad_s;
    const double angle = norm(turn.vector);
    turn_ = axes_;
    if (angle > 0) {
        const Vector3d v = std::sin(0.5 * angle) / angle * as_eigen(turn.vector);
        turn_ =
            (Quaterniond(std::cos(0.5 * angle), v[0], v[1], v[2]) * axes_).normalized();
    }
}

Vec3 RigidMotion::place_of(const Vec3& at_start_m) const {
    return RigidPlace(*this).of(at_start_m);
}

Vec3 RigidMotion::velocity_at(const Vec3& place_m) const {
    return velocity_ + cross(angular_velocity_rad_s(), place_m - place_m_);
}

Vec3 RigidMotion::angular_velocity_rad_s() const {
    if (is_prescribed()) return momentum_;
    const Vector3d momentum = as_eigen(momentum_);
    if (about_axis_kg_m2_ > 0) return as_vec3(momentum / about_axis_kg_m2_);
    const Vector3d in_axes = turn_.conjugate() * momentum;
    return as_vec3(turn_ * in_axes.cwiseQuotient(moment_).eval());
}

Vec3 RigidMotion::angular_momentum_kg_m2_s() const {
    return is_prescribed() ? momentum_of(momentum_) : momentum_;
}

// About a point that is held, the energy of the turn is all of it.
double RigidMotion::kinetic_j() const {
    return 0.5 * start_.mass_kg * dot(velocity_, velocity_) +
           0.5 * dot(angular_momentum_kg_m2_s(), angular_velocity_rad_s());
}

std::array<double, RigidMotion::state_values> RigidMotion::state() const {
    std::array<double, state_values> out{};
    auto at = std::ranges::copy(place_m_, out.begin()).out;
    at = std::copy_n(turn_.coeffs().data(), 4, at);
    for (const Vec3& v : {velocity_, momentum_, force_n_, torque_n_m_})
        at = std::ranges::copy(v, at).out;
    return out;
}

void RigidMotion::set_state(std::span<const double> state) {
    const double* at = state.data();
    place_m_ = vector_at(at);
    turn_.coeffs() = Eigen::Vector4d(at + 3);
    velocity_ = vector_at(at + 7);
    momentum_ = vector_at(at + 10);
    force_n_ = vector_at(at + 13);
    torque_n_m_ = vector_at(at + 16);
}

}  // namespace magfsi::structure
