// SPDX-License-Identifier: GPL-2.0-or-later
// Contact between the surfaces of bodies as a pair style of LAMMPS: pair_style
// magttice/contact DISTANCE STIFFNESS [excluded FACTOR] [friction MU] [periodic LX LY
// LZ]. See docs/fix_magttice.md.
#pragma once

#include "pair.h"

#include <span>
#include <utility>
#include <vector>

#include "structure/lammps/effect.h"
#include "structure/lammps/effects/contact/contact_law.h"
#include "structure/lammps/kept_pairs.h"

namespace magfsi::structure {

// Every rank holds all surface nodes and the same list of pairs; it adds the forces on
// its own atoms. Evaluation is collective. A node is named by its number in surface_.
class PairMagtticeContact : public LAMMPS_NS::Pair, public KeepsPairs {
  public:
    // State at the present positions. Sums are this rank's share, the distance is of all
    // pairs.
    struct State {
        double energy_j = 0;
        double touching = 0;  // number of pairs closer than the contact distance
        double slid_j = 0;    // energy lost to friction since the start
        double smallest_m;    // distance of the closest pair, infinite without any
    };

    explicit PairMagtticeContact(LAMMPS_NS::LAMMPS* lammps);
    ~PairMagtticeContact() noexcept override;  // LAMMPS's bases may throw since 2022

    void settings(int narg, char** arg) override;
    void coeff(int narg, char** arg) override;
    void init_style() override;
    double init_one(int i, int j) override;
    void compute(int eflag, int vflag) override;
    void* extract(const char* name, int& dimension) override;
    void write_restart(FILE* file) override;
    void read_restart(FILE* file) override;
    State state();  // collective

    // Pairs that stick, one row each: both numbers in surface_, then apart_m and slip_m
    // of StuckPair.
    std::vector<double> kept_pairs() const override;
    void put_pairs(std::span<const double> rows) override;

  private:
    // Pair of nodes that are near enough to touch before the next renewal, a < b.
    struct Candidate {
        std::size_t a, b;
        // Shift of the second node to its image near the first: whole periods
        Vec3 image_m;
        double areas_m4;
        int atom_a, atom_b;  // local indices of the atoms if this rank owns them, else -1
    };
    static std::pair<std::size_t, std::size_t> numbers_of(const Candidate& pair) {
        return {pair.a, pair.b};
    }
    // False for nodes of one body that are near each other at rest.
    bool may_touch(const SurfaceNode& a, const SurfaceNode& b, const Vec3& image_m) const;
    // True if the candidates must be renewed. Collective.
    bool outdated() const;
    // Gathers all surface nodes and renews the candidates. Collective.
    void renew();
    // Gathers the present positions of these surface nodes on every rank. Collective.
    void gather(std::span<const std::size_t> numbers);
    void collect_candidates();
    // Sets stuck_ from rows of kept_pairs(); false if a row belongs to no candidate.
    bool put_back(std::span<const double> rows);
    Vec3 apart_m(const Candidate& pair) const;
    // True for pairs closer than the contact distance, except at distance 0.
    bool in_reach(const Vec3& apart) const;
    // Calls act(candidate, apart, distance) for each pair that touches.
    template <class Act>
    void each_contact(const Act& act) const;
    void add_friction(bool energy);

    ContactLaw law_;
    double slid_j_ = 0;  // energy lost since the start, this rank's share
    Vec3 period_m_{};    // length of the period along each axis, 0 along axes without one
    std::vector<SurfaceNode> node_;  // one per atom, by atom ID
    // For each body the periods through which it continues into its own image
    std::vector<std::array<bool, 3>> goes_on_;
    std::vector<int> surface_;  // atom IDs of the surface nodes, ascending
    // Positions by number in surface_; between renewals only those in watched_ are up to
    // date
    std::vector<Vec3> x_;
    // Positions at the last renewal
    std::vector<Vec3> renewed_at_m_;
    std::vector<Candidate> candidates_;
    std::vector<StuckPair> stuck_;      // one per candidate; empty without friction
    std::vector<double> remembered_;    // rows of kept_pairs() that wait for a renewal
    std::vector<std::size_t> watched_;  // numbers of all nodes in candidates_, ascending
    std::vector<int> owned_;            // local indices of this rank's part of surface_
    // Number in surface_ of each of owned_
    std::vector<std::size_t> own_number_;
    // False until the first renewal of a run
    bool renewed_ = false;
};

}  // namespace magfsi::structure
