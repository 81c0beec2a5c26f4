// SPDX-License-Identifier: GPL-2.0-or-later
// pair_style magttice/contact DISTANCE STIFFNESS [excluded FACTOR] [friction MU]
// [periodic LX LY LZ]: contact between the surfaces of the bodies. See
// docs/fix_magttice.md.
#pragma once

#include "pair.h"

#include <span>
#include <utility>
#include <vector>

#include "structure/lammps/effect.h"
#include "structure/lammps/effects/contact/contact_law.h"
#include "structure/lammps/kept_pairs.h"

namespace magfsi::structure {

class PairMagtticeContact : public LAMMPS_NS::Pair, public KeepsPairs {
  public:
    // This rank's share at the present positions.
    struct State {
        double energy_j = 0;
        double touching = 0;  // pairs closer than the distance
        double slid_j = 0;    // lost to friction since the start
        double smallest_m;    // distance of the closest pair
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

    // The pairs that stick: both numbers in surface_, StuckPair's place and slip.
    std::vector<double> kept_pairs() const override;
    void put_pairs(std::span<const double> rows) override;

  private:
    // Numbers in surface_, the lower one first.
    struct Candidate {
        std::size_t a, b;
        Vec3 image_m;  // of the second, from where it is: periods
        double areas_m4;
        int atom_a, atom_b;  // local indices of those that this rank owns, else -1
    };
    static std::pair<std::size_t, std::size_t> numbers_of(const Candidate& pair) {
        return {pair.a, pair.b};
    }
    bool may_touch(const SurfaceNode& a, const SurfaceNode& b, const Vec3& image_m) const;
    bool outdated() const;
    void renew();
    void gather(std::span<const std::size_t> numbers);
    void collect_candidates();
    bool put_back(std::span<const double> rows);
    static double squared(const Vec3& v);
    Vec3 apart_m(const Candidate& pair) const;
    bool in_reach(const Vec3& apart) const;
    template <class Act>
    void each_contact(const Act& act) const;
    void add_friction(bool energy);

    ContactLaw law_;
    double slid_j_ = 0;              // this rank's share, since the start
    Vec3 period_m_{};                // of axes along which all comes again, else 0
    std::vector<SurfaceNode> node_;  // by atom ID
    std::vector<std::array<bool, 3>> goes_on_;  // of each body, by its period
    std::vector<int> surface_;                  // IDs of those on surfaces
    std::vector<Vec3> x_;  // of surface_: all at a renewal, then watched_ alone
    std::vector<Vec3> renewed_at_m_;
    std::vector<Candidate> candidates_;
    std::vector<StuckPair> stuck_;      // of candidates_, with friction
    std::vector<double> remembered_;    // rows that wait for a renewal
    std::vector<std::size_t> watched_;  // those of candidates
    std::vector<int> owned_;            // local indices of this rank's share of surface_
    std::vector<std::size_t> own_number_;
    bool renewed_ = false;
};

}  // namespace magfsi::structure
