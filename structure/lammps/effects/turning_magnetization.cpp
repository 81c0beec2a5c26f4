// SPDX-License-Identifier: GPL-2.0-or-later
// Magnetisation that follows the rotation of the material
// (structure/magnetics/turned_moments.h): the keyword `turned_field Bx By Bz` of fix
// magttice adds the forces of the uniform field.
#include "atom.h"
#include "error.h"
#include "update.h"

#include <algorithm>

#include "structure/body.h"
#include "structure/lammps/effect.h"
#include "structure/lammps/field_components.h"
#include "structure/magnetics/turned_moments.h"

namespace magfsi::structure {
namespace {

class TurnedField : public BodyForce {
  public:
    TurnedField(LAMMPS_NS::LAMMPS* lammps, const MagtticeBody& body, char** components)
        : BodyForce(lammps),
          field_(lammps, body.who, components),
          all_(turned_elements(body.nodes_m, body.lattice.elements,
                               body.magnetization_a_m)) {}

    void init() override { field_.init(); }
    void rebuild(const OwnedElements& owned) override {
        elements_.clear();
        for (const int element : owned.element) elements_.push_back(all_[element]);
        atoms_ = owned.atom;
    }
    void add() override {
        field_.evaluate();
        add_forces();
    }
    // The mean of the field at both ends of a step times the change of the moment: exact
    // for a field linear in time.
    Turnover advance() override {
        const Vec3 before = field_.field_t();
        const Eigen::Vector3d moment = moment_a_m2_;
        field_.evaluate();
        add_forces();
        const Vec3 mean = 0.5 * (before + field_.field_t());
        return {.work_j = Eigen::Vector3d(mean.data()).dot(moment_a_m2_ - moment)};
    }
    double energy_j() const override { return -field().dot(moment_a_m2_); }

  private:
    Eigen::Vector3d field() const { return Eigen::Vector3d(field_.field_t().data()); }
    void add_forces() {
        moment_a_m2_ = Eigen::Vector3d::Zero();
        if (elements_.empty()) return;
        moment_a_m2_ =
            add_turned_forces(elements_, atoms_, field(), atom->x[0], atom->f[0]);
    }

    FieldComponents field_;
    std::vector<TurnedElement> all_, elements_;  // of the body, of this rank
    std::vector<std::array<int, 8>> atoms_;
    Eigen::Vector3d moment_a_m2_ = Eigen::Vector3d::Zero();  // of this rank
};

}  // namespace

extern const Effect turning_magnetization_effect{
    .name = "turning_magnetization",
    .asked =
        [](const LammpsInput& input) {
            return input.field.has_value() &&
                   std::ranges::any_of(input.bodies, is_turned);
        },
    .body_words = [](const LammpsInput&, const Body& body) -> std::string {
        return is_turned(body) ? " turned_field v_Bx v_By v_Bz" : "";
    },
    .force = {"turned_field", 3, make_force<TurnedField>}};

}  // namespace magfsi::structure
