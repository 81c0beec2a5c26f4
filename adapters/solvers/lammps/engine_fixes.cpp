// SPDX-License-Identifier: GPL-2.0-or-later
// Fixes that the engine adds to LAMMPS's step beside those of structure/lammps.
#include <cstring>
#include <iomanip>
#include <sstream>

#include "adapters/solvers/lammps/engine.h"
#include "atom.h"
#include "comm.h"
#include "compute.h"
#include "fix.h"
#include "group.h"
#include "lammps.h"
#include "modify.h"
#include "update.h"
#include "utils.h"

namespace magfsi::lammps {

namespace {

using NodalForce = coupler::StructureSolver::NodalForce;

// fix ID group magfsi/fluid: adds the fluid's force to the nodes in every time step of
// LAMMPS. The coupler's immersed boundary evaluates it from the present velocities.
class FixFluidForce : public LAMMPS_NS::Fix {
  public:
    using Fix::Fix;

    int setmask() override { return LAMMPS_NS::FixConst::PRE_REVERSE; }
    // Comes after LAMMPS has cleared and computed the forces and before it adds those of
    // ghost atoms to their owners, so that forces on ghosts count.
    void pre_reverse(int, int) override {
        if (nodal_force_ && atom->nlocal > 0)
            nodal_force_(atom->v[0], atom->f[0], update->dt);
    }

    void attach(NodalForce nodal_force) { nodal_force_ = std::move(nodal_force); }

  private:
    NodalForce nodal_force_;
};

// fix ID group magfsi/audit RATE [MOVED_GROUP ...]: sums the works that no other fix
// measures, those of prescribed motions and of the drag. Used only in runs with
// probes.energy_audit; must come after all fixes that add forces.
class FixAudit : public LAMMPS_NS::Fix {
  public:
    // RATE is the rate [1/s] of fix magttice/drag, or 0; the groups are those of fixes
    // magttice/motion and of the parts of fix magttice/rigid whose motion is prescribed.
    FixAudit(LAMMPS_NS::LAMMPS* lammps, int count, char** words);

    int setmask() override;
    // Both are called with the velocity of the half step, (x(n+1) - x(n)) / dt: the first
    // with the forces at x(n), the second with those at x(n+1). The sum of their halves
    // is the work over the step by the trapezium rule.
    void post_integrate() override;
    void post_force(int) override;

    // Entry 1: kinetic energy of the moved nodes less the work on them of all forces
    // except their drive [J]. Entry 2: energy that the drag has taken [J].
    double compute_vector(int i) override;

    // Pointers to this rank's shares of the two sums, "work_share" and "lost_share", for
    // checkpoints (Engine::fix_sums).
    void* extract(const char* name, int& dimension) override;

  private:
    bool moved(int atom_index) const;
    double power_on_moved_w() const;
    double kinetic_energy_j(bool of_moved) const;

    double rate_1_s_ = 0;
    int moved_bits_ = 0;  // bit mask of the moved groups
    double work_on_moved_j_ = 0;
    double lost_to_drag_j_ = 0;
};

FixAudit::FixAudit(LAMMPS_NS::LAMMPS* lammps, int count, char** words)
    : Fix(lammps, count, words) {
    constexpr int first_value = 3;  // after ID, group and style
    rate_1_s_ = LAMMPS_NS::utils::numeric(FLERR, words[first_value], false, lmp);
    for (int i = first_value + 1; i < count; ++i)
        moved_bits_ |= group->bitmask[group->find(words[i])];
    vector_flag = 1;
    size_vector = 2;
    extvector = 1;
    global_freq = 1;
}

int FixAudit::setmask() {
    return LAMMPS_NS::FixConst::POST_INTEGRATE | LAMMPS_NS::FixConst::POST_FORCE;
}

// The drag takes the power RATE m v^2 from each node that is not moved, v the velocity of
// the half step, which is the mean over the step.
void FixAudit::post_integrate() {
    if (rate_1_s_ > 0)
        lost_to_drag_j_ += 2 * rate_1_s_ * update->dt * kinetic_energy_j(false);
    if (moved_bits_ != 0) work_on_moved_j_ += 0.5 * update->dt * power_on_moved_w();
}

void FixAudit::post_force(int) {
    if (moved_bits_ != 0) work_on_moved_j_ += 0.5 * update->dt * power_on_moved_w();
}

bool FixAudit::moved(int atom_index) const {
    return (atom->mask[atom_index] & moved_bits_) != 0;
}

// Power of the present forces on this rank's moved nodes.
double FixAudit::power_on_moved_w() const {
    double sum = 0;
    for (int i = 0; i < atom->nlocal; ++i) {
        if (!moved(i)) continue;
        for (int d = 0; d < 3; ++d) sum += atom->f[i][d] * atom->v[i][d];
    }
    return sum;
}

// Kinetic energy of this rank's moved nodes, or of all its others. What rigid parts have
// beyond their nodes is the first rank's.
double FixAudit::kinetic_energy_j(bool of_moved) const {
    double sum = 0;
    for (int i = 0; comm->me == 0 && i < modify->nfix; ++i) {
        if (const auto* rigid =
                dynamic_cast<const structure::MovesRigidParts*>(modify->fix[i]))
            sum += rigid->kinetic_beyond_nodes_j(of_moved);
    }
    for (int i = 0; i < atom->nlocal; ++i) {
        if (moved(i) != of_moved) continue;
        const double* v = atom->v[i];
        sum += 0.5 * atom->rmass[i] * (v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
    }
    return sum;
}

double FixAudit::compute_vector(int i) {
    double mine = lost_to_drag_j_;
    if (i == 0) mine = kinetic_energy_j(true) - work_on_moved_j_;
    double all = 0;
    MPI_Allreduce(&mine, &all, 1, MPI_DOUBLE, MPI_SUM, world);
    return all;
}

void* FixAudit::extract(const char* name, int& dimension) {
    dimension = 0;
    if (std::strcmp(name, "work_share") == 0) return &work_on_moved_j_;
    if (std::strcmp(name, "lost_share") == 0) return &lost_to_drag_j_;
    return nullptr;
}

// Creator function of a fix style, in the form of LAMMPS's table of styles.
template <class Fix>
LAMMPS_NS::Fix* create(LAMMPS_NS::LAMMPS* lammps, int count, char** words) {
    return new Fix(lammps, count, words);
}

}  // namespace

void Engine::attach_fluid_force(NodalForce force) {
    (*lammps_->modify->fix_map)["magfsi/fluid"] = &create<FixFluidForce>;
    command("fix fluid all magfsi/fluid");
    const int at = lammps_->modify->find_fix("fluid");
    static_cast<FixFluidForce*>(lammps_->modify->fix[at])->attach(std::move(force));
    lammps_->init();  // fixes added between two runs are taken into the step's lists here
}

void Engine::attach_audit(double drag_rate_1_s, const std::vector<std::string>& moved) {
    (*lammps_->modify->fix_map)["magfsi/audit"] = &create<FixAudit>;
    std::ostringstream line;
    line << std::setprecision(17) << "fix audit all magfsi/audit " << drag_rate_1_s;
    for (const std::string& group : moved) line << ' ' << group;
    command(line.str());
    lammps_->init();  // fixes added between two runs are taken into the step's lists here
}

double Engine::compute_scalar(const std::string& compute_id) const {
    const int at = lammps_->modify->find_compute(compute_id);
    return lammps_->modify->compute[at]->compute_scalar();
}

double Engine::compute_vector(const std::string& compute_id, int n) const {
    LAMMPS_NS::Compute& found =
        *lammps_->modify->compute[lammps_->modify->find_compute(compute_id)];
    found.compute_vector();
    return found.vector[n - 1];
}

}  // namespace magfsi::lammps
