// The magnetic part of fix magttice: field variables and the work of the field.
#include "atom.h"
#include "error.h"
#include "input.h"
#include "modify.h"
#include "update.h"
#include "utils.h"
#include "variable.h"

#include <cstring>

#include "structure/lammps/failure.h"
#include "structure/lammps/fix_magttice.h"

namespace magfsi::structure {

void FixMagttice::parse_field(char** arg) {
    has_field_ = true;
    for (int d = 0; d < 3; ++d) {
        if (std::strncmp(arg[d], "v_", 2) == 0) {
            field_[d].name = arg[d] + 2;
        } else {
            field_[d].value_t = LAMMPS_NS::utils::numeric(FLERR, arg[d], false, lmp);
        }
    }
}

void FixMagttice::init_field() {
    for (FieldComponent& component : field_) {
        if (component.name.empty()) continue;
        component.variable = input->variable->find(component.name.c_str());
        if (component.variable < 0 ||
            input->variable->equalstyle(component.variable) == 0) {
            fail(*error, std::string("fix ") + id +
                             " magttice: the field names variable " + component.name +
                             ", an equal-style variable is needed");
        }
    }
}

void FixMagttice::evaluate_field() {
    modify->clearstep_compute();
    for (FieldComponent& component : field_) {
        if (component.variable < 0) continue;
        component.value_t = input->variable->compute_equal(component.variable);
    }
    modify->addstep_compute(update->ntimestep + 1);
}

std::array<double, 3> FixMagttice::charge_flow() const {
    std::array<double, 3> sum{};
    const double* const* const v = atom->v;
    for (const ChargedNode& node : charged_) {
        for (int d = 0; d < 3; ++d) sum[d] += node.charge_a_m * v[node.atom][d];
    }
    return sum;
}

// At this point of a step v holds the velocity of the half step, (x(n+1) - x(n)) / dt, so
// that the mean of the field at both ends gives the work of the step.
void FixMagttice::advance_field() {
    std::array<double, 3> before{};
    for (int d = 0; d < 3; ++d) before[d] = field_[d].value_t;
    evaluate_field();
    const std::array<double, 3> flow = charge_flow();
    for (int d = 0; d < 3; ++d) {
        work_j_ += 0.5 * update->dt * (before[d] + field_[d].value_t) * flow[d];
    }
}

}  // namespace magfsi::structure
