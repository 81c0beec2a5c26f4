// SPDX-License-Identifier: GPL-2.0-or-later
// Maxwell branches (structure/lattice/maxwell.h): their forces within fix magttice, and
// their states, which move with the first node of their element.
#include "atom.h"
#include "update.h"

#include <algorithm>
#include <span>
#include <unordered_map>
#include <utility>
#include <vector>

#include "structure/body.h"
#include "structure/lammps/effect.h"
#include "structure/lattice/maxwell_kernel.h"

namespace magfsi::structure {
namespace {

class BranchForce : public BodyForce {
  public:
    BranchForce(LAMMPS_NS::LAMMPS* lammps, const MagtticeBody& body, char**)
        : BodyForce(lammps), lattice_(body.lattice), by_first_(body.nodes_m.size()) {
        kernel_.assign(lattice_);  // refuses wrong branches before the run
        std::size_t most = 0;
        for (std::size_t e = 0; e < lattice_.elements.size(); ++e) {
            const int element = static_cast<int>(e);
            values_ = std::max(values_, kernel_.values(element));
            auto& own = by_first_[lattice_.elements[e][0]];
            if (kernel_.values(element) > 0) own.push_back(element);
            most = std::max(most, own.size());
        }
        kept_ = static_cast<int>(most * values_);
        kernel_.assign(lattice_, {}, {});
    }

    // The states that this rank had or has been given go to the new order.
    void rebuild(const OwnedElements& owned) override {
        std::unordered_map<int, std::vector<double>> states;
        std::swap(states, arrived_);
        for (const int element : owned.element) {
            if (!kernel_.has(element) || states.contains(element)) continue;
            auto& state = states[element];
            state.resize(values_);
            kernel_.get(element, state);
        }
        kernel_.assign(lattice_, owned.element, owned.atom);
        for (const int element : owned.element) {
            const auto found = states.find(element);
            if (found != states.end() && kernel_.has(element))
                kernel_.set(element, found->second);
        }
    }

    // The positions are the first of a run: strains start there, states stay.
    void add() override { power_w_ = forces(0); }
    // The loss of a step by the trapezium rule.
    Turnover advance() override {
        const double before_w = power_w_;
        power_w_ = forces(update->dt);
        return {.lost_j = 0.5 * update->dt * (before_w + power_w_)};
    }
    // A minimiser looks for a rest state, in which the branches are relaxed.
    void minimize() override {}

    // A second pass at the same positions, in which nothing moves.
    double stored_j() override {
        if (kernel_.empty()) return 0;
        scratch_.assign(3 * static_cast<std::size_t>(atom->nlocal + atom->nghost), 0.0);
        return kernel_.add_forces(atom->x[0], 0, scratch_.data(), true).energy_j;
    }

    int kept_values() const override { return kept_; }
    void write_kept(int node, double* values) const override {
        for (const int element : by_first_[node]) {
            const std::span<double> own(values, values_);
            if (kernel_.has(element)) {
                kernel_.get(element, own);
            } else if (const auto found = arrived_.find(element);
                       found != arrived_.end()) {
                std::ranges::copy(found->second, own.begin());
            }
            values += values_;
        }
    }
    void take_kept(int node, const double* values) override {
        for (const int element : by_first_[node]) {
            const std::span<const double> own(values, values_);
            if (kernel_.has(element))
                kernel_.set(element, own);
            else
                arrived_[element].assign(own.begin(), own.end());
            values += values_;
        }
    }

  private:
    double forces(double dt_s) {
        if (kernel_.empty()) return 0;
        return kernel_.add_forces(atom->x[0], dt_s, atom->f[0], false).dissipation_w;
    }

    const Lattice& lattice_;
    // Elements with branches by their first node
    std::vector<std::vector<int>> by_first_;
    std::size_t values_ = 0;  // of the element with the most branches
    int kept_ = 0;
    MaxwellKernel kernel_;
    // States of elements that this rank does not have yet
    std::unordered_map<int, std::vector<double>> arrived_;
    double power_w_ = 0;
    std::vector<double> scratch_;
};

}  // namespace

// The branches are among the words of each material (material_words.h).
extern const Effect viscoelasticity_effect{
    .name = "viscoelasticity",
    .asked =
        [](const LammpsInput& input) {
            return std::ranges::any_of(input.bodies, is_viscoelastic);
        },
    // fix magttice itself reads the branches, which belong to its materials.
    .force = {force_of_branches, 0, make_force<BranchForce>}};

}  // namespace magfsi::structure
