// SPDX-License-Identifier: GPL-2.0-or-later
#include "adapters/solvers/lammps/energy_audit.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <numeric>

#include "adapters/scene/effective.h"
#include "adapters/solvers/bodies/fluid_inside.h"
#include "adapters/solvers/lammps/structure_run.h"
#include "base/fitted/constants.h"
#include "structure/lammps/names.h"

namespace magfsi::lammps {

namespace {

// True if sides of the box or a body force may give energy to the fluid.
bool is_driven(const scene::Fluid& fluid) {
    using enum fluid::BoundaryKind;
    return fluid.body_force_n_m3.has_value() ||
           std::ranges::any_of(fluid.boundaries, [](const fluid::Boundary& side) {
               return side.kind == velocity_inlet || side.kind == pressure_outlet ||
                      side.wall_velocity_m_s != scene::Vec3{};
           });
}

// Gain of energy that is no fault, over the fluid's energy at the start: the part that
// sound may return, the square of the Mach number at a lattice speed of 0.05.
constexpr double max_share_of_fluid = 0.01;

// Gains below the elastic energy of this strain, G V strain^2, are not judged: they may
// be the rounding of a body at rest, or belong to a motion that has hardly begun.
constexpr double min_strain = 1e-6;
// The same of rigid bodies, which have no strain: the energy of this share of the speed
// that the scene expects in its fluid. A body of the fluid's density that rests in it is
// moved a little by the lag of the fluid inside in its first step.
constexpr double min_share_of_speed = 1e-3;

double min_energy(const scene::Scene& scene, const std::vector<double>& masses_kg) {
    double softest = std::numeric_limits<double>::infinity();  // G / density [m2/s2]
    for (const scene::Body& body : scene.bodies) {
        const structure::Material& m = body.material;
        if (m.shear_modulus_pa > 0)
            softest = std::min(softest, m.shear_modulus_pa / m.density_kg_m3);
    }
    const double mass_kg = std::accumulate(masses_kg.begin(), masses_kg.end(), 0.0);
    if (!std::isinf(softest)) return min_strain * min_strain * softest * mass_kg;
    if (!scene.fluid) return 0;
    const double speed_m_s = min_share_of_speed * scene.fluid->expected_speed_m_s;
    return 0.5 * speed_m_s * speed_m_s * mass_kg;
}

double lost(const EnergyTerms& terms) {
    return terms.lost_viscosity + terms.lost_drag + terms.lost_friction;
}

}  // namespace

void attach_audit(const StructureRun& run) {
    std::vector<std::string> moved;
    for (std::size_t m = 0; m < run.input.motions.size(); ++m)
        moved.push_back(structure::moved_group(m));
    if (structure::has_moved_parts(run.input.bodies))
        moved.emplace_back(structure::moved_parts_group);
    run.engine->attach_audit(run.input.drag ? run.input.drag->rate_1_s : 0, moved);
}

// The numbers in fix_vector and compute_vector are those of the fixes' own documentation:
// fix magttice has the elastic energy, the field's work and the viscous loss as 1, 3, 5.
EnergyTerms collect_terms(const StructureRun& run) {
    const Engine& engine = *run.engine;
    EnergyTerms terms;
    for (const std::string& fix : run.fix_ids) {
        terms.elastic += engine.fix_vector(fix, 1);
        terms.work_field += engine.fix_vector(fix, 3);
        terms.lost_viscosity += engine.fix_vector(fix, 5);
    }
    terms.of_moved = engine.fix_vector("audit", 1);
    terms.lost_drag = engine.fix_vector("audit", 2);
    if (run.scene.platform) {
        terms.platform = engine.fix_scalar("platform");
        terms.lost_friction = engine.fix_vector("platform", 8);
    }
    if (run.scene.contact) terms.contact = engine.compute_scalar("contact");
    if (run.scene.dipoles) terms.dipoles = engine.fix_scalar("dipoles");
    const bool rubs = run.scene.contact && run.scene.contact->friction > 0;
    if (rubs) terms.lost_friction += engine.compute_vector("contact", 4);
    for (const structure::Wall& wall : run.input.walls) {
        terms.contact += engine.fix_scalar("wall_" + wall.name);
        if (rubs)
            terms.lost_friction +=
                engine.fix_vector("wall_" + wall.name, wall.shape ? 1 : 8);
    }
    const auto* markers = run.coupling ? run.coupling->work() : nullptr;
    if (!markers) return terms;
    std::array<double, 3> works{markers->by_fluid_j(), markers->by_enclosed_j(),
                                markers->for_nothing_j()};
    MPI_Allreduce(MPI_IN_PLACE, works.data(), works.size(), MPI_DOUBLE, MPI_SUM,
                  run.session.world().local());
    terms.by_fluid = works[0];
    terms.by_enclosed = works[1];
    terms.for_nothing = works[2];
    return terms;
}

EnergyAudit::EnergyAudit(const scene::Scene& scene, const bodies::Solids& solids,
                         NodalState start)
    : scene_(scene),
      start_(std::move(start)),
      whole_kg_(start_.mass_kg),
      inside_kg_(start_.mass_kg.size()),
      whole_(start_.position_m.empty()
                 ? bodies::RigidKinetics{}
                 : bodies::RigidKinetics{solids, start_.position_m}),
      nodes_(whole_),
      gravity_m_s2_(bodies::to_gravity(scene).value_or(bodies::Vec3{})) {
    if (scene.fluid) {
        driven_ = is_driven(*scene.fluid);
        whole_kg_ = bodies::whole_masses_kg(solids);
        inside_kg_ = bodies::inside_masses_kg(scene, solids);
        if (!start_.position_m.empty()) {
            inside_ = {bodies::bodies_of_fluid(scene, solids), start_.position_m};
            nodes_ = {bodies::bodies_in_fluid(scene, solids), start_.position_m};
        }
    }
    min_j_ = min_energy(scene, whole_kg_);
}

// Kinetic energies of the nodes, and works of the weight from the displacements since
// step 0. `once` is the mass that is not yet counted as fluid on the grid.
EnergyAudit::Motion EnergyAudit::motion_of(const NodalState& state) const {
    Motion m;
    for (std::size_t i = 0; i < state.mass_kg.size(); ++i) {
        const Vec3& v = state.velocity_m_s[i];
        const double half_square = 0.5 * dot(v, v);
        const double once = whole_kg_[i] - inside_kg_[i];
        m.kinetic_whole += whole_kg_[i] * half_square;
        m.kinetic += once * half_square;
        m.kinetic_nodes += state.mass_kg[i] * half_square;
        const double fallen =
            dot(gravity_m_s2_, state.position_m[i] - start_.position_m[i]);
        m.work_weight += once * fallen;
        m.work_weight_nodes += state.mass_kg[i] * fallen;
    }
    const double whole = whole_.beyond_nodes_j(state.rigid);
    m.kinetic_whole += whole;
    m.kinetic += whole - inside_.beyond_nodes_j(state.rigid);
    m.kinetic_nodes += nodes_.beyond_nodes_j(state.rigid);
    return m;
}

double EnergyAudit::stored(const EnergyTerms& terms) const {
    return terms.elastic + terms.platform + terms.contact + terms.dipoles;
}

// The columns with the equations of docs/energy_audit.md. The residual takes the masses
// that LAMMPS integrates, with which it is the error of the time integration alone.
std::vector<EnergyAudit::Column> EnergyAudit::balance(const Motion& m,
                                                      const EnergyTerms& terms) const {
    std::vector<Column> all;
    const auto add = [&](bool there, const char* name, double value) {
        if (there) all.push_back({std::string("audit.") + name + "[J]", value});
    };
    const double motion = terms.of_moved - record_.moved_at_start;
    // Work of the enclosed fluid's force beyond that of removing its inertia and weight.
    const double lag = terms.by_enclosed - (m.kinetic_nodes - m.kinetic) +
                       (m.work_weight_nodes - m.work_weight);
    const double residual = stored(terms) + m.kinetic_nodes - record_.stored_at_start -
                            record_.nodes_at_start - terms.work_field -
                            m.work_weight_nodes - motion - terms.by_fluid -
                            terms.by_enclosed + lost(terms);
    const bool in_fluid = scene_.fluid.has_value();
    const bool no_slip = scene_.coupling && scene_.coupling->immersed_boundary.forcing ==
                                                coupler::Forcing::no_slip;
    const auto effect = [&](const char* name) { return scene::has_effect(scene_, name); };
    add(effect("magnetic field"), "work_field", terms.work_field);
    add(effect("gravity"), "work_weight", m.work_weight);
    add(effect("prescribed motion"), "work_motion", motion);
    add(true, "elastic", terms.elastic);
    add(true, "kinetic_whole", m.kinetic_whole);
    add(in_fluid, "kinetic", m.kinetic);
    add(effect("platform"), "platform", terms.platform);
    add(effect("contact"), "contact", terms.contact);
    add(effect("dipoles"), "dipoles", terms.dipoles);
    add(effect("viscosity") || effect("viscoelasticity"), "lost_viscosity",
        terms.lost_viscosity);
    add(effect("damping"), "lost_drag", terms.lost_drag);
    add(effect("friction"), "lost_friction", terms.lost_friction);
    add(in_fluid, "given_to_fluid", -terms.by_fluid);
    add(in_fluid, "enclosed_lag", lag);
    add(no_slip, "work_layer", terms.for_nothing);
    add(in_fluid, "lost_in_fluid",
        -terms.by_fluid + terms.for_nothing -
            (terms.fluid.sum() - record_.fluid_at_start));
    add(true, "residual", residual);
    return all;
}

std::vector<std::string> EnergyAudit::columns() const {
    std::vector<std::string> names;
    for (Column& column : balance({}, {})) names.push_back(std::move(column.name));
    return names;
}

// The first row fixes the energies of the start, so that a scene may begin with stored
// energy.
std::vector<double> EnergyAudit::row(const NodalState& state, const EnergyTerms& terms) {
    const Motion motion = motion_of(state);
    if (record_.rows == 0) {
        record_.stored_at_start = stored(terms);
        record_.moved_at_start = terms.of_moved;
        record_.dipoles_at_start = terms.dipoles;
        record_.nodes_at_start = motion.kinetic_nodes;
        record_.fluid_at_start = terms.fluid.sum();
    }
    std::vector<double> values;
    for (const Column& column : balance(motion, terms)) values.push_back(column.value);
    note(motion, terms, values.back());
    return values;
}

// Updates the record. `unpaid` is the energy of bodies and fluid and all losses, less all
// works: constant up to errors of the integration and losses in the fluid, which lower
// it.
void EnergyAudit::note(const Motion& m, const EnergyTerms& terms, double residual) {
    const double moved = terms.of_moved - record_.moved_at_start;
    for (const double part :
         {terms.work_field, m.work_weight, moved, terms.by_fluid,
          terms.dipoles - record_.dipoles_at_start,
          record_.stored_at_start - record_.dipoles_at_start + record_.nodes_at_start})
        record_.work = std::max(record_.work, std::abs(part));
    record_.residual = std::max(record_.residual, std::abs(residual));
    const double unpaid = stored(terms) + m.kinetic + terms.fluid.sum() + lost(terms) -
                          terms.work_field - m.work_weight - moved - terms.for_nothing;
    if (record_.rows == 0) record_.unpaid_at_start = unpaid;
    record_.unpaid = unpaid;
    lags_ = terms.by_enclosed != 0;
    record_.for_nothing = terms.for_nothing;
    record_.most_for_nothing =
        std::max(record_.most_for_nothing, std::abs(terms.for_nothing));
    record_.lowest = record_.rows == 0 ? unpaid : std::min(record_.lowest, unpaid);
    record_.gained = std::max(record_.gained, unpaid - record_.lowest);
    ++record_.rows;
}

// Two gains are judged. One is that since the start, with the work of the layers
// (for_nothing) counted as a gain, for it must not feed a run. The other is that since
// the lowest sum so far, less the largest work of the layers, which may hide in it; the
// sum contains the energy of sound, which therefore cannot raise it. Light bodies, whose
// enclosed fluid lags, are not judged by the latter.
std::string EnergyAudit::fault() const {
    double gained = record_.unpaid - record_.unpaid_at_start + record_.for_nothing;
    if (!lags_)
        gained =
            std::max(gained, record_.unpaid - record_.lowest - record_.most_for_nothing);
    const double allowed = fitted::max_gain_of_work * record_.work +
                           max_share_of_fluid * record_.fluid_at_start + min_j_;
    if (driven_ || record_.rows < 2 || gained <= allowed) return {};
    return fmt::format(
        "the run has gained energy without a source: {:.3g} J more than the energy of "
        "the start, or of a later time, and all works, of which the largest is {:.3g} J; "
        "{}",
        gained, record_.work, advice());
}

// The advice for this scene: only what its keys allow.
std::string EnergyAudit::advice() const {
    std::string text = "take a smaller time.step";
    if (!scene_.coupling) return text;
    text += ", more coupling.substeps";
    if (scene_.fluid->solver == scene::FluidSolver::lbm &&
        scene_.fluid->collision != fluid::Collision::automatic)
        text += ", collision: automatic";
    if (scene_.coupling->immersed_boundary.strength > 1)
        text += ", a coupling.immersed_boundary.strength of at most 1";
    return text;
}

output::EnergySummary EnergyAudit::summary() const {
    output::EnergySummary summary;
    summary.work_j = record_.work;
    summary.residual_j = record_.residual;
    if (!driven_) summary.gained_j = record_.gained;
    if (record_.most_for_nothing > 0) summary.layer_j = record_.most_for_nothing;
    return summary;
}

// The record as a plain array, and back: it consists of doubles only.
std::vector<double> EnergyAudit::carried() const {
    const auto values =
        std::bit_cast<std::array<double, sizeof(Record) / sizeof(double)>>(record_);
    return {values.begin(), values.end()};
}

void EnergyAudit::set(std::span<const double> carried) {
    std::array<double, sizeof(Record) / sizeof(double)> values{};
    std::ranges::copy(carried.first(values.size()), values.begin());
    record_ = std::bit_cast<Record>(values);
}

}  // namespace magfsi::lammps
