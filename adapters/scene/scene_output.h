// SPDX-License-Identifier: GPL-2.0-or-later
// The part of a scene that tells what a run leaves: probes, field files, checkpoints.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "base/vector/vec3.h"

namespace magfsi::scene {

// Quantities of each body that probes.csv can have as columns.
enum class BodyQuantity {
    com,
    speed,
    shape,
    max_displacement,
    fluid_force,
    fluid_torque,
    reaction_force,
    energy,
    magnetic_load,
    contact_load,
    rigid_motion
};
constexpr auto words_of(BodyQuantity) {
    return std::to_array<std::string_view>(
        {"com", "speed", "shape", "max_displacement", "fluid_force", "fluid_torque",
         "reaction_force", "energy", "magnetic_load", "contact_load", "rigid_motion"});
}
// Quantities of the whole fluid that probes.csv can have as columns.
enum class FluidQuantity {
    kinetic_energy,
    enstrophy,
    mass,
    momentum,
    max_speed,
    obstacle_force
};
constexpr auto words_of(FluidQuantity) {
    return std::to_array<std::string_view>({"kinetic_energy", "enstrophy", "mass",
                                            "momentum", "max_speed", "obstacle_force"});
}

// A point of a body whose place and displacement are probed.
struct PointProbe {
    std::string name;
    std::string body;
    Vec3 at_m{};  // in the body's frame, before placement
};

// Integration domain: the fluid in a plane across the box, without obstacles.
struct FluidPlane {
    int axis = 0;  // normal axis: 0 x, 1 y, 2 z
    double at_m = 0;
};
// Integration domain: the elements of a body whose centres lie in a box of the body's
// frame.
struct BodyPart {
    std::string body;
    std::optional<std::array<Vec3, 2>> box_m;  // absent: the whole body
};
// A probe that integrates over a plane of the fluid or a part of a body.
struct IntegralProbe {
    std::string name;
    std::variant<FluidPlane, BodyPart> over;
};

// Contents of probes.csv.
struct Probes {
    double every_s = 0;
    std::vector<BodyQuantity> bodies;
    std::vector<PointProbe> points;        // sorted by name
    std::vector<IntegralProbe> integrals;  // sorted by name
    std::vector<FluidQuantity> fluid;
    // True to give the fluid's forces on bodies as means since the last row, not over the
    // last step.
    bool mean_forces = false;
    // True to record the momentum and power exchanged between fluid and bodies at each
    // step.
    bool interface_balance = false;
    // True to record the energy balance of all bodies and the fluid's share in it.
    bool energy_audit = false;
};

// Fields that fluid files can have.
enum class FluidField { velocity, density, vorticity, pressure, obstacle };
constexpr auto words_of(FluidField) {
    return std::to_array<std::string_view>(
        {"velocity", "density", "vorticity", "pressure", "obstacle"});
}
constexpr int components_of(FluidField field) {
    return field == FluidField::velocity || field == FluidField::vorticity ? 3 : 1;
}
constexpr std::string_view unit_of(FluidField field) {
    constexpr std::string_view units[] = {"m/s", "kg/m3", "1/s", "Pa", "1"};
    return units[static_cast<int>(field)];
}

// Fields that structure files can have.
enum class BodyField {
    displacement,
    velocity,
    magnetization,
    stretches,
    magnetic_force,
    elastic_force,
    stress,
    volume_ratio,
    energy_density
};
constexpr auto words_of(BodyField) {
    return std::to_array<std::string_view>(
        {"displacement", "velocity", "magnetization", "stretches", "magnetic_force",
         "elastic_force", "stress", "volume_ratio", "energy_density"});
}

// Field files for ParaView and their intervals.
struct StructureOutput {
    double every_s = 0;
    std::vector<BodyField> fields{BodyField::displacement, BodyField::velocity,
                                  BodyField::magnetization, BodyField::stretches};
};
struct FluidOutput {
    double every_s = 0;
    std::vector<FluidField> fields{FluidField::velocity};
};
struct Output {
    std::optional<StructureOutput> structure;
    std::optional<FluidOutput> fluid;
};

// Reaction to a divergence. `retry` continues from the last checkpoint with half the
// steps.
enum class OnDivergence { stop, retry };
constexpr auto words_of(OnDivergence) {
    return std::to_array<std::string_view>({"stop", "retry"});
}

// Checkpoints: states of all participants from which a run can continue.
struct Checkpoint {
    double every_s = 0;
    OnDivergence on_divergence = OnDivergence::stop;
    int max_retries = 3;  // limit per run

    bool retry() const { return on_divergence == OnDivergence::retry; }
};

}  // namespace magfsi::scene
