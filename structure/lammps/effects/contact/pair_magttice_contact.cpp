#include "structure/lammps/effects/contact/pair_magttice_contact.h"

#include "atom.h"
#include "error.h"
#include "force.h"
#include "memory.h"
#include "modify.h"
#include "neigh_list.h"
#include "neighbor.h"
#include "utils.h"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "structure/lammps/bodies.h"
#include "structure/lammps/contact_area.h"
#include "structure/lammps/failure.h"
#include "structure/lammps/fix_magttice.h"

namespace magfsi::structure {

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
    law_.distance_m = LAMMPS_NS::utils::numeric(FLERR, arg[0], false, lmp);
    law_.stiffness_pa_m = LAMMPS_NS::utils::numeric(FLERR, arg[1], false, lmp);
    if (narg == 4) law_.excluded = LAMMPS_NS::utils::numeric(FLERR, arg[3], false, lmp);
    if (!(law_.distance_m > 0) || !(law_.stiffness_pa_m > 0) || !(law_.excluded >= 1)) {
        fail(*error, std::string("pair_style magttice/contact: distance ") + arg[0] +
                         " and stiffness " + arg[1] +
                         " found; both must be positive, and \"excluded\" at least 1, "
                         "or bodies at rest would feel themselves");
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
    const auto bodies = bodies_of(*modify);
    if (bodies.empty()) {
        fail(*error,
             "pair_style magttice/contact found no fix magttice, it needs the surface "
             "of at least one");
    }
    node_.clear();
    for (std::size_t b = 0; b < bodies.size(); ++b) {
        const std::vector<Vec3>& x = bodies[b]->nodes_m();
        const auto areas = contact_areas(x, bodies[b]->lattice().elements);
        const auto first = static_cast<std::size_t>(bodies[b]->range().first_id);
        node_.resize(std::max(node_.size(), first + x.size()));
        for (std::size_t a = 0; a < x.size(); ++a) {
            node_[first + a] = {static_cast<int>(b), areas[a], x[a]};
        }
    }
    neighbor->request(this, instance_me);
}

double PairMagtticeContact::init_one(int, int) {
    return law_.distance_m;
}

bool PairMagtticeContact::may_touch(const SurfaceNode& a, const SurfaceNode& b) const {
    if (a.area_m2 == 0 || b.area_m2 == 0) return false;
    if (a.body != b.body) return true;
    const double at_rest =
        std::hypot(a.at_rest_m[0] - b.at_rest_m[0], a.at_rest_m[1] - b.at_rest_m[1],
                   a.at_rest_m[2] - b.at_rest_m[2]);
    return at_rest >= law_.excluded * law_.distance_m;
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

}  // namespace magfsi::structure
