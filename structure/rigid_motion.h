// SPDX-License-Identifier: GPL-2.0-or-later
// Motion of one rigid part: its state, and the halves of a step of velocity Verlet.
#pragma once

#include <Eigen/Geometry>
#include <array>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "structure/eigen_vector.h"
#include "structure/motion.h"
#include "structure/options.h"

namespace magfsi::structure {

// Constants of a rigid part at the start of its motion, where its nodes are at their
// first places.
struct RigidInertia {
    double mass_kg = 0;
    Vec3 centre_m{};
    Eigen::Matrix3d inertia_kg_m2 = Eigen::Matrix3d::Zero();  // about the centre of mass
    std::optional<RigidHold> hold{};
};

// A rigid part that moves freely, about a point, about an axis, or as it is prescribed.
//
// A step of length h is the symmetric, symplectic splitting of velocity Verlet:
//   p += F h/2,  L += T h/2   (push)
//   the free motion over h    (drift)
//   p += F h/2,  L += T h/2   (push, with the forces at the new place)
// L is the angular momentum about the centre of mass, or about the point that is held, in
// space. The free rotation is split into exact turns about the three principal axes, as
// in the integrator NO_SQUISH of Miller et al. (J. Chem. Phys. 116, 8649, 2002), which
// LAMMPS's fix rigid/nve uses, and these are composed to the fourth order (Suzuki 1990):
// every such turn keeps L exactly, so that without a torque L is constant to the last
// digit and the energy does not drift. A part held about an axis turns exactly. One whose
// motion is prescribed is where its course has it at each time; forces do not move it.
class RigidMotion {
  public:
    // Numbers of a state in a checkpoint: place, turn, velocity, angular momentum, force
    // and torque.
    static constexpr std::size_t state_values = 19;

    // Throws std::invalid_argument, which names what was found, unless mass and moments
    // of inertia are positive.
    explicit RigidMotion(const RigidInertia& of);

    // Sets the velocity of the centre of mass and the angular velocity in space. A held
    // part takes of the latter what its hold allows, one in prescribed motion neither.
    void set_velocity(const Vec3& velocity_m_s, const Vec3& angular_velocity_rad_s);
    // Sets force and torque, the latter about reference_m().
    void set_load(const Vec3& force_n, const Vec3& torque_n_m);

    void push(double time_s);
    void drift(double time_s);
    // Multiplies all velocities, for drag in proportion to mass.
    void slow_down(double left);

    // A part in prescribed motion takes follow() in place of the three above: place, turn
    // and velocities at a time. Throws as value_at does (formula.h).
    bool is_prescribed() const { return !courses_.empty(); }
    void follow(double time_s);

    // The point that torque and angular momentum refer to: the centre of mass, or the
    // point that is held. Of a part in prescribed motion it is the former.
    Vec3 reference_m() const { return place_m_; }
    // Present place of a point by its place at the start, and velocity at a place.
    Vec3 place_of(const Vec3& at_start_m) const;
    Vec3 velocity_at(const Vec3& place_m) const;

    Vec3 centre_m() const { return place_of(start_.centre_m); }
    Vec3 velocity_m_s() const { return velocity_at(centre_m()); }
    Vec3 angular_velocity_rad_s() const;
    Vec3 angular_momentum_kg_m2_s() const;
    // The turn since the start.
    Eigen::Quaterniond turn() const { return turn_ * axes_.conjugate(); }
    double kinetic_j() const;
    const RigidInertia& start() const { return start_; }
    // reference_m() at the start.
    Vec3 start_reference_m() const { return start_place_m_; }

    std::array<double, state_values> state() const;
    void set_state(std::span<const double> state);

  private:
    // At a point or on an axis.
    bool is_held() const { return start_.hold.has_value() && !is_prescribed(); }
    // The angular momentum of a turn at this rate.
    Vec3 momentum_of(const Vec3& rate_rad_s) const;

    RigidInertia start_;
    Vec3 start_place_m_{};           // reference_m() at the start
    Eigen::Quaterniond axes_;        // from the principal axes to space, at the start
    Eigen::Vector3d moment_;         // principal moments about the reference [kg m2]
    Eigen::Vector3d axis_{0, 0, 0};  // unit vector of a hinge; zero without one
    double about_axis_kg_m2_ = 0;
    std::vector<MotionCourse> courses_;  // of a prescribed motion

    Vec3 place_m_{};
    Eigen::Quaterniond turn_;  // from the principal axes to space
    Vec3 velocity_{};          // of the centre of mass of a part that no point holds
    // Angular momentum about the reference; of a part in prescribed motion its angular
    // velocity.
    Vec3 momentum_{};
    Vec3 force_n_{}, torque_n_m_{};
};

// The present places of many points of a part.
class RigidPlace {
  public:
    explicit RigidPlace(const RigidMotion& motion)
        : turn_(motion.turn().toRotationMatrix()),
          from_m_(motion.start_reference_m()),
          to_m_(motion.reference_m()) {}
    Vec3 of(const Vec3& at_start_m) const {
        return to_m_ + as_vec3(turn_ * as_eigen(at_start_m - from_m_));
    }

  private:
    Eigen::Matrix3d turn_;
    Vec3 from_m_, to_m_;
};

}  // namespace magfsi::structure
