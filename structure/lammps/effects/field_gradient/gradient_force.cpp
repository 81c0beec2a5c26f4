// A field that varies linearly in space (structure/magnetics/field_gradient.h).
#include "atom.h"
#include "utils.h"

#include "structure/lammps/body_force.h"
#include "structure/lammps/register_styles.h"
#include "structure/magnetics/magnetic_forces.h"

namespace magfsi::structure {

namespace {

FieldGradient gradient_from(char** values, LAMMPS_NS::LAMMPS* lammps) {
    Eigen::Matrix3d matrix;
    for (int i = 0; i < 9; ++i) {
        matrix(i / 3, i % 3) = LAMMPS_NS::utils::numeric(FLERR, values[i], false, lammps);
    }
    Vec3 origin{};
    for (std::size_t d = 0; d < 3; ++d) {
        origin[d] = LAMMPS_NS::utils::numeric(FLERR, values[9 + d], false, lammps);
    }
    return {matrix, origin};
}

class GradientForce : public BodyForce {
  public:
    GradientForce(LAMMPS_NS::LAMMPS* lammps, const MagtticeBody& body, char** values)
        : BodyForce(lammps),
          gradient_(gradient_from(values, lammps)),
          of_body_(gradient_elements(body.nodes_m, body.lattice.elements,
                                     body.magnetization_a_m)) {}

    void rebuild(const OwnedElements& owned) override {
        nodes_ = owned.atom;
        elements_.clear();
        for (int e : owned.element) {
            elements_.push_back(of_body_[static_cast<std::size_t>(e)]);
        }
    }
    void add() override {
        energy_j_ = elements_.empty() ? 0
                                      : add_gradient_forces(elements_, nodes_, gradient_,
                                                            atom->x[0], atom->f[0]);
    }
    // Constant in time: its work is what its energy has lost.
    Turnover advance() override {
        const double before = energy_j_;
        add();
        return {.work_j = before - energy_j_};
    }
    double energy_j() const override { return energy_j_; }

  private:
    FieldGradient gradient_;
    std::vector<GradientElement> of_body_;
    std::vector<GradientElement> elements_;  // of this rank, and their nodes
    std::vector<std::array<int, 8>> nodes_;
    double energy_j_ = 0;
};

}  // namespace

void register_field_gradient(LAMMPS_NS::LAMMPS&) {
    register_body_force("gradient",
                        {12,
                         [](LAMMPS_NS::LAMMPS* lammps, const MagtticeBody& body,
                            char** values) -> std::unique_ptr<BodyForce> {
                             return std::make_unique<GradientForce>(lammps, body, values);
                         }});
}

}  // namespace magfsi::structure
