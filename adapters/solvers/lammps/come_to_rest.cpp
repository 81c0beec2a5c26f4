// SPDX-License-Identifier: GPL-2.0-or-later
#include "adapters/solvers/lammps/come_to_rest.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "adapters/solvers/bodies/fluid_inside.h"
#include "coupler/participants/errors.h"
#include "structure/body.h"

namespace magfsi::lammps {

namespace {

// LAMMPS steps between two checks of the forces.
constexpr int steps_between_checks = 200;
// Number of decay times of the lowest mode after which the search is given up: e^-2000 is
// far below any tolerance, but sliding and rolling on a platform may take many swings.
constexpr double patience = 2000;
// Least load that forces are compared with where the load vanishes, as in a field that
// goes through zero: this share of the largest load so far. Without any load so far it is
// the force of this shear strain on the square of the smallest extent.
constexpr double share_of_largest = 1e-3;
constexpr double strain_without_load = 1e-3;

// Smallest and largest extent of the undeformed mesh [m].
std::pair<double, double> smallest_and_largest_extent(const structure::Mesh& mesh) {
    return std::minmax(
        {bodies::extent(mesh, 0), bodies::extent(mesh, 1), bodies::extent(mesh, 2)});
}

}  // namespace

double critical_drag_rate_1_s(const std::vector<structure::Body>& bodies) {
    double lowest = std::numeric_limits<double>::infinity();
    for (const structure::Body& body : bodies) {
        const auto [thickness, length] = smallest_and_largest_extent(body.mesh);
        // The softest and the heaviest of several materials give a lower bound.
        double young = std::numeric_limits<double>::infinity();
        double density = 0;
        for (const structure::Material& m : structure::used_materials(body)) {
            young = std::min(young, m.shear_modulus_pa *
                                        (3 * m.lame_lambda_pa + 2 * m.shear_modulus_pa) /
                                        (m.lame_lambda_pa + m.shear_modulus_pa));
            density = std::max(density, m.density_kg_m3);
        }
        const double b = (body.clamps.empty() ? 4.730 : 1.875) / length;
        const double omega = b * b * thickness * std::sqrt(young / (12 * density));
        lowest = std::min(lowest, 2 * omega);
    }
    return lowest;
}

double stiffness_load_n(const std::vector<structure::Body>& bodies) {
    double smallest = std::numeric_limits<double>::infinity();
    for (const structure::Body& body : bodies) {
        const double thickness = smallest_and_largest_extent(body.mesh).first;
        for (const structure::Material& m : structure::used_materials(body)) {
            smallest = std::min(smallest, strain_without_load * m.shear_modulus_pa *
                                              thickness * thickness);
        }
    }
    return smallest;
}

void prepare_for_rest(structure::LammpsInput& input, const scene::Scene& scene) {
    if (!bodies::has_drag(scene))
        input.drag = structure::Drag{critical_drag_rate_1_s(input.bodies)};
    if (input.field) *input.field = structure::held_at(*input.field, 0);
    input.quiet = true;
    // At rest the branches have relaxed; on the way there they would only take time.
    for (structure::Body& body : input.bodies) {
        body.material.branches.clear();
        for (structure::Material& other : body.other_materials) other.branches.clear();
    }
}

RestFinder::RestFinder(Engine& engine, const scene::Scene& scene,
                       const bodies::Solids& solids, double step_s)
    : engine_(engine), scene_(scene) {
    max_steps_ = static_cast<std::int64_t>(
        patience / (0.5 * critical_drag_rate_1_s(solids)) / step_s);
    stiffness_load_n_ = stiffness_load_n(solids);
}

// Largest nodal force over the load that it is compared with. Fix quiet has as entries 1
// and 2 the largest nodal force and the largest nodal load [N].
double RestFinder::unrest() {
    const double force_n = engine_.fix_vector("quiet", 1);
    const double load_n = engine_.fix_vector("quiet", 2);
    largest_load_n_ = std::max(largest_load_n_, load_n);
    const double scale_n = std::max(load_n, share_of_largest * largest_load_n_);
    return force_n / (scale_n > 0 ? scale_n : stiffness_load_n_);
}

// Holds field and sources at their values at this time.
void RestFinder::hold_field(double time_s) {
    if (!scene_.magnetic_field->sources.empty())
        engine_.command(fmt::format("fix_modify sources held {:.17g}", time_s));
    if (!scene_.magnetic_field->uniform) return;
    const auto still = structure::held_at(*scene_.magnetic_field, time_s);
    // A fix of the same name and style takes the place of the one before.
    engine_.command(fmt::format("fix field all magttice/field {}",
                                structure::field_arguments(still)));
}

// The search starts from the positions and velocities of the point before. set_up
// computes the forces in the new field.
void RestFinder::find(double time_s) {
    if (scene_.magnetic_field) hold_field(time_s);
    engine_.set_up();
    const double tolerance = scene_.time.equilibrium->tolerance;
    double ratio = 0;
    for (std::int64_t step = 0; step < max_steps_; step += steps_between_checks) {
        engine_.take_steps(steps_between_checks);
        steps_ += steps_between_checks;
        ratio = unrest();
        if (ratio <= tolerance) return;
    }
    throw coupler::Diverged(fmt::format(
        "the bodies did not come to rest within {} steps under the loads of {:.6g} s: "
        "the largest nodal force is {:.3g} of the largest load, {:.3g} is required; "
        "take a larger time.equilibrium.tolerance or {}",
        max_steps_, time_s, ratio, tolerance,
        scene_.damping ? "another damping.rate, or leave damping out"
                       : "the key damping: {rate: ...} with a rate of your own"));
}

}  // namespace magfsi::lammps
