#include "structure/lammps/effects/magnetic_field/uniform_field.h"

#include "atom.h"
#include "error.h"
#include "input.h"
#include "modify.h"
#include "update.h"
#include "utils.h"
#include "variable.h"

#include <cstring>

#include "structure/lammps/failure.h"
#include "structure/magnetics/magnetic_forces.h"

namespace magfsi::structure {

UniformField::UniformField(LAMMPS_NS::LAMMPS* lammps, const MagtticeBody& body,
                           char** components)
    : BodyForce(lammps),
      who_(body.who),
      range_(body.range),
      charge_a_m_(
          nodal_charges(body.nodes_m, body.lattice.elements, body.magnetization_a_m)) {
    for (int d = 0; d < 3; ++d) {
        if (std::strncmp(components[d], "v_", 2) == 0) {
            field_[d].name = components[d] + 2;
        } else {
            field_[d].value_t =
                LAMMPS_NS::utils::numeric(FLERR, components[d], false, lmp);
        }
    }
}

void UniformField::init() {
    for (Component& component : field_) {
        if (component.name.empty()) continue;
        component.variable = input->variable->find(component.name.c_str());
        if (component.variable < 0 ||
            input->variable->equalstyle(component.variable) == 0) {
            fail(*error, who_ + ": the field names variable " + component.name +
                             ", an equal-style variable is needed");
        }
    }
}

void UniformField::rebuild(const OwnedElements&) {
    charged_.clear();
    for (int i = 0; i < atom->nlocal; ++i) {
        const int node = range_.node(atom->tag[i]);
        if (node < 0 || charge_a_m_[static_cast<std::size_t>(node)] == 0) continue;
        charged_.push_back({i, charge_a_m_[static_cast<std::size_t>(node)]});
    }
}

void UniformField::add() {
    evaluate();
    add_forces();
}

// At this point of a step v holds the velocity of the half step, (x(n+1) - x(n)) / dt, so
// that the mean of the field at both ends gives the work of the step.
BodyForce::Turnover UniformField::advance() {
    std::array<double, 3> before{};
    for (int d = 0; d < 3; ++d) before[d] = field_[d].value_t;
    evaluate();
    const std::array<double, 3> flow = charge_flow();
    Turnover step;
    for (int d = 0; d < 3; ++d) {
        step.work_j += 0.5 * update->dt * (before[d] + field_[d].value_t) * flow[d];
    }
    add_forces();
    return step;
}

double UniformField::energy_j() const {
    double energy_j = 0;
    const double* const* const x = atom->x;
    for (const ChargedNode& node : charged_) {
        for (int d = 0; d < 3; ++d)
            energy_j -= node.charge_a_m * field_[d].value_t * x[node.atom][d];
    }
    return energy_j;
}

void UniformField::evaluate() {
    modify->clearstep_compute();
    for (Component& component : field_) {
        if (component.variable < 0) continue;
        component.value_t = input->variable->compute_equal(component.variable);
    }
    modify->addstep_compute(update->ntimestep + 1);
}

void UniformField::add_forces() {
    double* const* const f = atom->f;
    for (const ChargedNode& node : charged_) {
        for (int d = 0; d < 3; ++d)
            f[node.atom][d] += node.charge_a_m * field_[d].value_t;
    }
}

std::array<double, 3> UniformField::charge_flow() const {
    std::array<double, 3> sum{};
    const double* const* const v = atom->v;
    for (const ChargedNode& node : charged_) {
        for (int d = 0; d < 3; ++d) sum[d] += node.charge_a_m * v[node.atom][d];
    }
    return sum;
}

}  // namespace magfsi::structure
