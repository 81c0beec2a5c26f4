// SPDX-License-Identifier: GPL-2.0-or-later
// Check for overlaps: ends a run whose bodies pass through themselves, each other, an
// obstacle or a side of the fluid's box. Markers would then move the same fluid twice,
// and the results would be meaningless. The root examines the surfaces, as often as they
// could meet.
#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "adapters/solvers/bodies/solids_around.h"
#include "adapters/solvers/lammps/structure_run.h"
#include "coupler/participants/errors.h"
#include "structure/mesh/proximity.h"

namespace magfsi::lammps {

namespace {

// Distances in grid spacings. The fluid between surfaces closer than near_cells is not
// resolved and causes a warning; nodes may sink deep_cells into a side or an obstacle
// before it counts as an overlap.
constexpr double near_cells = 0.5, deep_cells = 0.05;
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
    // The searches, on the root only.
    struct Finders {
        structure::ProximityFinder bodies;
        bodies::SolidsAround around;
    };
    void look();  // collective
    std::int64_t look_at(const NodalState& nodes);
    void tell_near(const structure::Proximities& bodies,
                   const bodies::SolidProximities& solids);
    std::string body(std::size_t number) const {
        return fmt::format("body '{}'", run_.input.bodies[number].name);
    }
    std::string pair(const std::array<std::size_t, 2>& of) const {
        return of[0] == of[1] ? "itself" : body(of[1]);
    }
    [[noreturn]] void stop(const std::string& what, const structure::Vec3& at_m,
                           bool contact_helps) const;

    StructureRun& run_;
    double spacing_m_;
    std::int64_t next_ = 0;  // step of the next check
    std::unique_ptr<Finders> finders_;
    std::set<std::string> told_;  // warnings given so far
};

Overlap::Overlap(StructureRun& run)
    : run_(run), spacing_m_(run.scene.fluid->finest_spacing_m()) {
    if (!run.session.world().root()) return;
    std::vector<const structure::Mesh*> meshes;
    for (const auto& body : run.input.bodies) meshes.push_back(&body.mesh);
    finders_ = std::make_unique<Finders>(
        Finders{structure::ProximityFinder(meshes, near_cells * spacing_m_,
                                           run.scene.fluid->period_m()),
                bodies::SolidsAround(run.scene, run.input.bodies, run.start.position_m,
                                     near_cells * spacing_m_, deep_cells * spacing_m_)});
}

// Examines the surfaces on the root and sets the step of the next check on all ranks.
void Overlap::look() {
    const NodalState nodes = run_.engine->gather(run_.atoms);
    std::int64_t steps = 1;
    if (finders_) steps = look_at(nodes);
    MPI_Bcast(&steps, 1, MPI_INT64_T, 0, run_.session.world().local());
    next_ = run_.session.clock().step() + steps;
}

// Examines the surfaces; throws coupler::Diverged on an overlap. Returns the number of
// coupled steps until the next check: surfaces that are apart cannot meet before.
std::int64_t Overlap::look_at(const NodalState& nodes) {
    const auto met = finders_->bodies.find(nodes.position_m);
    if (const auto& m = met.crossing) {
        stop(fmt::format("{} passes through {}: its element {} through element {}",
                         body(m->body[0]), pair(m->body), m->element[0] + 1,
                         m->element[1] + 1),
             m->at_m, true);
    }
    const auto around = finders_->around.find(nodes.position_m, met.apart_m);
    if (const auto& m = around.inside) {
        stop(fmt::format("{} passes into {} with its element {}", body(m->body), m->what,
                         m->element + 1),
             m->at_m, m->yields_to_contact);
    }
    tell_near(met, around);
    double fastest = 0;
    for (const structure::Vec3& v : nodes.velocity_m_s)
        fastest = std::max(fastest, norm(v));
    const double travel = std::max(growth * fastest * run_.substeps.coupled_step_s,
                                   least_cells_a_step * spacing_m_);
    // Surfaces that touch must move by half an element to pass through each other.
    const double apart =
        std::max(around.apart_m, 0.5 * finders_->bodies.shortest_edge_m());
    return std::max<std::int64_t>(1, static_cast<std::int64_t>(0.5 * apart / travel));
}

// Warns once of each pair that comes near, except pairs that the key contact holds apart.
void Overlap::tell_near(const structure::Proximities& bodies,
                        const bodies::SolidProximities& solids) {
    const auto tell = [&](const std::string& what, const structure::Vec3& at) {
        if (!told_.insert(what).second) return;
        run_.session.log(fmt::format(
            "warning: step {}: {} at ({:.4g}, {:.4g}, {:.4g}) mm; the fluid between them "
            "is not resolved: take a finer fluid.spacing where it matters",
            run_.session.clock().step(), what, at[0] * 1e3, at[1] * 1e3, at[2] * 1e3));
    };

    const bool held = run_.scene.contact.has_value();
    for (const auto& m : bodies.near)
        if (!held)
            tell(fmt::format("{} comes within half a cell of {}", body(m.body[0]),
                             pair(m.body)),
                 m.at_m);
    for (const auto& m : solids.near)
        if (!held || !m.yields_to_contact)
            tell(fmt::format("{} comes within half a cell of {}", body(m.body), m.what),
                 m.at_m);
}

void Overlap::stop(const std::string& what, const structure::Vec3& at_m,
                   bool contact_helps) const {
    const char* advice = !contact_helps ? "take another start, load or box"
                         : run_.scene.contact
                             ? "take a larger contact.stiffness, finer elements or a "
                               "smaller load"
                             : "add the key contact, which keeps them apart, or take a "
                               "smaller load";
    throw coupler::Diverged(
        fmt::format("{}, at ({:.4g}, {:.4g}, {:.4g}) mm; {}, or go on with "
                    "coupling.overlap: allow",
                    what, at_m[0] * 1e3, at_m[1] * 1e3, at_m[2] * 1e3, advice));
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
