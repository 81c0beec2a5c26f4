// SPDX-License-Identifier: GPL-2.0-or-later
// pair_style magttice/contact DISTANCE STIFFNESS [excluded FACTOR] [friction MU]: contact
// between the surfaces of the bodies; compute ID group magttice/contact: what it does at
// present. See docs/fix_magttice.md.
#include "atom.h"
#include "comm.h"
#include "compute.h"
#include "error.h"
#include "force.h"
#include "memory.h"
#include "neighbor.h"
#include "pair.h"
#include "update.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <numeric>
#include <span>
#include <utility>

#include "structure/lammps/effect.h"
#include "structure/lammps/effects/contact/contact_law.h"
#include "structure/mesh/near_pairs.h"

namespace magfsi::structure {
namespace {

class PairMagtticeContact : public LAMMPS_NS::Pair {
  public:
    // This rank's share at the present positions.
    struct State {
        double energy_j = 0;
        double touching = 0;  // pairs closer than the distance
        double slid_j = 0;    // lost to friction since the start
        double smallest_m;    // distance of the closest pair
    };

    explicit PairMagtticeContact(LAMMPS_NS::LAMMPS* lammps);
    ~PairMagtticeContact() override;

    void settings(int narg, char** arg) override;
    void coeff(int narg, char** arg) override;
    void init_style() override;
    double init_one(int i, int j) override;
    void compute(int eflag, int vflag) override;
    void* extract(const char* name, int& dimension) override;
    State state();  // collective

  private:
    // Numbers in surface_, the lower one first.
    struct Candidate {
        std::size_t a, b;
        double areas_m4;
        int atom_a, atom_b;  // local indices of those that this rank owns, else -1
    };
    struct Motion {
        Vec3 velocity_m_s{};
        double mass_kg = 0;
    };
    bool may_touch(const SurfaceNode& a, const SurfaceNode& b) const;
    bool outdated() const;
    void renew();
    void gather(std::span<const std::size_t> numbers);
    void collect_candidates();
    template <class Act>
    void each_contact(const Act& act) const;
    void add_friction();

    ContactLaw law_;
    double slid_j_ = 0;              // this rank's share, since the start
    std::vector<Motion> motion_;     // of surface_, with friction: of those of x_
    std::vector<SurfaceNode> node_;  // by atom ID
    std::vector<int> surface_;       // IDs of those on surfaces
    std::vector<Vec3> x_;            // of surface_: all at a renewal, then watched_ alone
    std::vector<Vec3> renewed_at_m_;
    std::vector<Candidate> candidates_;
    std::vector<std::size_t> watched_;  // those of candidates
    std::vector<int> owned_;            // local indices of this rank's share of surface_
    std::vector<std::size_t> own_number_;
    bool renewed_ = false;
};

PairMagtticeContact::PairMagtticeContact(LAMMPS_NS::LAMMPS* lammps) : Pair(lammps) {
    single_enable = 0;
    restartinfo = 0;
    one_coeff = 1;
    no_virial_fdotr_compute = 1;
}

PairMagtticeContact::~PairMagtticeContact() {
    if (allocated == 0) return;
    memory->destroy(setflag);
    memory->destroy(cutsq);
}

void PairMagtticeContact::settings(int narg, char** arg) {
    bool known = narg >= 2 && narg % 2 == 0;
    for (int i = 2; known && i < narg; i += 2) {
        const std::string keyword = arg[i];
        known = keyword == "excluded" || keyword == "friction";
        (keyword == "friction" ? law_.friction : law_.excluded) = number(arg[i + 1], lmp);
    }
    if (!known || !(law_.friction >= 0)) {
        fail(*error,
             "pair_style magttice/contact takes a distance, a stiffness and no other "
             "keyword than \"excluded\" or \"friction\", each with one value");
    }
    law_.distance_m = number(arg[0], lmp);
    law_.stiffness_pa_m = number(arg[1], lmp);
    if (!(law_.distance_m > 0) || !(law_.stiffness_pa_m > 0) || !(law_.excluded >= 1)) {
        fail(*error,
             "pair_style magttice/contact: distance {} and stiffness {} found; both must "
             "be positive, and \"excluded\" at least 1, or bodies at rest would feel "
             "themselves",
             arg[0], arg[1]);
    }
}

void PairMagtticeContact::coeff(int narg, char** arg) {
    if (narg != 2 || std::strcmp(arg[0], "*") != 0 || std::strcmp(arg[1], "*") != 0) {
        fail(*error, "pair_style magttice/contact needs the command: pair_coeff * *");
    }
    if (allocated == 0) {
        const int types = atom->ntypes;
        memory->create(setflag, types + 1, types + 1, "pair:setflag");
        memory->create(cutsq, types + 1, types + 1, "pair:cutsq");
        for (int i = 1; i <= types; ++i) std::fill_n(setflag[i], types + 1, 1);
        allocated = 1;
    }
}

void PairMagtticeContact::init_style() {
    if (force->newton_pair == 0) {
        fail(*error, "pair_style magttice/contact needs the command: newton on");
    }
    node_ = surface_nodes(*modify);
    if (node_.empty()) {
        fail(*error,
             "pair_style magttice/contact found no fix magttice, it needs the surface of "
             "at least one");
    }
    surface_.clear();
    for (std::size_t id = 0; id < node_.size(); ++id)
        if (node_[id].area_m2 > 0) surface_.push_back(static_cast<int>(id));
    x_.resize(surface_.size());
    if (law_.friction > 0) motion_.resize(surface_.size());
    renewed_ = false;
}

double PairMagtticeContact::init_one(int, int) {
    return law_.distance_m;
}

bool PairMagtticeContact::may_touch(const SurfaceNode& a, const SurfaceNode& b) const {
    if (a.body != b.body) return true;
    return distance_m(a.at_rest_m, b.at_rest_m) >= law_.excluded * law_.distance_m;
}

// Nodes that may touch are listed within the distance and half of it, and again when one
// has moved a quarter of the distance, or atoms have changed places. The same on all
// ranks.
bool PairMagtticeContact::outdated() const {
    int moved = !renewed_ || neighbor->ago == 0 ? 1 : 0;
    const double most = 0.25 * law_.distance_m;
    for (std::size_t i = 0; moved == 0 && i < owned_.size(); ++i) {
        const double* x = atom->x[owned_[i]];
        const Vec3& then = renewed_at_m_[own_number_[i]];
        const double way[3] = {x[0] - then[0], x[1] - then[1], x[2] - then[2]};
        if (way[0] * way[0] + way[1] * way[1] + way[2] * way[2] > most * most) moved = 1;
    }
    if (comm->nprocs > 1) MPI_Allreduce(MPI_IN_PLACE, &moved, 1, MPI_INT, MPI_MAX, world);
    return moved != 0;
}

void PairMagtticeContact::renew() {
    owned_.clear();
    own_number_.clear();
    for (std::size_t n = 0; n < surface_.size(); ++n) {
        const int i = atom->map(surface_[n]);
        if (i < 0 || i >= atom->nlocal) continue;
        owned_.push_back(i);
        own_number_.push_back(n);
    }
    std::vector<std::size_t> all(surface_.size());
    std::iota(all.begin(), all.end(), std::size_t{0});
    gather(all);
    renewed_at_m_ = x_;
    collect_candidates();
    renewed_ = true;
}

// The present places of these on every rank, with friction their motions.
void PairMagtticeContact::gather(std::span<const std::size_t> numbers) {
    const bool moves = !motion_.empty();
    const std::size_t width = moves ? 8 : 4;
    std::vector<double> mine;
    for (const std::size_t n : numbers) {
        const int i = atom->map(surface_[n]);
        if (i < 0 || i >= atom->nlocal) continue;
        std::copy_n(atom->x[i], 3, x_[n].begin());
        if (moves) {
            std::copy_n(atom->v[i], 3, motion_[n].velocity_m_s.begin());
            motion_[n].mass_kg = atom->rmass[i];
        }
        if (comm->nprocs == 1) continue;
        mine.push_back(static_cast<double>(n));
        mine.insert(mine.end(), atom->x[i], atom->x[i] + 3);
        if (!moves) continue;
        mine.insert(mine.end(), atom->v[i], atom->v[i] + 3);
        mine.push_back(motion_[n].mass_kg);
    }
    if (comm->nprocs == 1) return;
    auto count = static_cast<int>(mine.size());
    std::vector<int> counts(static_cast<std::size_t>(comm->nprocs)), first(counts.size());
    MPI_Allgather(&count, 1, MPI_INT, counts.data(), 1, MPI_INT, world);
    std::exclusive_scan(counts.begin(), counts.end(), first.begin(), 0);
    std::vector<double> all(width * numbers.size());
    MPI_Allgatherv(mine.data(), count, MPI_DOUBLE, all.data(), counts.data(),
                   first.data(), MPI_DOUBLE, world);
    for (std::size_t at = 0; at < all.size(); at += width) {
        const auto n = static_cast<std::size_t>(all[at]);
        std::copy_n(all.data() + at + 1, 3, x_[n].begin());
        if (!moves) continue;
        std::copy_n(all.data() + at + 4, 3, motion_[n].velocity_m_s.begin());
        motion_[n].mass_kg = all[at + 7];
    }
}

// In the order of their numbers, so that forces are summed in the same order on any
// ranks, and after a restart.
void PairMagtticeContact::collect_candidates() {
    const double reach = 1.5 * law_.distance_m;
    const auto own = [this](std::size_t n) {
        const int i = atom->map(surface_[n]);
        return i < atom->nlocal ? i : -1;
    };
    candidates_.clear();
    watched_.clear();
    NearPairs(x_, reach).visit([&](std::size_t i, std::size_t j) {
        if (!(distance_m(x_[i], x_[j]) < reach)) return;
        const auto [a, b] = std::minmax(i, j);
        const SurfaceNode& node_a = node_[static_cast<std::size_t>(surface_[a])];
        const SurfaceNode& node_b = node_[static_cast<std::size_t>(surface_[b])];
        if (!may_touch(node_a, node_b)) return;
        candidates_.push_back({a, b, node_a.area_m2 * node_b.area_m2, own(a), own(b)});
        watched_.insert(watched_.end(), {a, b});
    });
    std::ranges::sort(candidates_, {},
                      [](const Candidate& c) { return std::pair(c.a, c.b); });
    std::ranges::sort(watched_);
    watched_.erase(std::unique(watched_.begin(), watched_.end()), watched_.end());
}

// act(candidate, apart, distance) of each pair that touches.
template <class Act>
void PairMagtticeContact::each_contact(const Act& act) const {
    for (const Candidate& pair : candidates_) {
        const Vec3 &a = x_[pair.a], &b = x_[pair.b];
        const Vec3 apart{a[0] - b[0], a[1] - b[1], a[2] - b[2]};
        const double squared =
            apart[0] * apart[0] + apart[1] * apart[1] + apart[2] * apart[2];
        if (!(squared < law_.distance_m * law_.distance_m) || squared == 0) continue;
        act(pair, apart, std::sqrt(squared));
    }
}

// Each rank puts the force on the nodes that it owns; energy and virial belong to the
// first node's.
void PairMagtticeContact::compute(int eflag, int vflag) {
    ev_init(eflag, vflag);
    if (outdated())
        renew();
    else if (!watched_.empty())
        gather(watched_);
    double* const* const f = atom->f;
    each_contact([&](const Candidate& pair, const Vec3& apart, double distance) {
        const ContactForce contact = contact_force(law_, pair.areas_m4, distance);
        const double factor = contact.force_n / distance;
        for (std::size_t d = 0; d < 3; ++d) {
            if (pair.atom_a >= 0) f[pair.atom_a][d] += factor * apart[d];
            if (pair.atom_b >= 0) f[pair.atom_b][d] -= factor * apart[d];
        }
        if (pair.atom_a < 0) return;
        if (eflag_global != 0) eng_vdwl += contact.energy_j;
        if (vflag_global == 0) return;
        constexpr int first[6] = {0, 1, 2, 0, 0, 1}, second[6] = {0, 1, 2, 1, 2, 2};
        for (std::size_t q = 0; q < 6; ++q)
            virial[q] += factor * apart[static_cast<std::size_t>(first[q])] *
                         apart[static_cast<std::size_t>(second[q])];
    });
    if (law_.friction > 0) add_friction();
}

// Velocities are those of the half step. Its work belongs to the first node's rank.
void PairMagtticeContact::add_friction() {
    double* const* const f = atom->f;
    const double dt_s = update->dt;
    each_contact([&](const Candidate& pair, const Vec3& apart, double distance) {
        const Motion &a = motion_[pair.a], &b = motion_[pair.b];
        Vec3 past{};
        double along = 0;
        for (std::size_t d = 0; d < 3; ++d) {
            past[d] = a.velocity_m_s[d] - b.velocity_m_s[d];
            along += past[d] * apart[d] / distance;
        }
        for (std::size_t d = 0; d < 3; ++d) past[d] -= along * apart[d] / distance;
        const double area_m2 =
            std::max(node_[static_cast<std::size_t>(surface_[pair.a])].area_m2,
                     node_[static_cast<std::size_t>(surface_[pair.b])].area_m2);
        const double drag =
            friction_drag_kg_s(law_, area_m2, std::min(a.mass_kg, b.mass_kg), dt_s);
        const Vec3 rubbing = friction_force_n(
            law_, contact_force(law_, pair.areas_m4, distance).force_n, drag, past);
        for (std::size_t d = 0; d < 3; ++d) {
            if (pair.atom_a >= 0) f[pair.atom_a][d] += rubbing[d];
            if (pair.atom_b >= 0) f[pair.atom_b][d] -= rubbing[d];
            if (pair.atom_a >= 0 && update->setupflag == 0)
                slid_j_ -= rubbing[d] * past[d] * dt_s;
        }
    });
}

void* PairMagtticeContact::extract(const char* name, int& dimension) {
    dimension = 0;
    return law_.friction > 0 && std::strcmp(name, "lost_share") == 0 ? &slid_j_ : nullptr;
}

PairMagtticeContact::State PairMagtticeContact::state() {
    if (outdated())
        renew();
    else
        gather(watched_);
    State out;
    out.slid_j = slid_j_;
    out.smallest_m = INFINITY;
    for (const Candidate& pair : candidates_)
        out.smallest_m = std::min(out.smallest_m, distance_m(x_[pair.a], x_[pair.b]));
    each_contact([&](const Candidate& pair, const Vec3&, double distance) {
        if (pair.atom_a < 0) return;
        out.touching += 1;
        out.energy_j += contact_force(law_, pair.areas_m4, distance).energy_j;
    });
    return out;
}

class ComputeMagtticeContact : public LAMMPS_NS::Compute {
  public:
    ComputeMagtticeContact(LAMMPS_NS::LAMMPS* lammps, int narg, char** arg);
    ~ComputeMagtticeContact() override;
    void init() override;
    double compute_scalar() override;  // energy
    void compute_vector()
        override;  // energy, touching pairs, smallest distance, lost to friction

  private:
    PairMagtticeContact* pair_ = nullptr;
};

ComputeMagtticeContact::ComputeMagtticeContact(LAMMPS_NS::LAMMPS* lammps, int narg,
                                               char** arg)
    : Compute(lammps, narg, arg) {
    if (narg != 3) {
        fail(*error, "compute {} magttice/contact takes no argument", id);
    }
    scalar_flag = 1;
    extscalar = 1;
    vector_flag = 1;
    size_vector = 4;
    extvector = -1;
    extlist = new int[4]{1, 1, 0, 1};
    vector = new double[4]{};
}

ComputeMagtticeContact::~ComputeMagtticeContact() {
    delete[] vector;
    delete[] extlist;
}

void ComputeMagtticeContact::init() {
    pair_ = dynamic_cast<PairMagtticeContact*>(force->pair_match("magttice/contact", 1));
    if (pair_ == nullptr) {
        fail(*error, "compute {} magttice/contact needs the pair_style magttice/contact",
             id);
    }
}

double ComputeMagtticeContact::compute_scalar() {
    invoked_scalar = update->ntimestep;
    const double mine = pair_->state().energy_j;
    MPI_Allreduce(&mine, &scalar, 1, MPI_DOUBLE, MPI_SUM, world);
    return scalar;
}

void ComputeMagtticeContact::compute_vector() {
    invoked_vector = update->ntimestep;
    const PairMagtticeContact::State mine = pair_->state();
    const double sums[2] = {mine.energy_j, mine.touching};
    MPI_Allreduce(sums, vector, 2, MPI_DOUBLE, MPI_SUM, world);
    MPI_Allreduce(&mine.smallest_m, vector + 2, 1, MPI_DOUBLE, MPI_MIN, world);
    MPI_Allreduce(&mine.slid_j, vector + 3, 1, MPI_DOUBLE, MPI_SUM, world);
}

void add_contact(Lines& lines, const LammpsInput& input) {
    const ContactLaw law = contact_law(input);
    lines.push_back(
        fmt::format("pair_style magttice/contact {:.17g} {:.17g} excluded {:.17g}",
                    law.distance_m, law.stiffness_pa_m, law.excluded));
    if (law.friction > 0) lines.back() += fmt::format(" friction {:.17g}", law.friction);
    lines.push_back("pair_coeff * *");
    lines.push_back("compute contact all magttice/contact");
}

}  // namespace

extern const Effect contact_effect{
    .name = "contact",
    .asked = [](const LammpsInput& input) { return input.contact.has_value(); },
    .commands = add_contact,
    .surface_spring_pa_m =
        [](const LammpsInput& input, const Body& body) {
            return contact_spring_pa_m(body, contact_law(input));
        },
    .register_styles =
        [](LAMMPS_NS::LAMMPS& lammps) {
            (*lammps.force->pair_map)["magttice/contact"] =
                [](LAMMPS_NS::LAMMPS* made_for) -> LAMMPS_NS::Pair* {
                return new PairMagtticeContact(made_for);
            };
            (*lammps.modify->compute_map)["magttice/contact"] =
                [](LAMMPS_NS::LAMMPS* made_for, int narg,
                   char** arg) -> LAMMPS_NS::Compute* {
                return new ComputeMagtticeContact(made_for, narg, arg);
            };
        }};

}  // namespace magfsi::structure
