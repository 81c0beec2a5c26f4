// SPDX-License-Identifier: GPL-2.0-or-later
// What a scene comes to: its values in SI, its hash, its effects and its step.
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

// The key that a law of the field stands under: "rotation".
std::string law_key(const FieldLaw& law);

// 64-bit FNV-1a of effective_scene with sorted keys: comments, the order of keys and the
// spelling of units do not matter. scene.hash itself is not looked at.
std::uint64_t scene_hash(const Scene& scene);

// The same whatever time.end is: scenes with equal ones go through the same states, so
// that one may go on from a checkpoint of the other.
std::uint64_t state_hash(const Scene& scene);

// Distance of the points on the path of equilibria [s]: that of the probe rows, or the
// whole path.
double path_step_s(const Scene& scene);

// A step [s] of the scene as it is after scene.time.halvings; exact.
double halved(const Scene& scene, double step_s);

// Coupled step [s]: time.step, or lattice_speed (courant for openfoam) times
// spacing at the bodies / expected_speed, halved as the scene says. Empty without a fluid
// and time.step, where the bodies' own stable step rules.
std::optional<double> coupled_step_s(const Scene& scene);

// The fluid's on its lattice: 3 nu dt / dx^2 + 1/2; empty without such a fluid. Below the
// least the viscosity is lost in the scheme's own error. In a refined grid it is the
// least, that away from the bodies; tau - 1/2 doubles with each level.
constexpr double min_relaxation_time = 0.5001;
std::optional<double> relaxation_time(const Scene& scene);
std::optional<double> relaxation_time_at_bodies(const Scene& scene);

// How a refined grid follows the bodies: looks where they are before every so many
// coupled steps, in which no marker moves further than a number of its finest cells. The
// least margin, in cells of the finest level but one, leaves room for that, the kernel,
// and a cell of the level below between the last force and the patch's side.
struct Following {
    int every = 4, moves_cells = 2;
};
Following following(const Fluid& fluid);
int least_margin_cells(const Scene& scene);

// Empty, or why a retry cannot halve the steps once more.
std::string fault_of_half_step(const Scene& scene);

// Names of the effects in the order in which a step evaluates them.
std::vector<std::string> active_effects(const Scene& scene);
std::vector<std::string> absent_effects(const Scene& scene);

bool has_effect(const Scene& scene, std::string_view name);

// The same, a line for each of the structure step, the coupled step, the fluid step and
// the outputs: "fluid step: fluid, obstacles; absent: body force, ...".
std::vector<std::string> effects_by_step(const Scene& scene);

// A line for each effect that is in the scene and can do nothing there, such as a damping
// of rate 0: which, why, and what to do. Warnings, for nothing is wrong with the result.
std::vector<std::string> idle_effects(const Scene& scene);

// A line for each interval of probes, outputs and checkpoints that becomes another,
// because they come after whole steps: those of a refined grid's coarsest level, which
// are long.
std::vector<std::string> rounded_intervals(const Scene& scene);

// Meshes, tables and surfaces that lie outside of the scene's folder, with their full
// paths: the scene may come from a stranger.
std::vector<std::filesystem::path> files_elsewhere(const Scene& scene);

}  // namespace magfsi::scene
