// SPDX-License-Identifier: GPL-2.0-or-later
// Sources of the magnetic field: permanent magnets, coils and fields on a grid. SI;
// conventions are those of structure/options.h.
#pragma once

#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "structure/options.h"

namespace magfsi::structure {

// Point dipole.
struct DipoleSource {
    Vec3 moment_a_m2{};
};
// Uniformly magnetised block along the axes of the source's frame.
struct CuboidMagnet {
    Vec3 size_m{};
    Vec3 remanence_t{};
};
// Uniformly magnetised cylinder.
struct CylinderMagnet {
    double diameter_m = 0, height_m = 0;
    Vec3 axis{0, 0, 1};  // direction of any length
    Vec3 remanence_t{};  // in the frame whose z axis is `axis`
};
// Thin circular loop.
struct CircularCoil {
    double diameter_m = 0;
    // Direction of any length; the current runs right-handed about it
    Vec3 axis{0, 0, 1};
    double current_a = 0, turns = 1;
};
// Two equal coils on one axis, distance_m apart. opposed: the current of the second one,
// on the side that the axis points to, is reversed. A distance of one radius makes
// Helmholtz coils; opposed coils at sqrt(3) radii are Maxwell coils.
struct CoilPair : CircularCoil {
    double distance_m = 0;
    bool opposed = false;
};
// One coil of a system: its current at each time of CoilSystem::time_s, or a formula,
// which replaces these values.
struct SystemCoil {
    Vec3 position_m{};
    double diameter_m = 0;
    Vec3 axis{0, 0, 1};
    double turns = 1;
    std::vector<double> current_a;
    std::optional<Formula> current{};
};
// Coils with their own currents, linear between the times, constant outside of them, or
// repeated.
struct CoilSystem {
    std::vector<SystemCoil> coils;
    std::vector<double> time_s{};  // may be empty if each coil has one current
    bool repeat = false;
};
// Field values on a regular grid of the source's frame, from a file
// (magnetics/grid_field.h).
struct GridField {
    std::string file;
};
using SourceShape = std::variant<DipoleSource, CuboidMagnet, CylinderMagnet, CircularCoil,
                                 CoilPair, CoilSystem, GridField>;

// Factor of a source's strength over time: sin(2 pi f t + phase), a table, a rise from
// zero by (1 - cos(pi t / duration)) / 2, or a formula.
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

// Displacement of a source from its position by rows, linear between them.
struct SourcePath {
    std::vector<double> time_s;
    std::vector<Vec3> displacement_m;
    bool repeat = false;
};
using SourceMotion =
    std::variant<Oscillation, DisplacementRamp, FormulaMotion, SourcePath>;

struct AxisRotation {
    // Direction of any length; the angle is right-handed
    Vec3 axis{0, 0, 1};
    double angle_rad = 0;
};
// Rotation of a source about an axis, right-handed: at a frequency [Hz] or by a formula
// for the angle [rad]. The axis passes through the source, or through about_m, which the
// source then circles.
struct SourceTurning {
    Vec3 axis{0, 0, 1};
    std::variant<double, Formula> turns = 0.0;
    std::optional<Vec3> about_m;
};
// A source in space. It is rotated about its own centre first, then moved by `motion` and
// `turning`.
struct FieldSource {
    std::string name;
    SourceShape shape;
    Vec3 position_m{};  // place of its centre
    std::optional<AxisRotation> rotation;
    std::optional<StrengthLaw> strength;
    std::optional<SourceMotion> motion;
    std::optional<SourceTurning> turning;
};

}  // namespace magfsi::structure
