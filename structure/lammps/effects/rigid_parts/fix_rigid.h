// SPDX-License-Identifier: GPL-2.0-or-later
// This fix moves the nodes of each rigid part of bodies as one rigid body. Its words are
// in docs/fix_magttice.md.
//
// LAMMPS's own fix rigid/nve has the same integrator but keeps its state to itself. A
// checkpoint, a repeated step of the implicit coupling and the probes need orientation
// and angular momentum: that fix neither gives nor takes them. It turns an inertia from a
// file into principal axes with a tolerance, and it has no axis and no point that holds a
// body elsewhere than at its centre of mass.
#pragma once

#include <Eigen/Core>
#include <cstdio>
#include <span>
#include <vector>

#include "structure/lammps/effect.h"
#include "structure/lammps/effects/rigid_parts/part_words.h"
#include "structure/lammps/rigid_states.h"
#include "structure/rigid_motion.h"
#include "update.h"

namespace magfsi::structure {

// Every rank moves all parts, by the sum over the ranks of the forces on their nodes, and
// sets the nodes that it owns.
class FixMagtticeRigid : public LAMMPS_NS::Fix, public MovesRigidParts {
  public:
    FixMagtticeRigid(LAMMPS_NS::LAMMPS* lammps, int narg, char** arg);
    ~FixMagtticeRigid() noexcept override {}  // LAMMPS's bases may throw since 2022

    int setmask() override;
    void init() override;
    void reset_dt() override { half_step_ = DragDecay(drag_, 0.5 * update->dt); }
    void setup_post_neighbor() override { rebuild(); }
    void post_neighbor() override { rebuild(); }
    void setup(int) override;
    void initial_integrate(int) override;
    void final_integrate() override;

    double compute_scalar() override;  // kinetic energy of all parts [J]
    // A row is a part. Its columns: centre of mass; unit quaternion (w, x, y, z) of the
    // turn from the start on; velocity; angular velocity; angular momentum about the
    // centre or the point that is held.
    double compute_array(int row, int column) override;
    void write_restart(FILE* file) override;
    void restart(char* buffer) override;

    std::vector<RigidPartMotion> motions() const override;
    std::vector<double> states() const override;
    void put_states(std::span<const double> states) override;
    double kinetic_beyond_nodes_j(bool of_prescribed) const override;

  private:
    static constexpr int columns = 16;
    // An atom of this rank with its place at the start.
    struct OwnNode {
        int atom = 0;
        Vec3 start_m{};
    };
    struct Part {
        RigidMotion motion;
        std::vector<int> ids;
        std::vector<Vec3> start_m;  // one per ID
        Eigen::Matrix3d beyond_nodes =
            Eigen::Matrix3d::Zero();  // inertia, at the start [kg m2]
        std::vector<OwnNode> own{};
    };

    void read(WordReader words);
    // Finds where the nodes start, and what their masses lack in inertia. Collective.
    void find_start();
    void rebuild();
    // Sums the forces on the nodes of each part. Collective.
    void sum_loads();
    void set_velocities();
    // Puts the parts in prescribed motion where their courses have them now, and gives
    // their nodes the velocity of the start.
    void follow_courses();
    void start_courses();

    Drag drag_;
    DragDecay half_step_;
    std::vector<Part> parts_;
    bool started_ = false;
    std::vector<double> loads_;  // force and torque of each part
};

}  // namespace magfsi::structure
