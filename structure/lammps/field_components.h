// SPDX-License-Identifier: GPL-2.0-or-later
// The words Bx By Bz of fix magttice: a uniform field by its components, each a number or
// a variable of LAMMPS.
#pragma once

#include "error.h"
#include "input.h"
#include "update.h"
#include "variable.h"

#include <array>
#include <string>

#include "structure/lammps/effect.h"

namespace magfsi::structure {

class FieldComponents : protected LAMMPS_NS::Pointers {
  public:
    // words: Bx By Bz, each a number [T] or v_NAME.
    FieldComponents(LAMMPS_NS::LAMMPS* lammps, std::string who, char** words)
        : Pointers(lammps), who_(std::move(who)) {
        for (std::size_t d = 0; d < 3; ++d) {
            const std::string word = words[d];
            if (word.starts_with("v_")) {
                name_[d] = word.substr(2);
            } else {
                value_t_[d] = number(words[d], lmp);
            }
        }
    }

    // Looks the variables up; to be called at the start of each run.
    void init() {
        for (std::size_t d = 0; d < 3; ++d) {
            if (name_[d].empty()) continue;
            variable_[d] = input->variable->find(name_[d].c_str());
            if (variable_[d] < 0 || input->variable->equalstyle(variable_[d]) == 0) {
                fail(*error,
                     "{}: the field names variable {}, an equal-style variable is needed",
                     who_, name_[d]);
            }
        }
    }

    // Computes the present field. LAMMPS must know one step ahead which computes and
    // fixes the variables will ask for.
    void evaluate() {
        modify->clearstep_compute();
        for (std::size_t d = 0; d < 3; ++d) {
            if (variable_[d] < 0) continue;
            value_t_[d] = input->variable->compute_equal(variable_[d]);
        }
        modify->addstep_compute(update->ntimestep + 1);
    }

    const Vec3& field_t() const { return value_t_; }

  private:
    std::string who_;
    std::array<std::string, 3> name_;  // empty: the component is a number
    std::array<int, 3> variable_{-1, -1, -1};
    Vec3 value_t_{};
};

}  // namespace magfsi::structure
