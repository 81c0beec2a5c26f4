// SPDX-License-Identifier: GPL-2.0-or-later
// Check for overlaps: ends a run whose bodies pass through themselves, each other, an
// obstacle or a side of the fluid's box. Markers would then move the same fluid twice,
// and the results would be meaningless. The root examines the surfaces, as often as they
// could meet.
#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "adapters/solvers/bodies/overlaps.h"
#include "adapters/solvers/lammps/structure_run.h"
#include "coupler/participants/errors.h"

namespace magfsi::lammps {

namespace {

// Speed of the surfaces that is assumed until the next check: `growth` times the present
// largest, but at least so many cells in a coupled step, about the speed for which steps
// are chosen.
constexpr double growth = 2, least_cells_a_step = 0.05;

class Overlap : public coupler::Output {
  public:
    explicit Overlap(StructureRun& run);
    void begin() override { look(); }
    void end_step() override {
        const coupler::Clock& clock = run_.session.clock();
        if (clock.step() >= next_ || clock.done()) look();
    }

  private:
    void look();  // collective
    std::int64_t look_at(const NodalState& nodes);
    void tell_near(const bodies::Overlaps::Found& found);

    StructureRun& run_;
    double spacing_m_;
    std::int64_t next_ = 0;                     // step of the next check
    std::unique_ptr<bodies::Overlaps> finder_;  // on the root only
    std::set<std::string> told_;                // warnings given so far
};

Overlap::Overlap(StructureRun& run)
    : run_(run), spacing_m_(run.scene.fluid->finest_spacing_m()) {
    if (!run.session.world().root()) return;
    finder_ = std::make_unique<bodies::Overlaps>(run.scene, run.input.bodies,
                                                 run.start.position_m);
}

// Examines the surfaces on the root and sets the step of the next check on all ranks.
void Overlap::look() {
    const NodalState nodes = run_.engine->gather(run_.atoms);
    std::int64_t steps = 1;
    if (finder_) steps = look_at(nodes);
    MPI_Bcast(&steps, 1, MPI_INT64_T, 0, run_.session.world().local());
    next_ = run_.session.clock().step() + steps;
}

// Examines the surfaces; throws coupler::Diverged on an overlap. Returns the number of
// coupled steps until the next check: surfaces that are apart cannot meet before.
std::int64_t Overlap::look_at(const NodalState& nodes) {
    const auto found = finder_->find(nodes.position_m);
    if (!found.overlap.empty()) throw coupler::Diverged(found.overlap);
    tell_near(found);
    double fastest = 0;
    for (const structure::Vec3& v : nodes.velocity_m_s)
        fastest = std::max(fastest, norm(v));
    const double travel = std::max(growth * fastest * run_.substeps.coupled_step_s,
                                   least_cells_a_step * spacing_m_);
    return std::max<std::int64_t>(
        1, static_cast<std::int64_t>(0.5 * found.apart_m / travel));
}

// Warns once of each pair that comes near, except pairs that the key contact holds apart.
void Overlap::tell_near(const bodies::Overlaps::Found& found) {
    const auto tell = [&](const std::string& what, const structure::Vec3& at) {
        if (!told_.insert(what).second) return;
        run_.session.log(fmt::format(
            "warning: step {}: {} at ({:.4g}, {:.4g}, {:.4g}) mm; the fluid between them "
            "is not resolved: take a finer fluid.spacing where it matters",
            run_.session.clock().step(), what, at[0] * 1e3, at[1] * 1e3, at[2] * 1e3));
    };

    const bool held = run_.scene.contact.has_value();
    for (const auto& m : found.bodies.near)
        if (!held)
            tell(fmt::format("{} comes within half a cell of {}",
                             finder_->body(m.body[0]), finder_->second(m.body)),
                 m.at_m);
    for (const auto& m : found.solids.near)
        if (!held || !m.yields_to_contact)
            tell(fmt::format("{} comes within half a cell of {}", finder_->body(m.body),
                             m.what),
                 m.at_m);
}

}  // namespace

extern const StructureOutput overlap_output{
    "overlap", "look for overlaps",
    [](StructureRun& run) -> std::unique_ptr<coupler::Output> {
        const auto& coupling = run.scene.coupling;
        if (!coupling || coupling->overlap == coupler::OverlapRule::allow) return nullptr;
        return std::make_unique<Overlap>(run);
    }};

}  // namespace magfsi::lammps
