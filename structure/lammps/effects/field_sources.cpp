// SPDX-License-Identifier: GPL-2.0-or-later
// Field of dipoles, magnets, coils and grids (structure/magnetics/source_field.h): fix ID
// group magttice/sources "WORDS" places the sources at the time of each step; the keyword
// `sources ID` of fix magttice adds their forces on a body's nodes.
#include "atom.h"
#include "error.h"
#include "update.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <exception>
#include <optional>

#include "structure/lammps/effect.h"
#include "structure/lammps/source_words.h"
#include "structure/magnetics/magnetic_forces.h"

namespace magfsi::structure {
namespace {

// Owner of the sources, shared by all bodies.
class FixMagtticeSources : public LAMMPS_NS::Fix {
  public:
    FixMagtticeSources(LAMMPS_NS::LAMMPS* lammps, int narg, char** arg)
        : Fix(lammps, narg, arg) {
        if (narg != 4)
            fail(*error, "fix {} magttice/sources needs one text of sources in quotes",
                 id);
        try {
            field_.emplace(parse_source_words(arg[3]));
        } catch (const std::exception& cause) {
            fail(*error, "fix {} magttice/sources: {}", id, cause.what());
        }
    }
    int setmask() override { return 0; }
    // fix_modify ID held TIME fixes the sources at their places and strengths of a time
    // [s].
    int modify_param(int count, char** words) override {
        if (std::strcmp(words[0], "held") != 0) return 0;
        if (count < 2) fail(*error, "fix_modify {} held needs a time", id);
        held_s_ = number(words[1], lmp);
        placed_ = -1;
        return 2;
    }

    // The sources at the time of the present step. Times come from the step number, so
    // that they are the same after a restart.
    const SourceField& field() {
        if (placed_ != update->ntimestep) {
            placed_ = update->ntimestep;
            try {
                field_->set_time(held_s_.value_or(1.0 * placed_ * update->dt));
            } catch (const std::exception& cause) {
                fail(*error, "sources of the magnetic field: {}", cause.what());
            }
        }
        return *field_;
    }
    // True if neither places nor strengths change with time.
    bool at_rest() const { return held_s_.has_value() || field_->at_rest(); }

  private:
    std::optional<SourceField> field_;
    // Time of fix_modify held [s]
    std::optional<double> held_s_;
    LAMMPS_NS::bigint placed_ = -1;  // step whose time field_ is set to; -1: none
};

// Forces of the sources' field on one body.
class SourceForce : public BodyForce {
  public:
    SourceForce(LAMMPS_NS::LAMMPS* lammps, const MagtticeBody& body, char** words)
        : BodyForce(lammps),
          who_(body.who),
          fix_id_(words[0]),
          of_body_(moment_elements(body.nodes_m, body.lattice.elements,
                                   body.magnetization_a_m)) {}

    void init() override {
        const int at = modify->find_fix(fix_id_);
        if (at < 0 || std::strcmp(modify->fix[at]->style, "magttice/sources") != 0)
            fail(*error,
                 "{}: there is no fix {} of the style magttice/sources; it must come "
                 "before",
                 who_, fix_id_);
        sources_ = static_cast<FixMagtticeSources*>(modify->fix[at]);
    }
    void rebuild(const OwnedElements& owned) override {
        nodes_ = owned.atom;
        moments_.clear();
        for (int e : owned.element) moments_.push_back(of_body_[e]);
        seen_.clear();
        for (const auto& element : nodes_)
            seen_.insert(seen_.end(), element.begin(), element.end());
        std::ranges::sort(seen_);
        const auto twice = std::ranges::unique(seen_);
        seen_.erase(twice.begin(), twice.end());
        const std::size_t atoms = seen_.empty() ? 0 : 1 + std::size_t(seen_.back());
        samples_.resize(atoms);
        force_n_.assign(3 * atoms, 0);
        known_ = false;
    }
    void add() override {
        evaluate();
        for (const int i : seen_) {
            for (int d = 0; d < 3; ++d)
                atom->f[i][d] += force_n_[3 * std::size_t(i) + std::size_t(d)];
        }
    }
    // Work of a step: for sources at rest the decrease of the energy; else the mean force
    // of the step times the displacement, as v is (x(n+1) - x(n)) / dt. Just after atoms
    // have changed their indices the earlier force is not known, and the present one
    // stands for it.
    Turnover advance() override {
        const double before_j = energy_j_;
        const std::vector<double> before_n = force_n_;
        const bool known = known_;
        add();
        if (sources_->at_rest() && known) return {.work_j = before_j - energy_j_};
        const std::vector<double>& first = known ? before_n : force_n_;
        Turnover step;
        for (const int i : seen_) {
            for (int d = 0; d < 3; ++d) {
                const std::size_t q = 3 * std::size_t(i) + std::size_t(d);
                step.work_j +=
                    0.5 * update->dt * (first[q] + force_n_[q]) * atom->v[i][d];
            }
        }
        return step;
    }
    double energy_j() const override { return energy_j_; }

  private:
    void evaluate() {
        const SourceField& field = sources_->field();
        std::ranges::fill(force_n_, 0);
        known_ = true;
        energy_j_ = 0;
        if (moments_.empty()) return;
        const double* const* const x = atom->x;
        try {
            for (const int i : seen_)
                samples_[std::size_t(i)] = field.sample({x[i][0], x[i][1], x[i][2]});
        } catch (const std::exception& cause) {
            fail(*error, "{} at step {}: {}", who_, update->ntimestep, cause.what());
        }
        energy_j_ = add_source_forces(moments_, nodes_, samples_, x[0], force_n_.data());
    }

    std::string who_, fix_id_;
    FixMagtticeSources* sources_ = nullptr;
    std::vector<Matrix8> of_body_;  // all elements of the body
    std::vector<Matrix8> moments_;  // elements of this rank
    // Local or ghost indices, for each of moments_
    std::vector<std::array<int, 8>> nodes_;
    std::vector<int> seen_;  // indices of all atoms in nodes_, ascending, each once
    // Field by atom index
    std::vector<FieldSample> samples_;
    // Forces of the sources alone, three per atom, ghosts included
    std::vector<double> force_n_;
    bool known_ = false;  // force_n_ is of the present atom indices
    double energy_j_ = 0;
};

}  // namespace

extern const Effect field_sources_effect{
    .name = "field_sources",
    .asked = [](const LammpsInput& input) { return !input.sources.empty(); },
    .before_bodies =
        [](Lines& lines, const LammpsInput& input) {
            lines.push_back(fmt::format("fix sources all magttice/sources \"{}\"",
                                        source_words(input.sources)));
        },
    .body_words = [](const LammpsInput&, const Body& body) -> std::string {
        return body.magnetization_a_m.empty() ? "" : " sources sources";
    },
    .force = {"sources", 1, make_force<SourceForce>},
    .fix = {"magttice/sources", make_fix<FixMagtticeSources>}};

}  // namespace magfsi::structure
