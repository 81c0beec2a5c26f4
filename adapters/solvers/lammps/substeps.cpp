// SPDX-License-Identifier: GPL-2.0-or-later
#include "adapters/solvers/lammps/substeps.h"

#include <fmt/format.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <span>
#include <stdexcept>
#include <utility>

#include "adapters/scene/effective.h"
#include "adapters/solvers/bodies/fluid_inside.h"
#include "adapters/solvers/bodies/marker_placement.h"
#include "adapters/solvers/bodies/mesh_estimate.h"
#include "adapters/solvers/lammps/scene_to_input.h"
#include "base/fitted/constants.h"
#include "coupler/immersed_boundary/direct_forcing.h"
#include "coupler/participants/errors.h"
#include "structure/body.h"
#include "structure/lattice/lattice.h"
#include "structure/lattice/rigid_mass.h"
#include "structure/motion.h"

namespace magfsi::lammps {

namespace {

// LAMMPS steps between two checks of the stable step. Sound crosses an element in about
// one step, and deformations that change its stiffness take many crossings.
constexpr std::int64_t steps_between_checks = 100;
// Largest increase of the number of LAMMPS steps over that of the start.
constexpr int max_refinement = 16;

// Largest drag rate of a node that can move [1/s]: the sum of N_a kappa over its markers,
// divided by its mass, N_a the shape function of the node and kappa that of eq. (13).
// solids: with the densities that LAMMPS integrates (bodies_in_fluid).
double largest_drag_rate(const scene::Scene& scene, const bodies::Solids& solids,
                         double coupled_step_s) {
    double largest = 0;
    const auto& boundary = scene.coupling->immersed_boundary;
    const coupler::PenaltyScale scale{boundary.strength, scene.fluid->density_kg_m3,
                                      coupled_step_s};
    // Row sums are not known before the run; the least one that it allows is assumed.
    const double share = boundary.forcing == coupler::Forcing::no_slip
                             ? fitted::no_slip_strength / fitted::least_row_sum
                             : 1;
    for (std::size_t b = 0; b < solids.size(); ++b) {
        const auto mass = structure::build_lattice(solids[b]).node_mass_kg;
        std::vector<double> drag(mass.size());
        for (const auto& m : bodies::place_markers(scene, b, solids[b].mesh)) {
            const double kappa = share * scale.drag_coefficient_kg_s(m.volume_m3);
            for (std::size_t a = 0; a < 8; ++a) {
                drag[m.point.node[a]] += m.point.weight[a] * kappa;
            }
        }
        const auto held = structure::held_axes(solids[b]);
        const auto part = structure::rigid_part_of_nodes(solids[b]);
        for (std::size_t n = 0; n < mass.size(); ++n) {
            if (held[n] == structure::HeldAxes{true, true, true}) continue;
            if (!part.empty() && part[n] >= 0) continue;
            largest = std::max(largest, drag[n] / mass[n]);
        }
        for (std::size_t p = 0; p < solids[b].rigid_parts.size(); ++p) {
            if (structure::is_moved(solids[b].rigid_parts[p])) continue;
            largest = std::max(
                largest, structure::rate_on_part(solids[b], static_cast<int>(p), drag));
        }
    }
    return largest;
}

// Largest rate at which a prescribed motion turns within the run [rad/s], by samples.
double largest_rate_rad_s(const structure::RigidCourse& moved, double end_s) {
    if (!moved.turning) return 0;
    constexpr int samples = 1000;
    double largest = 0;
    for (int i = 0; i <= samples; ++i)
        largest = std::max(
            largest,
            norm(structure::turn_rate_rad_s(*moved.turning, end_s * i / samples).vector));
    return largest;
}

// Step [s] that resolves the swings of rigid parts in the uniform field and under gravity
// and their turns at the start; infinite where nothing makes them turn. The forces of
// soft elements on them are the lattice's matter.
double rigid_step_s(const scene::Scene& scene, const structure::LammpsInput& input) {
    // The free rotation is integrated to fourth order and takes larger angles.
    constexpr double of_free_turns = 0.2;
    if (!scene::has_effect(scene, "rigid parts"))
        return std::numeric_limits<double>::infinity();
    const double field_t =
        scene.magnetic_field ? norm(bodies::strongest_field_t(scene)) : 0;
    const double gravity_m_s2 = input.gravity_m_s2 ? norm(*input.gravity_m_s2) : 0;
    double fastest = 0;  // square of a rate [1/s2]
    for (std::size_t b = 0; b < input.bodies.size(); ++b) {
        const structure::Body& body = input.bodies[b];
        for (std::size_t p = 0; p < body.rigid_parts.size(); ++p) {
            const int part = static_cast<int>(p);
            if (structure::is_moved(body.rigid_parts[p])) {
                const double rate =
                    of_free_turns * largest_rate_rad_s(std::get<structure::RigidCourse>(
                                                           *body.rigid_parts[p].hold),
                                                       scene.time.end_s);
                fastest = std::max(fastest, rate * rate);
                continue;
            }
            const auto mass = structure::rigid_mass(body, part, body.mesh.nodes);
            const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> axes(
                mass.inertia_kg_m2, Eigen::EigenvaluesOnly);
            const double least = axes.eigenvalues()[0];
            double squared =
                norm(structure::moment_of_part_a_m2(body, part)) * field_t / least;
            // A pendulum of the length d has M g d / (I + M d^2), at most that of the
            // length sqrt(I / M).
            if (body.rigid_parts[p].hold)
                squared += 0.5 * gravity_m_s2 * std::sqrt(mass.mass_kg / least);
            if (!input.placements.empty() && input.placements[b].angular_velocity_rad_s) {
                const double rate =
                    of_free_turns * norm(*input.placements[b].angular_velocity_rad_s);
                squared += rate * rate;
            }
            fastest = std::max(fastest, squared);
        }
    }
    return fitted::rigid_turn_of_a_step / std::sqrt(fastest);
}

// The largest step up to the limit that divides the time between probe rows, or the run.
double even_step_s(const scene::Scene& scene, double limit_s) {
    const double interval_s = scene.probes ? scene.probes->every_s : scene.time.end_s;
    return interval_s / std::max(1.0, std::ceil(interval_s / limit_s - 1e-9));
}

}  // namespace

Substeps choose_substeps(const scene::Scene& scene, const structure::LammpsInput& input) {
    Substeps s;
    s.elastic_limit_s = stable_step_s(input);
    if (scene.time.equilibrium) {
        s.count = 0;
        s.coupled_step_s = scene::path_step_s(scene);
        s.lammps_step_s = std::isinf(s.elastic_limit_s)
                              ? s.coupled_step_s
                              : fitted::elastic_margin * s.elastic_limit_s;
        return s;
    }
    const auto wanted = scene::coupled_step_s(scene);
    double limit =
        std::min(fitted::elastic_margin * s.elastic_limit_s, rigid_step_s(scene, input));
    s.coupled_step_s = wanted ? *wanted : scene::halved(scene, even_step_s(scene, limit));
    if (scene.fluid && scene.coupling) {
        s.drag_limit_s = 2 / largest_drag_rate(scene, input.bodies, s.coupled_step_s);
        limit = std::min(limit, fitted::drag_margin * s.drag_limit_s);
    }
    s.count = std::max<int>(1, std::ceil(s.coupled_step_s / limit - 1e-9));
    if (scene.coupling && scene.coupling->substeps) {
        const int asked = *scene.coupling->substeps;
        const double step = s.coupled_step_s / asked;
        if (step > s.elastic_limit_s || (s.drag_limit_s > 0 && step > s.drag_limit_s)) {
            throw std::invalid_argument(
                fmt::format("coupling.substeps: {} makes a structure step of {:.3g} us; "
                            "the lattice is stable up to {:.3g} us and the immersed "
                            "boundary up to {:.3g} us; "
                            "use {} or more",
                            asked, step * 1e6, s.elastic_limit_s * 1e6,
                            s.drag_limit_s * 1e6, s.count));
        }
        s.count = asked;
    }
    s.lammps_step_s = s.coupled_step_s / s.count;
    return s;
}

Substeps choose_substeps(const scene::Scene& scene, const bodies::Solids& solids) {
    static std::map<std::pair<std::uint64_t, int>, Substeps> known;
    const std::pair key(scene.hash, scene.time.halvings);
    const auto found = known.find(key);
    if (found != known.end()) return found->second;
    return known[key] = choose_substeps(scene, to_lammps_input(scene, solids));
}

std::string advice_if_unstable(const scene::Scene& scene) {
    const char* step = scene.time.equilibrium ? ""
                       : scene.fluid          ? "more coupling.substeps, "
                                              : "a smaller time.step, ";
    return fmt::format("take {}a finer mesh or weaker loads", step);
}

StepGuard::StepGuard(const std::vector<structure::Body>& bodies, const Substeps& substeps,
                     MPI_Comm comm)
    : comm_(comm),
      start_(substeps),
      every_(std::max<std::int64_t>(1, steps_between_checks / substeps.count)) {
    int rank = 0;
    MPI_Comm_rank(comm, &rank);
    std::size_t first = 0;
    for (const structure::Body& body : bodies) {
        first_node_.push_back(first);
        first += body.mesh.nodes.size();
        names_.push_back(body.name);
        if (rank == 0) elements_.emplace_back(body);
    }
    first_node_.push_back(first);
}

// The root computes the rise of the elements' stiffness and sends it to all ranks, which
// come to the same decision.
StepGuard::Result StepGuard::check(const bodies::NodalState& state,
                                   const Substeps& now) const {
    struct {
        double rise = 0;
        double body = 0;
    } worst;
    const std::span<const bodies::Vec3> nodes(state.position_m);
    for (std::size_t b = 0; b < elements_.size(); ++b) {
        const std::size_t first = first_node_[b];
        const double rise =
            elements_[b].rise_1_s2(nodes.subspan(first, first_node_[b + 1] - first));
        if (rise > worst.rise) worst = {rise, static_cast<double>(b)};
    }
    MPI_Bcast(&worst, 2, MPI_DOUBLE, 0, comm_);
    const double rise = worst.rise;
    Result result;
    // An inverted element ends the run in LAMMPS, which names it.
    if (!std::isfinite(rise)) return result;
    result.limit_s = structure::CurrentStep::step_s(start_.elastic_limit_s, rise);
    // A step that the scene prescribes may exceed the allowed part from the start.
    const double part =
        std::max(fitted::allowed_part, start_.lammps_step_s / start_.elastic_limit_s);
    if (rise == 0 || now.lammps_step_s <= part * result.limit_s) return result;
    result.factor = static_cast<int>(
        std::ceil(now.lammps_step_s / (fitted::chosen_part * result.limit_s)));
    if (now.count * result.factor <= max_refinement * start_.count) return result;
    throw coupler::Diverged(fmt::format(
        "body '{}' is so deformed that the stable step has fallen from {:.3g} to {:.3g} "
        "us, which needs more than {} times the steps; take a finer mesh or weaker loads",
        names_[worst.body], start_.elastic_limit_s * 1e6, result.limit_s * 1e6,
        max_refinement));
}

}  // namespace magfsi::lammps
