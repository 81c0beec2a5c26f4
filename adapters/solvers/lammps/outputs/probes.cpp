// SPDX-License-Identifier: GPL-2.0-or-later
// Rows of probes.csv. Their columns in order: bodies, fluid, interface between them,
// energy audit.
#include <fmt/format.h>

#include <utility>

#include "adapters/solvers/bodies/probe_row.h"
#include "adapters/solvers/fluids/fluid_probes.h"
#include "adapters/solvers/lammps/structure_run.h"
#include "coupler/participants/errors.h"
#include "coupler/participants/handshake.h"
#include "coupler/participants/world.h"
#include "coupler/step/report.h"
#include "structure/motion.h"

namespace magfsi::lammps {

namespace {

class Probes : public coupler::Output {
  public:
    explicit Probes(StructureRun& run);
    void begin() override {
        if (!run_.session.restart()) write();
    }
    void end_step() override {
        if (run_.scene.probes->mean_forces) add_forces();
        if (run_.session.clock().step() % every_ == 0) write();
    }
    const output::ProbeFile* probes() const override { return file_.get(); }

  private:
    std::vector<bodies::Vec3> forces();
    void add_forces();
    void take_means(std::vector<bodies::BodyLoads>& loads,
                    std::vector<bodies::Vec3>& on_parts);
    std::vector<bodies::BodyLoads> collect_loads(const NodalState& nodes) const;
    void add_supports(const NodalState& state,
                      std::vector<bodies::BodyLoads>& loads) const;
    void add_contact(std::vector<bodies::BodyLoads>& loads) const;
    FluidEnergy add_partner_values(std::vector<double>& row);
    void add_audit(const NodalState& nodes, const FluidEnergy& fluid,
                   std::vector<double>& row);
    void write();

    StructureRun& run_;
    std::int64_t every_;                           // steps between two rows
    std::unique_ptr<bodies::ProbeRow> of_bodies_;  // on the root
    std::unique_ptr<output::ProbeFile> file_;      // on the leading rank
};

// The order of the columns is that in which write() appends values.
Probes::Probes(StructureRun& run)
    : run_(run), every_(run.session.clock().every(run.scene.probes->every_s)) {
    if (run.session.world().root())
        of_bodies_ =
            std::make_unique<bodies::ProbeRow>(run.scene, run.input.bodies, run.start);
    if (!run.session.world().leads()) return;
    std::vector<std::string> columns = of_bodies_->columns();
    for (const auto& more :
         {fluids::fluid_columns(run.scene), fluids::interface_columns(run.scene),
          run.audit ? run.audit->columns() : std::vector<std::string>{}}) {
        columns.insert(columns.end(), more.begin(), more.end());
    }
    file_ = coupler::open_probes(run.session, columns);
    run.probes = file_.get();
}

// The fluid's force in the last step on each body, then on each part. Collective.
std::vector<bodies::Vec3> Probes::forces() {
    auto all = run_.coupling->force_on_bodies();
    const auto on_parts = run_.coupling->force_on_parts();
    all.insert(all.end(), on_parts.begin(), on_parts.end());
    return all;
}

// Adds the impulses of the last step to the sums since the last row. Collective.
void Probes::add_forces() {
    const auto now_n = forces();
    const double step_s = run_.session.clock().step_s();
    ForceSums& sums = run_.force_sums;
    sums.impulse_n_s.resize(now_n.size());
    for (std::size_t i = 0; i < now_n.size(); ++i)
        sums.impulse_n_s[i] += step_s * now_n[i];
    sums.time_s += step_s;
}

// Puts the means since the last row in their places and empties the sums; the first row
// has none.
void Probes::take_means(std::vector<bodies::BodyLoads>& loads,
                        std::vector<bodies::Vec3>& on_parts) {
    const ForceSums sums = std::exchange(run_.force_sums, {});
    if (!(sums.time_s > 0)) return;
    for (std::size_t i = 0; i < sums.impulse_n_s.size(); ++i) {
        const bodies::Vec3 mean = sums.impulse_n_s[i] / sums.time_s;
        if (i < loads.size())
            loads[i].mean_fluid_force_n = mean;
        else
            on_parts[i - loads.size()] = mean;
    }
}

// The loads on each body that probes need; complete on the root only. Collective.
std::vector<bodies::BodyLoads> Probes::collect_loads(const NodalState& nodes) const {
    std::vector<bodies::BodyLoads> loads(run_.input.bodies.size());
    if (run_.coupling && needs(run_.scene, bodies::Load::fluid_force)) {
        const auto forces = run_.coupling->force_on_bodies();
        for (std::size_t b = 0; b < loads.size(); ++b) loads[b].fluid_force_n = forces[b];
    }
    if (run_.coupling && needs(run_.scene, bodies::Load::fluid_torque)) {
        const auto torques = run_.coupling->torque_on_bodies();
        for (std::size_t b = 0; b < loads.size(); ++b)
            loads[b].fluid_torque_n_m = torques[b];
    }
    if (needs(run_.scene, bodies::Load::energies)) {
        for (std::size_t b = 0; b < loads.size(); ++b) {
            loads[b].energy_elastic_j = run_.engine->fix_vector(run_.fix_ids[b], 1);
            loads[b].work_magnetic_j = run_.engine->fix_vector(run_.fix_ids[b], 3);
            loads[b].kinetic_beyond_nodes_j = run_.rigid.beyond_nodes_j(nodes.rigid, b);
            // The work on a path of equilibria is known on the root only. The collective
            // calls above are made by all ranks.
            if (!run_.field_work.empty())
                loads[b].work_magnetic_j = run_.field_work[b].work_j();
        }
    }
    if (needs(run_.scene, bodies::Load::support)) add_supports(nodes, loads);
    if (needs(run_.scene, bodies::Load::contact)) add_contact(loads);
    return loads;
}

// Adds the force of all contact on each node. Collective.
void Probes::add_contact(std::vector<bodies::BodyLoads>& loads) const {
    const auto force_n = run_.engine->gather_contact_forces(run_.atoms);
    if (force_n.empty()) return;
    auto from = force_n.begin();
    for (std::size_t b = 0; b < loads.size(); ++b) {
        const auto to =
            from + static_cast<std::ptrdiff_t>(run_.input.bodies[b].mesh.nodes.size());
        loads[b].contact_n.assign(from, to);
        from = to;
    }
}

// Adds the force of the supports on each node [N], m a - F: m its mass, a the
// acceleration of its prescribed motion (0 if it has none), F the sum of all other forces
// on it. It is meant for held nodes; others have -F. Collective.
void Probes::add_supports(const NodalState& state,
                          std::vector<bodies::BodyLoads>& loads) const {
    const auto force_n = run_.engine->gather_forces(run_.atoms);
    if (!run_.session.world().root()) return;
    const double time_s = run_.session.clock().time_s();
    std::size_t first = 0;
    for (std::size_t b = 0; b < loads.size(); ++b) {
        const std::size_t nodes = run_.input.bodies[b].mesh.nodes.size();
        auto& support_n = loads[b].support_n;
        support_n.resize(nodes);
        for (std::size_t n = 0; n < nodes; ++n) support_n[n] = -force_n[first + n];
        for (const structure::PrescribedMotion& motion : run_.input.motions) {
            if (motion.body != b) continue;
            for (const int node : structure::moved_nodes(run_.input.bodies[b], motion))
                support_n[node] +=
                    state.mass_kg[first + node] *
                    structure::node_acceleration_m_s2(
                        motion.course, state.position_m[first + node], time_s);
        }
        first += nodes;
    }
}

// Appends the fluid's values and those of the interface, which the fluid sends to the
// root. Returns the fluid's energies on the root of a run with an audit: they are the
// last two of its values. Collective.
FluidEnergy Probes::add_partner_values(std::vector<double>& row) {
    const coupler::Session& session = run_.session;
    const std::size_t fluid_values = fluids::fluid_columns(run_.scene).size();
    const auto given = run_.balance() ? run_.balance()->collect(session.world().local())
                                      : std::vector<double>{};
    if (!session.world().root() || (fluid_values == 0 && !run_.balance())) return {};
    std::vector<double> numbers(fluid_values + given.size());
    coupler::receive_numbers(session.world(), session.clock().step(), numbers,
                             session.timeout_s());
    const std::span<const double> all(numbers);
    const auto of_fluid = all.first(fluid_values);
    row.insert(row.end(), of_fluid.begin(), of_fluid.end());
    FluidEnergy last;
    if (run_.audit) last = {*(of_fluid.end() - 2), of_fluid.back()};
    if (!run_.balance()) return last;
    const auto received = all.subspan(fluid_values);
    const auto mismatch = coupler::worst_mismatch(given, received);
    const auto impulse = coupler::impulse_of(received);
    row.insert(row.end(), {mismatch.momentum, mismatch.power});
    row.insert(row.end(), impulse.begin(), impulse.end());
    return last;
}

// Appends the values of the energy audit. Collective.
void Probes::add_audit(const NodalState& nodes, const FluidEnergy& fluid,
                       std::vector<double>& row) {
    EnergyTerms terms = collect_terms(run_);
    if (!run_.session.world().root()) return;
    if (run_.coupling) terms.fluid = fluid;
    const auto values = run_.audit->row(nodes, terms);
    row.insert(row.end(), values.begin(), values.end());
}

// Writes a row. Throws coupler::Diverged if the energy audit finds a fault. Collective;
// the values are complete on the root only, and the leading rank writes the file.
void Probes::write() {
    const double time_s = run_.session.clock().time_s();
    const NodalState nodes = run_.engine->gather(run_.atoms);
    auto loads = collect_loads(nodes);
    auto on_parts =
        run_.coupling ? run_.coupling->force_on_parts() : std::vector<bodies::Vec3>{};
    if (run_.scene.probes->mean_forces) take_means(loads, on_parts);
    std::vector<double> row;
    if (of_bodies_ && run_.steered) of_bodies_->set_field(*run_.steered);
    if (of_bodies_)
        row = of_bodies_->values(time_s, run_.with_whole_masses(nodes), loads, on_parts);
    const auto of_fluid = run_.coupling ? add_partner_values(row) : FluidEnergy{};
    if (run_.audit) add_audit(nodes, of_fluid, row);
    if (!file_) return;
    file_->row(time_s, row);
    const std::string fault = run_.audit ? run_.audit->fault() : std::string{};
    if (!fault.empty())
        throw coupler::Diverged(fmt::format("after {:.6g} s {}", time_s, fault));
}

}  // namespace

extern const StructureOutput probes_output{
    "probes", "probes", [](StructureRun& run) -> std::unique_ptr<coupler::Output> {
        if (!run.scene.probes) return nullptr;
        return std::make_unique<Probes>(run);
    }};

}  // namespace magfsi::lammps
