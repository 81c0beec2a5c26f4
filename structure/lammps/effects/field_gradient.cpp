// SPDX-License-Identifier: GPL-2.0-or-later
// Field that varies linearly in space (structure/magnetics/magnetic_forces.h): the
// keyword `gradient` of fix magttice.
#include "atom.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "structure/lammps/effect.h"
#include "structure/magnetics/magnetic_forces.h"

namespace magfsi::structure {
namespace {

// Words after the keyword: the nine entries of the matrix [T/m] row by row, and the
// origin [m].
constexpr int values = 12;

FieldGradient gradient_from(char** words, LAMMPS_NS::LAMMPS* lammps) {
    Eigen::Matrix3d matrix;
    Vec3 origin{};
    for (int i = 0; i < 9; ++i) matrix(i / 3, i % 3) = number(words[i], lammps);
    for (std::size_t d = 0; d < 3; ++d) origin[d] = number(words[9 + d], lammps);
    return {matrix, origin};
}

// Forces of the gradient on one body.
class GradientForce : public BodyForce {
  public:
    GradientForce(LAMMPS_NS::LAMMPS* lammps, const MagtticeBody& body, char** words)
        : BodyForce(lammps),
          gradient_(gradient_from(words, lammps)),
          of_body_(gradient_elements(body.nodes_m, body.lattice.elements,
                                     body.magnetization_a_m)) {}

    void rebuild(const OwnedElements& owned) override {
        nodes_ = owned.atom;
        elements_.clear();
        for (int e : owned.element) {
            elements_.push_back(of_body_[e]);
        }
    }
    void add() override {
        energy_j_ = elements_.empty() ? 0
                                      : add_gradient_forces(elements_, nodes_, gradient_,
                                                            atom->x[0], atom->f[0]);
    }
    // The gradient is constant in time, so that its work is the decrease of its energy.
    Turnover advance() override {
        const double before = energy_j_;
        add();
        return {.work_j = before - energy_j_};
    }
    double energy_j() const override { return energy_j_; }

  private:
    FieldGradient gradient_;
    std::vector<GradientElement> of_body_;   // all elements of the body
    std::vector<GradientElement> elements_;  // elements of this rank
    // Local or ghost indices, for each of elements_
    std::vector<std::array<int, 8>> nodes_;
    double energy_j_ = 0;
};

// Bodies that are not magnetised have no such keyword.
std::string gradient_words(const LammpsInput& input, const Body& body) {
    if (body.magnetization_a_m.empty()) return "";
    std::string out = " gradient";
    for (const Vec3& row : input.gradient->matrix_t_m)
        out += fmt::format(" {:.17g}", fmt::join(row, " "));
    return out + fmt::format(" {:.17g}", fmt::join(input.gradient->origin_m, " "));
}

}  // namespace

extern const Effect field_gradient_effect{
    .name = "field_gradient",
    .asked = [](const LammpsInput& input) { return input.gradient.has_value(); },
    .body_words = gradient_words,
    .force = {"gradient", values, make_force<GradientForce>}};

}  // namespace magfsi::structure
