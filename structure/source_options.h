// SPDX-License-Identifier: GPL-2.0-or-later
// Sources of the magnetic field that users choose. SI; as in structure/options.h.
#pragma once

#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "structure/options.h"

namespace magfsi::structure {

struct DipoleSource {
    Vec3 moment_a_m2{};
};
struct CuboidMagnet {
    Vec3 size_m{};
    Vec3 remanence_t{};
};
struct CylinderMagnet {
    double diameter_m = 0, height_m = 0;
    Vec3 axis{0, 0, 1};  // of any length
    Vec3 remanence_t{};  // in the frame whose z is the axis
};
struct CircularCoil {
    double diameter_m = 0;
    Vec3 axis{0, 0, 1};  // current runs right-handed about it
    double current_a = 0, turns = 1;
};
// Two on one axis, this far apart; opposed: the second, on the side that the axis points
// to, with the current the other way round. Helmholtz: distance = radius; Maxwell:
// opposed and sqrt(3) radii.
struct CoilPair : CircularCoil {
    double distance_m = 0;
    bool opposed = false;
};
// Coils whose currents, a row each, are linear between the times of the columns; held
// before and after, or repeated. A coil with a formula has it in place of its row.
struct SystemCoil {
    Vec3 position_m{};
    double diameter_m = 0;
    Vec3 axis{0, 0, 1};
    double turns = 1;
    std::vector<double> current_a;
    std::optional<Formula> current{};
};
struct CoilSystem {
    std::vector<SystemCoil> coils;
    std::vector<double> time_s{};  // may be empty where each coil has one current
    bool repeat = false;
};
// Values on a regular grid (magnetics/grid_field.h), in the source's frame.
struct GridField {
    std::string file;
};
using SourceShape = std::variant<DipoleSource, CuboidMagnet, CylinderMagnet, CircularCoil,
                                 CoilPair, CoilSystem, GridField>;

// Factors of its strength: sin(2 pi f t + phase), a table, a rise from zero by
// (1 - cos(pi t / duration)) / 2, a formula.
struct StrengthOscillation {
    double frequency_hz = 0, phase_rad = 0;
};
struct StrengthTable {
    std::vector<double> time_s, factor;
    bool repeat = false;
};
struct StrengthRamp {
    double duration_s = 0;
};
using StrengthLaw =
    std::variant<StrengthOscillation, StrengthTable, StrengthRamp, Formula>;

// Displacement from `position`.
struct SourcePath {
    std::vector<double> time_s;
    std::vector<Vec3> displacement_m;
    bool repeat = false;
};
using SourceMotion =
    std::variant<Oscillation, DisplacementRamp, FormulaMotion, SourcePath>;

struct AxisRotation {
    Vec3 axis{0, 0, 1};  // of any length, right-handed
    double angle_rad = 0;
};
// Turning about an axis through the source, or through a point that it circles: at a
// frequency [Hz], or by an angle [rad].
struct SourceTurning {
    Vec3 axis{0, 0, 1};
    std::variant<double, Formula> turns = 0.0;
    std::optional<Vec3> about_m;
};
struct FieldSource {
    std::string name;
    SourceShape shape;
    Vec3 position_m{};  // of its centre
    std::optional<AxisRotation> rotation;
    std::optional<StrengthLaw> strength;
    std::optional<SourceMotion> motion;
    std::optional<SourceTurning> turning;
};

}  // namespace magfsi::structure
