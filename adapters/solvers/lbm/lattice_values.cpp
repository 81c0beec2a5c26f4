// SPDX-License-Identifier: GPL-2.0-or-later
#include "adapters/solvers/lbm/lattice_values.h"
#include "base/fitted/constants.h"
#include "fluid_lbm/collision/bulk_viscosity.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace magfsi::lbm {

namespace {

// Compressibility errors of the lattice are of the order of the Mach number squared.
constexpr double max_mach = 0.17;  // 3 %
// Below min_tau the viscous length is far smaller than a cell, and only regularised or
// filtered collisions stay stable. Above max_tau the error at walls, which grows as
// (tau - 1/2)^2, is too large.
constexpr double min_tau = 0.501, max_tau = 1.0;
// At a smaller rate perturbations of the odd modes live for more than ten steps and grow
// in fast flows.
constexpr double min_odd_rate = 0.1;
// Advice has three digits; whoever follows it may be beyond a limit by their rounding.
constexpr double rounded = 1.005;

// Value of (omega L / c)^2 above which the text suggests a ramp, and the part of its peak
// by which the velocity of such a ramp changes at most while sound crosses the box.
constexpr double overshoots = 0.05;
const double overshoots_by = std::sqrt(overshoots) / 2;

// Largest change of a course by table or formula, over its peak, within an interval; the
// inlet's ramp included.
double largest_change(const fluid::Inlet& inlet, double within_s, double end_s) {
    const auto factor = [&](double t_s) {
        const double ramp =
            t_s >= inlet.ramp_s
                ? 1
                : 0.5 * (1 - std::cos(std::numbers::pi * t_s / inlet.ramp_s));
        return ramp * inlet.factor(t_s);
    };
    constexpr int most = 100'000;  // steps looked at
    const int count = static_cast<int>(std::min<double>(most, 4 * end_s / within_s + 1));
    double largest = 0;
    for (int i = 0; i < count; ++i) {
        const double t_s = end_s * i / count;
        largest = std::max(largest, std::abs(factor(t_s + within_s) - factor(t_s)));
    }
    return largest / inlet.peak_factor;
}

}  // namespace

LatticeValues lattice_values(const scene::Fluid& fluid,
                             const fluid::FluidConfig& config) {
    LatticeValues v{fluid.spacing_m, config.time_step_s, fluid::relaxation_time(config)};
    if (fluid::choose_collision(config) == fluid::Collision::trt)
        v.odd_rate = fluid::odd_rate(config);
    v.speed = fluid.expected_speed_m_s * v.step_s / v.spacing_m;
    v.mach = v.speed * std::sqrt(3.0);
    v.quickest_1_s = fluid.expected_speed_m_s / fluid.spacing_m;
    v.quickest_m2_s =
        fluid.rheology
            ? fluid::viscosity_m2_s(*fluid.rheology, fluid.viscosity_m2_s, v.quickest_1_s)
            : fluid.viscosity_m2_s;
    v.grid_reynolds = fluid.expected_speed_m_s * fluid.spacing_m / v.quickest_m2_s;
    return v;
}

std::string table(const scene::Fluid& fluid, const LatticeValues& v) {
    std::string text =
        "\nfluid (lattice-Boltzmann, D3Q19)           SI            lattice\n";
    const auto row = [&](const char* name, const std::string& si, double lattice) {
        text += fmt::format("  {:<34} {:>14} {:>12.5g}\n", name, si, lattice);
    };
    row("spacing", fmt::format("{:.4g} mm", v.spacing_m * 1e3), 1);
    row("time step", fmt::format("{:.4g} us", v.step_s * 1e6), 1);
    row("density", fmt::format("{:.5g} kg/m3", fluid.density_kg_m3), 1);
    row("viscosity", fmt::format("{:.4g} mm2/s", fluid.viscosity_m2_s * 1e6),
        (v.tau - 0.5) / 3);
    if (fluid.bulk_viscosity_m2_s)
        row("bulk viscosity",
            fmt::format("{:.4g} mm2/s", *fluid.bulk_viscosity_m2_s * 1e6),
            *fluid.bulk_viscosity_m2_s * v.step_s / (v.spacing_m * v.spacing_m));
    row("speed of sound",
        fmt::format("{:.4g} m/s", v.spacing_m / v.step_s / std::sqrt(3.0)),
        1 / std::sqrt(3.0));
    if (fluid.expected_speed_m_s > 0) {
        row("expected speed", fmt::format("{:.4g} m/s", fluid.expected_speed_m_s),
            v.speed);
        row("Mach number", "", v.mach);
        row("Reynolds number of a cell", "", v.grid_reynolds);
    }
    row("relaxation time", "", v.tau);
    if (fluid.rheology) {
        const double nu = v.quickest_m2_s * v.step_s / (v.spacing_m * v.spacing_m);
        row(fmt::format("viscosity at {:.4g} 1/s, across a cell", v.quickest_1_s).c_str(),
            fmt::format("{:.4g} mm2/s", v.quickest_m2_s * 1e6), nu);
        row("relaxation time there", "", 3 * nu + 0.5);
    }
    return text;
}

std::string warnings(const scene::Scene& scene, const LatticeValues& v) {
    std::string text;
    const auto warn = [&](const std::string& line) {
        text += "  warning: " + line + "\n";
    };
    if (v.mach > max_mach * rounded) {
        const double factor = max_mach / v.mach;
        warn(
            fmt::format("a Mach number of {:.3g} makes an error of {:.2g} %: take {}",
                        v.mach, 100 * v.mach * v.mach,
                        scene.time.step_s
                            ? fmt::format("time.step: {:.3g} us", v.step_s * factor * 1e6)
                            : fmt::format("lattice_speed: {:.3g}",
                                          scene.fluid->lattice_speed * factor)));
    }
    if (v.tau > max_tau * rounded) {
        warn(
            fmt::format("a relaxation time of {:.3g} is inaccurate at walls: take a "
                        "time.step of {:.3g} us",
                        v.tau, v.step_s * (max_tau - 0.5) / (v.tau - 0.5) * 1e6));
    }
    if (v.odd_rate < min_odd_rate) {
        warn(fmt::format(
            "magic_number lets odd modes decay by {:.2g} a step only, and trt tends to "
            "diverge: leave it out, or take {:.2g}",
            v.odd_rate, (v.tau - 0.5) / 2));
    }
    if (v.tau < min_tau) {
        // If the step follows from the lattice speed, tau - 1/2 is proportional to
        // 1 / spacing.
        warn(fmt::format(
            "a relaxation time of {:.5g} leaves little viscosity to the grid: "
            "take a spacing of {:.3g} mm or less",
            v.tau, v.spacing_m * (v.tau - 0.5) / (min_tau - 0.5) * 1e3));
    }
    // Shear layers begin at bodies, where the finest cells are.
    const double finest_m = scene.fluid->finest_spacing_m();
    const double finest_reynolds = v.grid_reynolds * finest_m / v.spacing_m;
    if (finest_reynolds > fitted::max_cell_reynolds * rounded &&
        scene.fluid->smagorinsky_constant == 0) {
        // A rheology and an eddy viscosity exclude each other.
        warn(fmt::format(
            "at a cell's Reynolds number of {:.3g} shear layers are not "
            "resolved: take a spacing of {:.3g} mm{}{}",
            finest_reynolds, finest_m * fitted::max_cell_reynolds / finest_reynolds * 1e3,
            finest_m < v.spacing_m ? " on the finest level" : "",
            scene.fluid->rheology ? "" : ", or smagorinsky: {constant: 0.1}"));
    }
    return text;
}

std::string life_of_sound(const scene::Fluid& fluid, const LatticeValues& v) {
    using std::numbers::pi;
    // The slowest standing wave: half a wave length between walls, a whole one in a
    // period.
    double k_1_m = 0, length_m = 0;
    for (std::size_t d = 0; d < 3; ++d) {
        const auto kind = [&](std::size_t high) {
            return fluid.boundaries[2 * d + high].kind;
        };
        const auto outlet = fluid::BoundaryKind::pressure_outlet;
        if (kind(0) == outlet || kind(1) == outlet) continue;
        const bool periodic = kind(0) == fluid::BoundaryKind::periodic;
        const double k = (periodic ? 2 * pi : pi) / fluid.box_m[d];
        if (k_1_m > 0 && k >= k_1_m) continue;
        k_1_m = k;
        length_m = fluid.box_m[d];
    }
    if (k_1_m == 0) return "";
    const double sound_m_s = v.spacing_m / v.step_s / std::sqrt(3.0);
    const double viscosity_m2_s = fluid.viscosity_m2_s;
    const auto life_s = [&](double bulk_m2_s) {
        return 1 / fluid::sound_decay_1_s(viscosity_m2_s, bulk_m2_s, sound_m_s, k_1_m);
    };
    const double now_s =
        life_s(fluid.bulk_viscosity_m2_s.value_or(2.0 / 3 * viscosity_m2_s));
    std::string text = fmt::format(
        "  sound: {:.3g} ms through {:.4g} mm of the box; a wave that stands there "
        "decays "
        "to 1/e in {:.3g} ms",
        1e3 * length_m / sound_m_s, 1e3 * length_m, 1e3 * now_s);
    const double finest_step_s = v.step_s / fluid.coupled_steps_in_one();
    // Three digits of the bound may exceed it.
    const double useful_m2_s = std::min(
        fluid::useful_bulk_viscosity_m2_s(sound_m_s, k_1_m),
        fluid::largest_bulk_viscosity_m2_s(finest_step_s, fluid.finest_spacing_m()) /
            rounded);
    if (now_s > 2 * life_s(useful_m2_s))
        text += fmt::format(", with fluid.bulk_viscosity: {:.3g} mm2/s in {:.3g} ms",
                            useful_m2_s * 1e6, 1e3 * life_s(useful_m2_s));
    return text + "\n";
}

std::string sound(const scene::Fluid& fluid, const LatticeValues& v, double end_s) {
    using std::numbers::pi;
    std::string text;
    for (std::size_t face = 0; face < 6; ++face) {
        if (fluid.boundaries[face].kind != fluid::BoundaryKind::velocity_inlet) continue;
        const fluid::Inlet& inlet = fluid.boundaries[face].inlet;
        const double crossing_s =
            fluid.box_m[face / 2] / (v.spacing_m / v.step_s / std::sqrt(3.0));
        const auto square = [&](double omega) { return std::pow(omega * crossing_s, 2); };
        text += fmt::format("  {}: sound crosses the box in {:.3g} ms",
                            scene::names<scene::Face>[face], 1e3 * crossing_s);
        const auto* wave =
            inlet.course ? std::get_if<fluid::InletWave>(&*inlet.course) : nullptr;
        if (wave != nullptr)
            text += fmt::format("; (omega L/c)^2 of the course is {:.2g}",
                                square(2 * pi * wave->frequency_hz));
        // A fluid that already moves at the start with the inlet needs no ramp.
        const bool at_once =
            inlet.ramp_s == 0 &&
            (inlet.course ? inlet.factor(0) != 0 : !fluid.initial_velocity_m_s);
        const double change = inlet.course && wave == nullptr
                                  ? largest_change(inlet, crossing_s, end_s)
                                  : 0;
        const double start = inlet.ramp_s > 0 ? square(pi / inlet.ramp_s) : 0;
        if (at_once)
            text += "; the flow starts at once";
        else if (start > 0)
            text += fmt::format("; of the ramp {:.2g}", start);
        if (at_once || start > overshoots)
            text += fmt::format(
                ", so that the far end follows late and overshoots, and forces with it: "
                "a ramp of {:.3g} ms has {:.2g}",
                1e3 * pi * crossing_s / std::sqrt(overshoots), overshoots);
        else if (change > overshoots_by)
            text += fmt::format(
                "; meanwhile the course changes by {:.2g} of its peak, so that the far "
                "end follows late and overshoots, and forces with it: with a course "
                "{:.2g} times as slow it would hardly",
                change, change / overshoots_by);
        text += "\n";
    }
    return text;
}

}  // namespace magfsi::lbm
