// The forces q_a B on the nodes of a body with fixed magnetisation in a uniform field
// (structure/magnetics/magnetic_forces.h), whose components are numbers or variables of
// LAMMPS.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "structure/lammps/body_force.h"

namespace magfsi::structure {

class UniformField : public BodyForce {
  public:
    // components: Bx By Bz, each a number [T] or v_NAME.
    UniformField(LAMMPS_NS::LAMMPS* lammps, const MagtticeBody& body, char** components);

    void init() override;
    void rebuild(const OwnedElements& owned) override;
    void add() override;
    Turnover advance() override;
    double energy_j() const override;

  private:
    struct Component {
        std::string name;  // of the variable; empty: constant
        int variable = -1;
        double value_t = 0;
    };
    struct ChargedNode {
        int atom = 0;  // local index
        double charge_a_m = 0;
    };

    void evaluate();
    void add_forces();
    std::array<double, 3> charge_flow() const;  // sum of q v, this rank [A m2/s]

    std::string who_;
    NodeRange range_;
    std::vector<double> charge_a_m_;    // by node of the body
    std::vector<ChargedNode> charged_;  // owned by this rank, charge not zero
    std::array<Component, 3> field_;
};

}  // namespace magfsi::structure
