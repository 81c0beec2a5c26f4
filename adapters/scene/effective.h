// SPDX-License-Identifier: GPL-2.0-or-later
// Quantities derived from a scene: its values in SI, its hash, its effects, and its
// coupled step.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "adapters/scene/scene.h"

namespace magfsi::scene {

// All values in SI (angles in rad) under the keys of the scene file, defaults included.
nlohmann::ordered_json effective_scene(const Scene& scene);

// Key of a law of the magnetic field, such as "rotation".
std::string law_key(const FieldLaw& law);

// 64-bit FNV-1a hash of effective_scene with sorted keys. Comments, the order of keys and
// the spelling of units do not change it, nor does scene.hash.
std::uint64_t scene_hash(const Scene& scene);

// Hash without what changes no state of the run: time.end, report, timeouts, the overlap
// check and the reaction to a divergence. Files count by their content, wherever they
// lie; a script by its name. Scenes with equal state hashes go through the
// same states, so that a run may continue from a checkpoint of another.
std::uint64_t state_hash(const Scene& scene);

// Interval between points on the path of equilibria [s]: that of the probe rows, or the
// whole path without probes.
double path_step_s(const Scene& scene);

// The step [s] after scene.time.halvings halvings. Exact, for it scales by a power of
// two.
double halved(const Scene& scene, double step_s);

// Coupled step [s]: time.step, or lattice_speed (openfoam: courant) times the spacing at
// the bodies over expected_speed; then halved scene.time.halvings times. Empty without
// fluid and time.step, where the stable step of the bodies decides.
std::optional<double> coupled_step_s(const Scene& scene);

// Relaxation time of the lattice, 3 nu dt / dx^2 + 1/2 in SI values; empty without a
// lattice Boltzmann fluid. Below min_relaxation_time the viscosity is lost in the
// scheme's own error. In a refined grid the first function gives the smallest value, that
// of the coarsest level; tau - 1/2 doubles with each level.
constexpr double min_relaxation_time = 0.5001;
std::optional<double> relaxation_time(const Scene& scene);
std::optional<double> relaxation_time_at_bodies(const Scene& scene);

// Rule by which a refined grid follows the bodies. Their places are checked every `every`
// coupled steps; in between no marker may move further than `moves_cells` of its finest
// cells. The least margin, in cells of the finest level but one, leaves room for that
// motion, the kernel, and a cell of the level below between the last force and the
// patch's side.
struct Following {
    int every = 4, moves_cells = 2;
};
// The fluid must have a refinement.
Following following(const Fluid& fluid);
int least_margin_cells(const Scene& scene);

// Returns why a retry cannot halve the steps once more, or "".
std::string fault_of_half_step(const Scene& scene);

// Names of the effects that the scene has, in the order in which a step evaluates them,
// and of those that it lacks.
std::vector<std::string> active_effects(const Scene& scene);
std::vector<std::string> absent_effects(const Scene& scene);

// The density of the lightest material of a body over that of the fluid.
double lightest_ratio(const Scene& scene, const Body& body);
// The first body in a scene with contact whose lightest_ratio is below
// fitted::least_serial_contact_ratio, else null.
const Body* light_in_contact(const Scene& scene);

// True with forcing no_slip in OpenFOAM, whose pressure answers a force within the step:
// the step has to be repeated until the force is found.
bool holds_openfoam(const Scene& scene);

// True if the scene has the effect. Throws std::logic_error unless `name` is one of the
// names above.
bool has_effect(const Scene& scene, std::string_view name);

// The effects in one line each for the structure step, the coupled step, the fluid step
// and the outputs: "fluid step: fluid, obstacles; absent: body force, ...".
std::vector<std::string> effects_by_step(const Scene& scene);

// One line for each effect of the scene that has no influence, such as a damping of rate
// 0: which, why, and what to do. These are warnings, for the result is right.
std::vector<std::string> idle_effects(const Scene& scene);

// One line for each interval of probes, outputs and checkpoints that is rounded to whole
// steps of the coarsest level of a refined grid, at which outputs are made.
std::vector<std::string> rounded_intervals(const Scene& scene);

// Files that the scene names, as full paths with links resolved, each once; and those of
// them outside of its own folder: a scene may come from a stranger, so explain lists
// them.
std::vector<std::filesystem::path> files_of(const Scene& scene);
std::vector<std::filesystem::path> files_elsewhere(const Scene& scene);

}  // namespace magfsi::scene
