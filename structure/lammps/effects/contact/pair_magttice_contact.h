// pair_style magttice/contact DISTANCE STIFFNESS [excluded FACTOR]: contact between the
// surfaces of the bodies (contact.h). See docs/fix_magttice.md.
#pragma once

#include "pair.h"

#include <vector>

#include "structure/lammps/effects/contact/contact_law.h"
#include "structure/mesh/mesh.h"

namespace magfsi::structure {

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
    // Of one atom, by its ID.
    struct SurfaceNode {
        int body = -1;
        double area_m2 = 0;  // zero: not on a surface
        Vec3 at_rest_m{};
    };
    bool may_touch(const SurfaceNode& a, const SurfaceNode& b) const;
    void collect_candidates();
    template <bool Tally>
    void add_forces();

    ContactLaw law_;
    std::vector<SurfaceNode> node_;
    std::vector<Candidate> candidates_;  // since the last neighbour list
};

}  // namespace magfsi::structure
