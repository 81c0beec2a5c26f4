// SPDX-License-Identifier: GPL-2.0-or-later
#include "structure/lammps/effects/contact/contact_pair.h"

#include "atom.h"
#include "comm.h"
#include "error.h"
#include "force.h"
#include "memory.h"
#include "neighbor.h"
#include "utils.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <numeric>
#include <utility>

#include "structure/lammps/fix_magttice.h"
#include "structure/mesh/near_pairs.h"

namespace magfsi::structure {

PairMagtticeContact::PairMagtticeContact(LAMMPS_NS::LAMMPS* lammps) : Pair(lammps) {
    single_enable = 0;
    one_coeff = 1;
    no_virial_fdotr_compute = 1;
}

PairMagtticeContact::~PairMagtticeContact() noexcept {
    if (allocated == 0) return;
    memory->destroy(setflag);
    memory->destroy(cutsq);
}

void PairMagtticeContact::settings(int narg, char** arg) {
    law_ = {};
    period_m_ = {};
    bool known = narg >= 2;
    for (int i = 2; known && i < narg;) {
        const std::string keyword = arg[i++];
        const int values = keyword == "periodic" ? 3 : 1;
        known = i + values <= narg &&
                (keyword == "excluded" || keyword == "friction" || keyword == "periodic");
        for (int k = 0; known && k < values; ++k, ++i) {
            const double value = number(arg[i], lmp);
            if (keyword == "periodic")
                period_m_[k] = value;
            else
                (keyword == "friction" ? law_.friction : law_.excluded) = value;
        }
    }
    if (!known || !(law_.friction >= 0) || !(std::ranges::min(period_m_) >= 0)) {
        fail(*error,
             "pair_style magttice/contact takes a distance, a stiffness and no other "
             "keyword than \"excluded\" or \"friction\", each with one value, or "
             "\"periodic\" with three");
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
        if (node_[id].area_m2 > 0) surface_.push_back(id);
    goes_on_.clear();
    for (const FixMagttice* body : bodies_of(*modify))
        goes_on_.push_back(goes_on_through_sides(body->nodes_m(), period_m_));
    x_.resize(surface_.size());
    renewed_ = false;
}

double PairMagtticeContact::init_one(int, int) {
    return law_.distance_m;
}

bool PairMagtticeContact::may_touch(const SurfaceNode& a, const SurfaceNode& b,
                                    const Vec3& image_m) const {
    if (a.body != b.body) return true;
    const auto at_rest =
        rest_distance_m(a.at_rest_m, b.at_rest_m, image_m, goes_on_[a.body]);
    return !at_rest || *at_rest >= law_.excluded * law_.distance_m;
}

// Candidates are pairs within 1.5 contact distances. They are renewed when a node has
// moved by a quarter of the distance, or when atoms have changed their indices. The
// answer is the same on all ranks.
bool PairMagtticeContact::outdated() const {
    int moved = !renewed_ || neighbor->ago == 0 ? 1 : 0;
    const double most = 0.25 * law_.distance_m;
    for (std::size_t i = 0; moved == 0 && i < owned_.size(); ++i) {
        const Vec3 way = vector_at(atom->x[owned_[i]]) - renewed_at_m_[own_number_[i]];
        if (dot(way, way) > most * most) moved = 1;
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
    if (remembered_.empty()) remembered_ = kept_pairs();
    collect_candidates();
    put_back(std::exchange(remembered_, {}));
    renewed_ = true;
}

// Rows of the messages are the number and the position. A single rank copies without
// them.
void PairMagtticeContact::gather(std::span<const std::size_t> numbers) {
    constexpr std::size_t width = 4;
    std::vector<double> mine;
    for (const std::size_t n : numbers) {
        const int i = atom->map(surface_[n]);
        if (i < 0 || i >= atom->nlocal) continue;
        std::copy_n(atom->x[i], 3, x_[n].begin());
        if (comm->nprocs == 1) continue;
        mine.push_back(static_cast<double>(n));
        mine.insert(mine.end(), atom->x[i], atom->x[i] + 3);
    }
    if (comm->nprocs == 1) return;
    int count = mine.size();
    std::vector<int> counts(static_cast<std::size_t>(comm->nprocs)), first(counts.size());
    MPI_Allgather(&count, 1, MPI_INT, counts.data(), 1, MPI_INT, world);
    std::exclusive_scan(counts.begin(), counts.end(), first.begin(), 0);
    std::vector<double> all(width * numbers.size());
    MPI_Allgatherv(mine.data(), count, MPI_DOUBLE, all.data(), counts.data(),
                   first.data(), MPI_DOUBLE, world);
    for (std::size_t at = 0; at < all.size(); at += width)
        std::copy_n(all.data() + at + 1, 3, x_[all[at]].begin());
}

// Candidates are sorted by number, so that forces are summed in the same order on any
// number of ranks and after a restart.
void PairMagtticeContact::collect_candidates() {
    const double reach = 1.5 * law_.distance_m;
    const auto own = [this](std::size_t n) {
        const int i = atom->map(surface_[n]);
        return i < atom->nlocal ? i : -1;
    };
    candidates_.clear();
    watched_.clear();
    NearPairs(x_, reach, period_m_)
        .visit([&](std::size_t a, std::size_t b, const Vec3& image_m) {
            if (!(distance_m(x_[a], x_[b] + image_m) < reach)) return;
            const SurfaceNode& node_a = node_[surface_[a]];
            const SurfaceNode& node_b = node_[surface_[b]];
            if (!may_touch(node_a, node_b, image_m)) return;
            candidates_.push_back(
                {a, b, image_m, node_a.area_m2 * node_b.area_m2, own(a), own(b)});
            watched_.insert(watched_.end(), {a, b});
        });
    std::ranges::sort(candidates_, {}, [](const Candidate& pair) {
        return std::pair(numbers_of(pair), pair.image_m);
    });
    std::ranges::sort(watched_);
    watched_.erase(std::unique(watched_.begin(), watched_.end()), watched_.end());
}

// Difference of place, from the (image of the) second node to the first.
Vec3 PairMagtticeContact::apart_m(const Candidate& pair) const {
    return x_[pair.a] - x_[pair.b] - pair.image_m;
}

bool PairMagtticeContact::in_reach(const Vec3& apart) const {
    const double r2 = dot(apart, apart);
    return r2 < law_.distance_m * law_.distance_m && r2 != 0;
}

template <class Act>
void PairMagtticeContact::each_contact(const Act& act) const {
    for (const Candidate& pair : candidates_) {
        const Vec3 apart = apart_m(pair);
        if (!in_reach(apart)) continue;
        act(pair, apart, std::sqrt(dot(apart, apart)));
    }
}

// Each rank adds the force on the nodes that it owns; energy and virial are counted by
// the owner of the first node.
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
        const Vec3 push = factor * apart;
        if (pair.atom_a >= 0) add_to(f[pair.atom_a], push);
        if (pair.atom_b >= 0) add_to(f[pair.atom_b], -push);
        if (pair.atom_a < 0) return;
        if (eflag_global != 0) eng_vdwl += contact.energy_j;
        if (vflag_global == 0) return;
        constexpr int first[6] = {0, 1, 2, 0, 0, 1}, second[6] = {0, 1, 2, 1, 2, 2};
        for (std::size_t q = 0; q < 6; ++q)
            virial[q] += factor * apart[first[q]] * apart[second[q]];
    });
    if (law_.friction > 0) add_friction(eflag_global != 0);
}

// Every rank evaluates all pairs and drags the same stick points. Energy and losses are
// counted by the owner of the first node.
void PairMagtticeContact::add_friction(bool energy) {
    double* const* const f = atom->f;
    for (std::size_t c = 0; c < candidates_.size(); ++c) {
        const Candidate& pair = candidates_[c];
        StuckPair& stuck = stuck_[c];
        const Vec3 apart = apart_m(pair);
        if (!stuck.held && !in_reach(apart)) continue;
        const PairFriction rubbing = pair_friction(law_, pair.areas_m4, apart, stuck);
        if (pair.atom_a >= 0) add_to(f[pair.atom_a], rubbing.force_n);
        if (pair.atom_b >= 0) add_to(f[pair.atom_b], -rubbing.force_n);
        if (pair.atom_a < 0) continue;
        slid_j_ += rubbing.lost_j;
        if (energy) eng_vdwl += stuck_energy_j(law_, pair.areas_m4, stuck);
    }
}

std::vector<double> PairMagtticeContact::kept_pairs() const {
    std::vector<double> rows;
    for (std::size_t c = 0; c < stuck_.size(); ++c) {
        if (!stuck_[c].held) continue;
        rows.push_back(static_cast<double>(candidates_[c].a));
        rows.push_back(static_cast<double>(candidates_[c].b));
        rows.insert(rows.end(), stuck_[c].apart_m.begin(), stuck_[c].apart_m.end());
        rows.push_back(stuck_[c].slip_m);
    }
    return rows;
}

void PairMagtticeContact::put_pairs(std::span<const double> rows) {
    if (put_back(rows)) return;
    remembered_.assign(rows.begin(), rows.end());
    renewed_ = false;
}

// A pair may touch through several images; a row belongs to the candidate nearest to it.
bool PairMagtticeContact::put_back(std::span<const double> rows) {
    stuck_.assign(law_.friction > 0 ? candidates_.size() : 0, {});
    if (stuck_.empty()) return rows.empty();
    bool all = true;
    for (std::size_t at = 0; at < rows.size(); at += row_values) {
        const auto numbers = std::pair(static_cast<std::size_t>(rows[at]),
                                       static_cast<std::size_t>(rows[at + 1]));
        const auto same = std::ranges::equal_range(candidates_, numbers, {}, numbers_of);
        if (same.empty()) {
            all = false;
            continue;
        }
        Vec3 apart{};
        std::copy_n(rows.data() + at + 2, 3, apart.begin());
        const auto found = std::ranges::min_element(same, {}, [&](const Candidate& pair) {
            return distance_m(apart_m(pair), apart);
        });
        StuckPair& stuck = stuck_[found - candidates_.begin()];
        stuck.apart_m = apart;
        stuck.slip_m = rows[at + 5];
        stuck.held = true;
    }
    return all;
}

// Restart files hold the stuck pairs only, as the script repeats the settings.
void PairMagtticeContact::write_restart(FILE* file) {
    const std::vector<double> rows = kept_pairs();
    const int count = rows.size();
    fwrite(&count, sizeof count, 1, file);
    fwrite(rows.data(), sizeof(double), rows.size(), file);
}

// Rank 0 reads; the pairs take effect at the first renewal.
void PairMagtticeContact::read_restart(FILE* file) {
    int count = 0;
    if (comm->me == 0)
        LAMMPS_NS::utils::sfread(FLERR, &count, sizeof count, 1, file, nullptr, error);
    MPI_Bcast(&count, 1, MPI_INT, 0, world);
    remembered_.resize(count);
    if (comm->me == 0)
        LAMMPS_NS::utils::sfread(FLERR, remembered_.data(), sizeof(double),
                                 remembered_.size(), file, nullptr, error);
    MPI_Bcast(remembered_.data(), count, MPI_DOUBLE, 0, world);
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
    for (const Candidate& pair : candidates_) {
        const Vec3 apart = apart_m(pair);
        out.smallest_m = std::min(out.smallest_m, std::sqrt(dot(apart, apart)));
    }
    each_contact([&](const Candidate& pair, const Vec3&, double distance) {
        if (pair.atom_a < 0) return;
        out.touching += 1;
        out.energy_j += contact_force(law_, pair.areas_m4, distance).energy_j;
    });
    for (std::size_t c = 0; c < stuck_.size(); ++c)
        if (candidates_[c].atom_a >= 0)
            out.energy_j += stuck_energy_j(law_, candidates_[c].areas_m4, stuck_[c]);
    return out;
}

}  // namespace magfsi::structure
