// SPDX-License-Identifier: GPL-2.0-or-later
#include "structure/lammps/effects/rigid_parts/fix_rigid.h"

#include "atom.h"
#include "comm.h"
#include "domain.h"
#include "error.h"
#include "modify.h"
#include "update.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <exception>
#include <unordered_set>

#include "structure/eigen_vector.h"

namespace magfsi::structure {

using Eigen::Matrix3d;
using Eigen::Vector3d;

FixMagtticeRigid::FixMagtticeRigid(LAMMPS_NS::LAMMPS* lammps, int narg, char** arg)
    : Fix(lammps, narg, arg) {
    try {
        read(WordReader(lmp, narg - 3, arg + 3));
    } catch (const std::exception& cause) {
        fail(*error, "fix {} magttice/rigid: {}", id, cause.what());
    }
    loads_.resize(6 * parts_.size());
    time_integrate = 1;
    dynamic_group_allow = 0;
    scalar_flag = 1;
    extscalar = 1;
    array_flag = 1;
    size_array_rows = static_cast<int>(parts_.size());
    size_array_cols = columns;
    extarray = 0;
    global_freq = 1;
    restart_global = 1;
}

void FixMagtticeRigid::read(WordReader words) {
    if (words.take("drag")) drag_.rate_1_s = words.value();
    while (words.take("part")) {
        const PartWords part = read_part(words);
        parts_.push_back(
            {RigidMotion(part.inertia), part.ids, std::vector<Vec3>(part.ids.size())});
        parts_.back().motion.set_velocity(part.velocity_m_s, part.angular_velocity_rad_s);
    }
    if (parts_.empty() || !words.done())
        refuse(
            "\"{}\" found; allowed are drag with a rate, then part with mass, centre, "
            "inertia and nodes for each part",
            words.done() ? "" : words.word());
}

int FixMagtticeRigid::setmask() {
    using namespace LAMMPS_NS::FixConst;
    return INITIAL_INTEGRATE | FINAL_INTEGRATE | POST_NEIGHBOR;
}

void FixMagtticeRigid::init() {
    for (int d = 0; d < 3; ++d) {
        if (domain->periodicity[d] != 0)
            fail(*error,
                 "fix {} magttice/rigid found a box that is periodic along {}; allowed "
                 "are boundary f and s",
                 id, "xyz"[d]);
    }
    refuse_integrated_twice(*lmp, *this);
    reset_dt();
    start_courses();
}

// Nodes in prescribed motion get their velocities before the first forces are evaluated
// and before ghosts get theirs. The map of the atoms is not valid yet.
void FixMagtticeRigid::start_courses() {
    follow_courses();
    for (const Part& part : parts_) {
        if (!part.motion.is_prescribed()) continue;
        const std::unordered_set<int> ids(part.ids.begin(), part.ids.end());
        for (int i = 0; i < atom->nlocal; ++i) {
            if (!ids.contains(static_cast<int>(atom->tag[i]))) continue;
            const Vec3 v = part.motion.velocity_at(vector_at(atom->x[i]));
            std::copy_n(v.data(), 3, atom->v[i]);
        }
    }
}

// The time is derived from the step number, so that it is the same after a restart.
void FixMagtticeRigid::follow_courses() {
    const double time_s = static_cast<double>(update->ntimestep) * update->dt;
    try {
        for (Part& part : parts_)
            if (part.motion.is_prescribed()) part.motion.follow(time_s);
    } catch (const std::exception& cause) {
        fail(*error, "fix {} magttice/rigid: {}", id, cause.what());
    }
}

// The rows of all nodes are place and mass; each has one owner.
void FixMagtticeRigid::find_start() {
    for (Part& part : parts_) {
        std::vector<double> rows(5 * part.ids.size());
        for (std::size_t n = 0; n < part.ids.size(); ++n) {
            const int i = atom->map(part.ids[n]);
            if (i < 0 || i >= atom->nlocal) continue;
            std::copy_n(atom->x[i], 3, rows.data() + 5 * n);
            rows[5 * n + 3] = atom->rmass[i];
            rows[5 * n + 4] = 1;
        }
        MPI_Allreduce(MPI_IN_PLACE, rows.data(), static_cast<int>(rows.size()),
                      MPI_DOUBLE, MPI_SUM, world);
        const RigidInertia& inertia = part.motion.start();
        Matrix3d lumped = Matrix3d::Zero();
        for (std::size_t n = 0; n < part.ids.size(); ++n) {
            if (rows[5 * n + 4] != 1)
                fail(*error, "fix {} magttice/rigid: there is no atom {}", id,
                     part.ids[n]);
            part.start_m[n] = vector_at(rows.data() + 5 * n);
            const Vector3d arm = as_eigen(part.start_m[n] - inertia.centre_m);
            lumped += rows[5 * n + 3] *
                      (arm.squaredNorm() * Matrix3d::Identity() - arm * arm.transpose());
        }
        part.beyond_nodes = inertia.inertia_kg_m2 - lumped;
    }
}

// The map of the atoms is valid from here on, so that the start is looked up at the first
// call.
void FixMagtticeRigid::rebuild() {
    if (!started_) find_start();
    started_ = true;
    for (Part& part : parts_) {
        part.own.clear();
        for (std::size_t n = 0; n < part.ids.size(); ++n) {
            const int i = atom->map(part.ids[n]);
            if (i >= 0 && i < atom->nlocal) part.own.push_back({i, part.start_m[n]});
        }
    }
}

void FixMagtticeRigid::setup(int) {
    sum_loads();
    set_velocities();
}

// Nodes get the mean velocity of the step, which is what works and viscous forces take
// within a step (effect.h).
void FixMagtticeRigid::initial_integrate(int) {
    const double dt_s = update->dt;
    follow_courses();
    for (Part& part : parts_) {
        RigidMotion& motion = part.motion;
        if (!motion.is_prescribed()) {
            if (drag_.rate_1_s > 0)
                motion.slow_down(half_step_.share(motion.velocity_m_s().data()));
            motion.push(0.5 * dt_s);
            motion.drift(dt_s);
        }
        const RigidPlace place(motion);
        for (const OwnNode& node : part.own) {
            const Vec3 next = place.of(node.start_m);
            const Vec3 mean = (next - vector_at(atom->x[node.atom])) / dt_s;
            std::copy_n(next.data(), 3, atom->x[node.atom]);
            std::copy_n(mean.data(), 3, atom->v[node.atom]);
        }
    }
}

void FixMagtticeRigid::final_integrate() {
    sum_loads();
    for (Part& part : parts_) {
        if (part.motion.is_prescribed()) continue;
        if (drag_.rate_1_s > 0)
            part.motion.slow_down(half_step_.share(part.motion.velocity_m_s().data()));
        part.motion.push(0.5 * update->dt);
    }
    set_velocities();
}

void FixMagtticeRigid::sum_loads() {
    for (std::size_t p = 0; p < parts_.size(); ++p) {
        Vec3 force_n{}, torque_n_m{};
        const Vec3 about = parts_[p].motion.reference_m();
        for (const OwnNode& node : parts_[p].own) {
            const Vec3 f = vector_at(atom->f[node.atom]);
            force_n += f;
            torque_n_m += cross(vector_at(atom->x[node.atom]) - about, f);
        }
        std::ranges::copy(force_n, loads_.begin() + 6 * p);
        std::ranges::copy(torque_n_m, loads_.begin() + 6 * p + 3);
    }
    if (comm->nprocs > 1)
        MPI_Allreduce(MPI_IN_PLACE, loads_.data(), static_cast<int>(loads_.size()),
                      MPI_DOUBLE, MPI_SUM, world);
    for (std::size_t p = 0; p < parts_.size(); ++p)
        parts_[p].motion.set_load(vector_at(&loads_[6 * p]),
                                  vector_at(&loads_[6 * p + 3]));
}

void FixMagtticeRigid::set_velocities() {
    for (const Part& part : parts_) {
        const Vec3 about = part.motion.reference_m();
        const Vec3 rate = part.motion.angular_velocity_rad_s();
        const Vec3 linear = part.motion.velocity_at(about);
        for (const OwnNode& node : part.own) {
            const Vec3 v = linear + cross(rate, vector_at(atom->x[node.atom]) - about);
            std::copy_n(v.data(), 3, atom->v[node.atom]);
        }
    }
}

double FixMagtticeRigid::compute_scalar() {
    double sum = 0;
    for (const Part& part : parts_) sum += part.motion.kinetic_j();
    return sum;
}

double FixMagtticeRigid::compute_array(int row, int column) {
    const RigidMotion& motion = parts_.at(row).motion;
    const Eigen::Quaterniond turn = motion.turn();
    std::array<double, columns> values{};
    auto at = std::ranges::copy(motion.centre_m(), values.begin()).out;
    for (const double q : {turn.w(), turn.x(), turn.y(), turn.z()}) *at++ = q;
    for (const Vec3& v : {motion.velocity_m_s(), motion.angular_velocity_rad_s(),
                          motion.angular_momentum_kg_m2_s()})
        at = std::ranges::copy(v, at).out;
    return values.at(column);
}

// The places where the nodes started belong to the state: after LAMMPS's own restart the
// atoms are elsewhere.
void FixMagtticeRigid::write_restart(FILE* file) {
    if (comm->me != 0) return;
    std::vector<double> all = states();
    for (const Part& part : parts_) {
        for (const Vec3& x : part.start_m) all.insert(all.end(), x.begin(), x.end());
        all.insert(all.end(), part.beyond_nodes.data(), part.beyond_nodes.data() + 9);
    }
    const int size = static_cast<int>(all.size() * sizeof(double));
    std::fwrite(&size, sizeof(int), 1, file);
    std::fwrite(all.data(), sizeof(double), all.size(), file);
}

void FixMagtticeRigid::restart(char* buffer) {
    std::vector<double> all(RigidMotion::state_values * parts_.size());
    for (const Part& part : parts_) all.resize(all.size() + 3 * part.ids.size() + 9);
    std::memcpy(all.data(), buffer, all.size() * sizeof(double));
    put_states(all);
    const double* at = all.data() + RigidMotion::state_values * parts_.size();
    for (Part& part : parts_) {
        for (Vec3& x : part.start_m) {
            x = vector_at(at);
            at += 3;
        }
        std::copy_n(at, 9, part.beyond_nodes.data());
        at += 9;
    }
    started_ = true;
}

std::vector<RigidPartMotion> FixMagtticeRigid::motions() const {
    std::vector<RigidPartMotion> out;
    for (const Part& part : parts_) {
        const RigidMotion& motion = part.motion;
        out.push_back({motion.centre_m(), motion.turn(), motion.velocity_m_s(),
                       motion.angular_velocity_rad_s(), motion.kinetic_j()});
    }
    return out;
}

std::vector<double> FixMagtticeRigid::states() const {
    std::vector<double> all;
    for (const Part& part : parts_) {
        const auto one = part.motion.state();
        all.insert(all.end(), one.begin(), one.end());
    }
    return all;
}

void FixMagtticeRigid::put_states(std::span<const double> states) {
    constexpr std::size_t width = RigidMotion::state_values;
    for (std::size_t p = 0; p < parts_.size(); ++p)
        parts_[p].motion.set_state(states.subspan(width * p, width));
}

double FixMagtticeRigid::kinetic_beyond_nodes_j(bool of_prescribed) const {
    double sum = 0;
    for (const Part& part : parts_) {
        if (part.motion.is_prescribed() != of_prescribed) continue;
        const Vector3d rate = part.motion.turn().conjugate() *
                              as_eigen(part.motion.angular_velocity_rad_s());
        sum += 0.5 * rate.dot(part.beyond_nodes * rate);
    }
    return sum;
}

}  // namespace magfsi::structure
