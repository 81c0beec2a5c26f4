// SPDX-License-Identifier: GPL-2.0-or-later
// Rigid parts of bodies: fix ID group magttice/rigid [drag RATE] part ... moves the nodes
// of each part as one rigid body. See docs/fix_magttice.md.
//
// LAMMPS's own fix rigid/nve has the same integrator but keeps its state to itself: a
// checkpoint, a repeated step of the implicit coupling and the probes need orientation
// and angular momentum, which it neither gives nor takes back. Its inertia from a file is
// rotated into principal axes with a tolerance, and it has no axis and no point that
// holds a body elsewhere than at its centre of mass.
#include "atom.h"
#include "comm.h"
#include "domain.h"
#include "error.h"
#include "modify.h"
#include "update.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cstdio>
#include <cstring>
#include <exception>

#include "structure/lammps/effects/rigid_parts/part_words.h"
#include "structure/lammps/names.h"
#include "structure/lammps/placement.h"
#include "structure/lammps/rigid_states.h"
#include "structure/lattice/rigid_mass.h"

namespace magfsi::structure {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

Vector3d as_eigen(const Vec3& v) {
    return {v[0], v[1], v[2]};
}

// --- the fix

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
    // Row: a part. Columns: centre of mass, unit quaternion (w, x, y, z) of the turn
    // since the start, velocity, angular velocity, angular momentum about the centre or
    // the point that is held.
    double compute_array(int row, int column) override;
    void write_restart(FILE* file) override;
    void restart(char* buffer) override;

    std::vector<RigidPartMotion> motions() const override;
    std::vector<double> states() const override;
    void put_states(std::span<const double> states) override;
    double kinetic_beyond_nodes_j() const override;

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
        std::vector<Vec3> start_m;                 // one per ID
        Matrix3d beyond_nodes = Matrix3d::Zero();  // inertia, at the start [kg m2]
        std::vector<OwnNode> own{};
    };

    void read(WordReader words);
    // Finds where the nodes start, and what their masses lack in inertia. Collective.
    void find_start();
    void rebuild();
    void refuse_integrated() const;
    // Sums the forces on the nodes of each part. Collective.
    void sum_loads();
    void set_velocities();

    Drag drag_;
    DragDecay half_step_;
    std::vector<Part> parts_;
    bool started_ = false;
    std::vector<double> loads_;  // force and torque of each part
};

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
    refuse_integrated();
    reset_dt();
}

// Fails if another fix integrates an atom of a part, which would move twice.
void FixMagtticeRigid::refuse_integrated() const {
    for (int f = 0; f < modify->nfix; ++f) {
        const LAMMPS_NS::Fix& other = *modify->fix[f];
        if (other.time_integrate == 0 || &other == this) continue;
        for (int i = 0; i < atom->nlocal; ++i) {
            const int mask = atom->mask[i];
            if ((mask & groupbit) != 0 && (mask & other.groupbit) != 0)
                fail(*error,
                     "fix {} magttice/rigid and fix {} {} both move atom {}; leave the "
                     "atoms of the first out of the other's group",
                     id, other.id, other.style, atom->tag[i]);
        }
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
    for (Part& part : parts_) {
        RigidMotion& motion = part.motion;
        if (drag_.rate_1_s > 0)
            motion.slow_down(half_step_.share(motion.velocity_m_s().data()));
        motion.push(0.5 * dt_s);
        motion.drift(dt_s);
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
        if (drag_.rate_1_s > 0)
            part.motion.slow_down(half_step_.share(part.motion.velocity_m_s().data()));
        part.motion.push(0.5 * update->dt);
    }
    set_velocities();
}

void FixMagtticeRigid::sum_loads() {
    for (std::size_t p = 0; p < parts_.size(); ++p) {
        Vec3 force{}, torque{};
        const Vec3 about = parts_[p].motion.reference_m();
        for (const OwnNode& node : parts_[p].own) {
            const Vec3 f = vector_at(atom->f[node.atom]);
            force += f;
            torque += cross(vector_at(atom->x[node.atom]) - about, f);
        }
        std::ranges::copy(force, loads_.begin() + 6 * p);
        std::ranges::copy(torque, loads_.begin() + 6 * p + 3);
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

// Where the nodes started belongs to the state: after LAMMPS's own restart the atoms are
// elsewhere.
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

double FixMagtticeRigid::kinetic_beyond_nodes_j() const {
    double sum = 0;
    for (const Part& part : parts_) {
        const Vector3d rate = part.motion.turn().conjugate() *
                              as_eigen(part.motion.angular_velocity_rad_s());
        sum += 0.5 * rate.dot(part.beyond_nodes * rate);
    }
    return sum;
}

// --- the effect

bool has_rigid_parts(const LammpsInput& input) {
    return std::ranges::any_of(
        input.bodies, [](const Body& body) { return !body.rigid_parts.empty(); });
}

// Atom IDs of the nodes of rigid parts, of one part of a body or of all.
std::vector<int> rigid_ids(const LammpsInput& input, std::size_t body, int wanted = -1) {
    std::vector<int> ids;
    const std::vector<int> part = rigid_part_of_nodes(input.bodies[body]);
    const int first = first_id(input, body);
    for (std::size_t n = 0; n < part.size(); ++n) {
        if (part[n] >= 0 && (wanted < 0 || part[n] == wanted))
            ids.push_back(first + static_cast<int>(n));
    }
    return ids;
}

void check_rigid_parts(const LammpsInput& input) {
    if (input.quiet)
        refuse("rigid parts on a path of equilibria found; allowed are runs over time");
    for (std::size_t b = 0; b < input.bodies.size(); ++b) {
        const Body& body = input.bodies[b];
        refuse_held_rigid_parts(body, held_axes(body));
        if (!body.rigid_parts.empty() && !input.placements.empty() &&
            input.placements[b].relaxed)
            refuse("body {} has a rigid part and starts relaxed; allowed is one of both",
                   body.name);
    }
}

void add_group(Lines& lines, const LammpsInput& input) {
    std::vector<int> ids;
    for (std::size_t b = 0; b < input.bodies.size(); ++b) {
        const auto more = rigid_ids(input, b);
        ids.insert(ids.end(), more.begin(), more.end());
    }
    lines.push_back(fmt::format("group rigid id {}", id_ranges(ids)));
}

// The fix comes after the drag, whose work on these nodes it does itself.
void add_fix(Lines& lines, const LammpsInput& input) {
    std::string line = "fix rigid rigid magttice/rigid";
    if (input.drag) line += fmt::format(" drag {:.17g}", input.drag->rate_1_s);
    const std::array<int, 2> plane =
        input.field ? input.field->plane : std::array<int, 2>{0, 2};
    for (std::size_t b = 0; b < input.bodies.size(); ++b) {
        const Body& body = input.bodies[b];
        if (body.rigid_parts.empty()) continue;
        const Placement placement =
            input.placements.empty() ? Placement{} : input.placements[b];
        const auto nodes = placed_nodes(body, placement, plane);
        for (std::size_t p = 0; p < body.rigid_parts.size(); ++p) {
            const int number = static_cast<int>(p);
            const RigidMass mass = rigid_mass(body, number, nodes);
            line += words_of_part({{mass.mass_kg, mass.centre_m, mass.inertia_kg_m2,
                                    body.rigid_parts[p].hold},
                                   placement.velocity_m_s.value_or(Vec3{}),
                                   placement.angular_velocity_rad_s.value_or(Vec3{}),
                                   rigid_ids(input, b, number)});
        }
    }
    lines.push_back(line);
}

}  // namespace

extern const Effect rigid_parts_effect{
    .name = "rigid_parts",
    .asked = has_rigid_parts,
    .check = check_rigid_parts,
    .commands = add_group,
    .after_integration = add_fix,
    .group_left_out = "rigid",
    .fix = {"magttice/rigid", make_fix<FixMagtticeRigid>}};

}  // namespace magfsi::structure
