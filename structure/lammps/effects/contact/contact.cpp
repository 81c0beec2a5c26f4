// SPDX-License-Identifier: GPL-2.0-or-later
// pair_style magttice/contact DISTANCE STIFFNESS [excluded FACTOR]: contact between the
// surfaces of the bodies; compute ID group magttice/contact: what it does at present. See
// docs/fix_magttice.md.
#include "atom.h"
#include "compute.h"
#include "error.h"
#include "force.h"
#include "memory.h"
#include "neigh_list.h"
#include "neighbor.h"
#include "pair.h"
#include "update.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>

#include "structure/lammps/effect.h"
#include "structure/lammps/effects/contact/contact_law.h"

namespace magfsi::structure {
namespace {

class PairMagtticeContact : public LAMMPS_NS::Pair {
  public:
    // This rank's share at the present positions.
    struct State {
        double energy_j = 0;
        double touching = 0;  // pairs closer than the distance
        double smallest_m;    // distance of the closest pair
    };

    explicit PairMagtticeContact(LAMMPS_NS::LAMMPS* lammps);
    ~PairMagtticeContact() override;

    void settings(int narg, char** arg) override;
    void coeff(int narg, char** arg) override;
    void init_style() override;
    double init_one(int i, int j) override;
    void compute(int eflag, int vflag) override;
    State state() const;

  private:
    struct Candidate {
        int i, j;
        double areas_m4;
    };
    bool may_touch(const SurfaceNode& a, const SurfaceNode& b) const;
    void collect_candidates();
    template <bool Tally>
    void add_forces();

    ContactLaw law_;
    std::vector<SurfaceNode> node_;      // by atom ID
    std::vector<Candidate> candidates_;  // since the last neighbour list
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
    if (narg != 2 && !(narg == 4 && std::strcmp(arg[2], "excluded") == 0)) {
        fail(*error,
             "pair_style magttice/contact takes a distance, a stiffness and no other "
             "keyword than \"excluded\" with one value");
    }
    law_.distance_m = number(arg[0], lmp);
    law_.stiffness_pa_m = number(arg[1], lmp);
    if (narg == 4) law_.excluded = number(arg[3], lmp);
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
    neighbor->request(this, instance_me);
}

double PairMagtticeContact::init_one(int, int) {
    return law_.distance_m;
}

bool PairMagtticeContact::may_touch(const SurfaceNode& a, const SurfaceNode& b) const {
    if (a.area_m2 == 0 || b.area_m2 == 0) return false;
    if (a.body != b.body) return true;
    return distance_m(a.at_rest_m, b.at_rest_m) >= law_.excluded * law_.distance_m;
}

// Most neighbours of a node belong to its own part of the sheet; leaving them out here
// makes a step cost nothing where nothing is near.
void PairMagtticeContact::collect_candidates() {
    candidates_.clear();
    for (int k = 0; k < list->inum; ++k) {
        const int i = list->ilist[k];
        const auto tag_i = static_cast<std::size_t>(atom->tag[i]);
        if (tag_i >= node_.size()) continue;
        for (int n = 0; n < list->numneigh[i]; ++n) {
            const int j = list->firstneigh[i][n] & NEIGHMASK;
            const auto tag_j = static_cast<std::size_t>(atom->tag[j]);
            if (tag_j >= node_.size() || !may_touch(node_[tag_i], node_[tag_j])) continue;
            candidates_.push_back({i, j, node_[tag_i].area_m2 * node_[tag_j].area_m2});
        }
    }
}

void PairMagtticeContact::compute(int eflag, int vflag) {
    ev_init(eflag, vflag);
    if (neighbor->ago == 0) collect_candidates();
    if (evflag != 0)
        add_forces<true>();
    else
        add_forces<false>();
}

// Tally: LAMMPS asks for energies or pressures of this step.
template <bool Tally>
void PairMagtticeContact::add_forces() {
    const double* const* const x = atom->x;
    double* const* const f = atom->f;
    const double reach = law_.distance_m * law_.distance_m;
    for (const Candidate& pair : candidates_) {
        const double* a = x[pair.i];
        const double* b = x[pair.j];
        const Vec3 apart{a[0] - b[0], a[1] - b[1], a[2] - b[2]};
        const double squared =
            apart[0] * apart[0] + apart[1] * apart[1] + apart[2] * apart[2];
        if (!(squared < reach) || squared == 0) continue;
        const double distance = std::sqrt(squared);
        const ContactForce contact = contact_force(law_, pair.areas_m4, distance);
        const double factor = contact.force_n / distance;
        for (std::size_t d = 0; d < 3; ++d) {
            f[pair.i][d] += factor * apart[d];
            f[pair.j][d] -= factor * apart[d];
        }
        if constexpr (Tally) {
            ev_tally(pair.i, pair.j, atom->nlocal, 1, contact.energy_j, 0.0, factor,
                     apart[0], apart[1], apart[2]);
        }
    }
}

PairMagtticeContact::State PairMagtticeContact::state() const {
    State out;
    out.smallest_m = INFINITY;
    const double* const* const x = atom->x;
    for (const Candidate& pair : candidates_) {
        const double* a = x[pair.i];
        const double* b = x[pair.j];
        const double distance = std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
        out.smallest_m = std::min(out.smallest_m, distance);
        if (!(distance < law_.distance_m)) continue;
        out.touching += 1;
        out.energy_j += contact_force(law_, pair.areas_m4, distance).energy_j;
    }
    return out;
}

class ComputeMagtticeContact : public LAMMPS_NS::Compute {
  public:
    ComputeMagtticeContact(LAMMPS_NS::LAMMPS* lammps, int narg, char** arg);
    ~ComputeMagtticeContact() override;
    void init() override;
    double compute_scalar() override;  // energy
    void compute_vector() override;    // energy, touching pairs, smallest distance

  private:
    const PairMagtticeContact* pair_ = nullptr;
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
    size_vector = 3;
    extvector = -1;
    extlist = new int[3]{1, 1, 0};
    vector = new double[3]{};
}

ComputeMagtticeContact::~ComputeMagtticeContact() {
    delete[] vector;
    delete[] extlist;
}

void ComputeMagtticeContact::init() {
    pair_ = dynamic_cast<const PairMagtticeContact*>(
        force->pair_match("magttice/contact", 1));
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
}

void add_contact(Lines& lines, const LammpsInput& input) {
    const ContactLaw law = contact_law(input);
    lines.push_back(
        fmt::format("pair_style magttice/contact {:.17g} {:.17g} excluded {:.17g}",
                    law.distance_m, law.stiffness_pa_m, law.excluded));
    lines.push_back("pair_coeff * *");
    lines.push_back("compute contact all magttice/contact");
}

}  // namespace

// Nodes that may touch are listed within the distance and half of it, and again when a
// node has moved a quarter of the distance.
extern const Effect contact_effect{
    .name = "contact",
    .asked = [](const LammpsInput& input) { return input.contact.has_value(); },
    .commands = add_contact,
    .surface_spring_pa_m =
        [](const LammpsInput& input, const Body& body) {
            return contact_spring_pa_m(body, contact_law(input));
        },
    .neighbour_skin_m =
        [](const LammpsInput& input) { return 0.5 * contact_law(input).distance_m; },
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
