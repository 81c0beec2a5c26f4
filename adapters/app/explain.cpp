// SPDX-License-Identifier: GPL-2.0-or-later
// Text of `magfsi explain` in order: effects, warnings, bodies, control, fluid, coupling,
// files.
#include "adapters/app/explain.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <sstream>
#include <utility>

#include "adapters/app/cost.h"
#include "adapters/app/explain_bodies.h"
#include "adapters/app/explain_files.h"
#include "adapters/app/run_checks.h"
#include "adapters/scene/checks.h"
#include "adapters/scene/effective.h"
#include "adapters/scene/scene.h"
#include "adapters/solvers/bodies/probe_row.h"
#include "adapters/solvers/fluids/fluid_probes.h"
#include "adapters/solvers/lammps/substeps.h"
#include "base/fitted/constants.h"

namespace magfsi::launch {

namespace {

// Refuses a control.probes entry that names no column of probes.csv. The columns of the
// energy audit ("audit.") are known only to the run and are passed here.
void check_columns(const scene::Scene& scene, const bodies::Solids& solids) {
    bodies::NodalState start;
    for (const structure::Body& solid : solids) {
        start.position_m.insert(start.position_m.end(), solid.mesh.nodes.begin(),
                                solid.mesh.nodes.end());
    }
    std::vector<std::string> columns = bodies::ProbeRow(scene, solids, start).columns();
    for (const auto& more :
         {fluids::fluid_columns(scene), fluids::interface_columns(scene)})
        columns.insert(columns.end(), more.begin(), more.end());
    const bool audited = scene.probes && scene.probes->energy_audit;
    for (std::size_t i = 0; i < scene.control->probes.size(); ++i) {
        if (!audited || !scene.control->probes[i].starts_with("audit."))
            (void)bodies::column_of(columns, *scene.control, i);
    }
}

// The script's rights are named, since a scene may come from a stranger.
std::string explain_control(const scene::Scene& scene, const bodies::Solids& solids) {
    check_columns(scene, solids);
    const scene::Control& control = *scene.control;
    check_controller(control);
    return fmt::format(
        "\ncontrol\n  {}, a program that runs with your rights, sets the field every "
        "{:.4g} ms{}{}\n",
        control.script, control.every_s * 1e3, control.probes.empty() ? "" : "; it sees ",
        fmt::join(control.probes, ", "));
}

// Smallest and largest density of the bodies over the fluid's.
// Bodies with regions count by their regions' densities.
std::pair<double, double> density_ratios(const scene::Scene& scene) {
    std::vector<double> ratios;
    for (const scene::Body& body : scene.bodies) {
        if (body.material_regions.empty())
            ratios.push_back(body.material.density_kg_m3 / scene.fluid->density_kg_m3);
        for (const auto& entry : body.material_regions)
            ratios.push_back(entry.material.density_kg_m3 / scene.fluid->density_kg_m3);
    }
    const auto [low, high] = std::ranges::minmax(ratios);
    return {low, high};
}

// Order of work of structure and fluid under the coupling scheme, in words.
std::string in_words(const coupler::Coupling& coupling) {
    const auto velocity = scene::name_of(*coupling.sampled_velocity);
    if (coupling.scheme == coupler::Scheme::serial)
        return fmt::format(
            "structure and fluid take turns; the fluid's velocity is {} over the "
            "substeps",
            velocity);
    const coupler::Iteration& i = *coupling.iteration;
    return fmt::format(
        "each step is repeated, by {}, until the fluid velocity at the markers stays "
        "within {:.2g} of itself, at most {} times; it is {} over the substeps",
        scene::name_of(i.acceleration), i.velocity_tolerance, i.max_iterations, velocity);
}

// Cost of a coupled step under the scheme, in words.
std::string cost(const coupler::Coupling& coupling) {
    if (coupling.scheme == coupler::Scheme::serial)
        return "one step of each side after the other";
    return "the structure's step once per iteration (2 to 4 with iqn_ils); the fluid's "
           "step once and the rows that bodies touch again, or, with openings, moving "
           "walls or obstacles, the whole fluid and a copy of it each time";
}

// Scheme recommended for the smallest density ratio of body to fluid, with the reason.
std::string recommended(const scene::Scene& scene, double min_ratio) {
    if (min_ratio < fitted::min_serial_ratio) {
        return fmt::format(
            "implicit: below a density ratio of {:.2g} the serial scheme has not been "
            "seen to be stable",
            fitted::min_serial_ratio);
    }
    if (scene::light_in_contact(scene))
        return "implicit: light bodies in contact rattle in the serial scheme";
    if (scene.coupling->immersed_boundary.strength > 2)
        return "serial: the implicit scheme has diverged at strengths above 2";
    return "serial: stable here; implicit where the inertia of light bodies or the "
           "phase of fast ones is to be followed without its lag of a step";
}

// Scheme, cost, density ratio, explicit limit of the drag, and recommended scheme.
std::string explain_coupling(const scene::Scene& scene, const bodies::Solids& solids) {
    const coupler::Coupling& coupling = *scene.coupling;
    const auto [low, high] = density_ratios(scene);
    const lammps::Substeps s = lammps::choose_substeps(scene, solids);
    std::string text =
        fmt::format("\ncoupling ({})\n  {}\n  cost: {}\n",
                    scene::name_of(coupling.scheme), in_words(coupling), cost(coupling));
    text += fmt::format("  density of the bodies over the fluid's: {:.3g}", low);
    if (high > low) text += fmt::format(" to {:.3g}", high);
    // The explicit limit of the drag is dt < 2 / rate, where rate [1/s] is that at which
    // the lightest node takes on the fluid's velocity.
    if (std::isfinite(s.drag_limit_s)) {
        text += fmt::format(
            "; the lightest node follows the fluid at {:.3g} of its slip per coupled "
            "step",
            2 * s.coupled_step_s / s.drag_limit_s);
    }
    return text + "\n" + fmt::format("  recommended: {}\n", recommended(scene, low));
}

}  // namespace

// Parts are left out for effects that the scene lacks.
std::string explain(const scene::Scene& scene, const bodies::Solids& solids,
                    const Ranks& ranks) {
    const int fluid_ranks = ranks.contains("fluid") ? ranks.at("fluid") : 1;
    std::string text = fmt::format("scene '{}'; effects in step order:\n", scene.name);
    for (const std::string& line : scene::effects_by_step(scene))
        text += fmt::format("  {}\n", line);
    for (const std::string& line : scene::idle_effects(scene))
        text += fmt::format("  warning: {}\n", line);
    for (const std::string& line : scene::rounded_intervals(scene))
        text += fmt::format("  warning: {}\n", line);
    for (const std::filesystem::path& file : scene::files_elsewhere(scene))
        text += fmt::format("  reads {}, outside of the scene's folder\n", file.string());
    if (!scene.bodies.empty()) text += explain_structure(scene, solids);
    if (scene.control) text += explain_control(scene, solids);
    if (scene.fluid) text += fluid_program(scene).explain(scene, solids, fluid_ranks);
    check_overlap_at_start(scene, solids);
    if (scene.coupling && !scene.bodies.empty()) text += explain_coupling(scene, solids);
    // Files come last: one that cannot be read has then been refused with its place in
    // the scene by the part that uses it.
    return text + explain_files(scene, solids);
}

namespace {

// Lines of a text for which keep(line without leading blanks) is not "".
template <class Keep>
std::vector<std::string> kept_lines(const std::string& text, Keep&& keep) {
    std::vector<std::string> out;
    std::istringstream lines(text);
    for (std::string line; std::getline(lines, line);) {
        const std::string kept =
            keep(line.substr(std::min(line.find_first_not_of(' '), line.size())));
        if (!kept.empty()) out.push_back(kept);
    }
    return out;
}

}  // namespace

// Warnings are found by their prefix in the text, so that every part of it may give some.
std::vector<std::string> warnings(const std::string& explanation) {
    constexpr std::string_view mark = "warning: ";
    return kept_lines(explanation, [&](const std::string& line) {
        return line.starts_with(mark) ? line.substr(mark.size()) : "";
    });
}

std::vector<std::string> surfaces(const std::string& explanation) {
    return kept_lines(explanation, [&](const std::string& line) {
        return line.find(": surface of ") != std::string::npos ? line : "";
    });
}

// Values that do not apply have no key.
nlohmann::ordered_json facts(const scene::Scene& scene, const bodies::Solids& solids,
                             const Ranks& ranks, const std::string& explained) {
    nlohmann::ordered_json out;
    out["name"] = scene.name;
    out["scene_hash"] = fmt::format("{:016x}", scene.hash);
    out["version"] = MAGFSI_VERSION;
    out["machine"] = machine();
    out["ranks"] = ranks;
    if (scene.fluid) {
        out["fluid"] = {{"spacing_m", scene.fluid->spacing_m},
                        {"step_s", *scene::coupled_step_s(scene)}};
    }
    if (!scene.bodies.empty() && !scene.time.equilibrium) {
        const lammps::Substeps s = lammps::choose_substeps(scene, solids);
        out["structure"] = {{"step_s", s.lammps_step_s}, {"substeps", s.count}};
        if (std::isfinite(s.elastic_limit_s))
            out["structure"]["stable_step_s"] = s.elastic_limit_s;
    }
    if (const auto cost = prediction(scene, solids, ranks))
        out["predicted"] = to_json(*cost);
    out["warnings"] = warnings(explained);
    out["scene"] = scene::effective_scene(scene);
    return out;
}

}  // namespace magfsi::launch
