// SPDX-License-Identifier: GPL-2.0-or-later
// What users choose of bodies and loads. SI. The scene file describes these types
// themselves (adapters/scene/keys_bodies.cpp). The words of an enumeration stand beside
// it, in its order.
#pragma once

#include <array>
#include <cstddef>
#include <numbers>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "structure/formula.h"
#include "words/name_of.h"

namespace magfsi::structure {

using Vec3 = std::array<double, 3>;

// --- meshes -------------------------------------------------------------------------

// Block of hexahedra; the body's frame has its origin in its lowest corner.
struct Box {
    Vec3 size_m{};
    std::array<int, 3> elements{};
};

// Plate of parallelogram cells: the flat crease pattern of Miura-ori (zigzag), or a
// sheared block (mesh/block_mesh.h).
struct ObliquePlate {
    std::array<int, 2> cells{};  // along x (columns) and y (rows)
    double length_a_m = 0;       // a cell's side along x
    double length_b_m = 0;       // and the one at the angle
    double angle_rad = 0;        // between the two, above 0 and below 180 degrees
    double thickness_m = 0;
    std::array<int, 3> elements_per_cell{1, 1, 1};  // along a, along b, layers
    bool zigzag = true;
};

// Hexahedra of a Gmsh file; its physical groups are regions and faces.
struct MeshFile {
    std::string file;
    double unit_m = 1;  // length of the file's unit
};

// Cubes whose middle lies inside the closed surface of an STL file, in a grid around it.
struct FaceBox {
    std::string name;
    std::array<Vec3, 2> box_m{};  // the face is of the nodes inside; bounds included
};
struct VoxelMesh {
    std::string file;
    double spacing_m = 0;        // edge of the cubes
    double unit_m = 1;           // length of the file's unit
    std::vector<FaceBox> faces;  // by name
};

// A block that is bent or wound along a curve: its middle line, of the elements' first
// direction, lies on the curve (mesh/swept_mesh.h).
struct Arc {
    double radius_m = 0;
    double angle_rad = 0;               // 2 pi: a ring
    std::array<double, 2> section_m{};  // width and thickness
    std::array<int, 3> elements{};      // along the curve, the width and the thickness
};
struct Helix {
    double radius_m = 0, pitch_m = 0, turns = 0;
    std::array<double, 2> section_m{};
    std::array<int, 3> elements{};
    bool left_handed = false;
};

using MeshOptions = std::variant<Box, ObliquePlate, MeshFile, VoxelMesh, Arc, Helix>;

// --- material and element -----------------------------------------------------------

// Neo-Hookean solid of eq. (1).
struct Material {
    double shear_modulus_pa = 0;
    double lame_lambda_pa = 0;  // K of eq. (1)
    // Inertia; in a fluid this is rho_solid - rho_fluid (enclosed fluid counted once).
    double density_kg_m3 = 0;
    double viscosity_pa_s = 0;  // Kelvin-Voigt (lattice/element.h); 0: none
};

// Of the elements of these regions of the mesh, in place of the body's material.
struct RegionMaterial {
    std::vector<std::string> regions;
    Material material;
};

// full: the paper's element (exact volume, full spring matrix).
// mean_f: J from the mean deformation gradient and hourglass coefficients 3
// min(l_i,l_j)^2: accurate in bending with few layers.
// assumed_strain: all of the energy from the mean deformation gradient, and a hourglass
// energy that is exact for linear bending and twist (lattice/element.h): accurate in
// every mode with one layer, for edges of any ratio.
enum class ElementVariant { full, mean_f, assumed_strain };
constexpr auto words_of(ElementVariant) {
    return std::to_array<std::string_view>({"full", "mean_f", "assumed_strain"});
}

// lumped: an element's mass spread evenly on its nodes. corrected: moved so that bodies
// of two and more elements along each axis have their moments of inertia
// (lattice/inertia.h).
enum class Inertia { lumped, corrected };
constexpr auto words_of(Inertia) {
    return std::to_array<std::string_view>({"lumped", "corrected"});
}

// --- magnetisation, evaluated at the centres of the undeformed elements ---------------

struct UniformMagnetization {
    Vec3 vector_a_m{};
};

// M(s) = amplitude [cos(2 pi s / wavelength + phase) along + sin(...) into] with s from
// the body's lowest coordinate on the axis `along`: the strip's profile, eq. (10).
struct HarmonicMagnetization {
    double amplitude_a_m = 0;
    double wavelength_m = 0;
    double phase_rad = 0;
    int along = 0;  // axes: 0 x, 1 y, 2 z
    int into = 2;
};

// Holds the centres inside the box (bounds included) and the polygon of the x-y plane; an
// absent box or an empty polygon does not restrict.
struct MagneticDomain {
    std::optional<std::array<Vec3, 2>> box_m;
    std::vector<std::array<double, 2>> polygon_xy_m;
    Vec3 vector_a_m{};
};
struct DomainMagnetization {
    std::vector<MagneticDomain> domains;  // the first that holds a centre wins
};

// Regions of the mesh; one that is not named carries none.
struct RegionVector {
    std::vector<std::string> regions;
    Vec3 vector_a_m{};
};
struct RegionMagnetization {
    std::vector<RegionVector> regions;
};

// A CSV file of points and vectors (magnetics/magnetization.h).
struct TableMagnetization {
    std::string file;
};

// Along a curve: strength times its tangent next to the element, turned in the plane from
// its first axis towards its second by phase + 2 pi s / wavelength, s along the curve.
struct CurveMagnetization {
    double strength_a_m = 0;
    std::vector<Vec3> points_m;  // of the curve; none: the mesh's centre line
    double wavelength_m = 0;     // 0: turned by the phase alone
    double phase_rad = 0;
    std::array<int, 2> plane{0, 2};
};

// Away from a point, or from an axis through it.
struct RadialMagnetization {
    double strength_a_m = 0;  // negative: towards it
    Vec3 centre_m{};
    std::optional<Vec3> axis;  // its direction, of any length
};

using Magnetization =
    std::variant<UniformMagnetization, HarmonicMagnetization, DomainMagnetization,
                 RegionMagnetization, TableMagnetization, CurveMagnetization,
                 RadialMagnetization>;

// --- magnetic field -----------------------------------------------------------------

struct ConstantField {
    double magnitude_t = 0;
    double direction_rad = 0;
};
// Linear between rows (eqs. 7-9); repeated with the period time.back() - time.front().
// Outside the rows the end values hold. Two rows of one time are a jump: from that time
// on the later one. Signed magnitudes flip the field.
struct FieldTable {
    std::vector<double> time_s, magnitude_t;
    std::vector<double> direction_rad;  // one, or one per row
    bool repeat = false;
};
struct RotatingField {
    double magnitude_t = 0, start_rad = 0;
    double frequency_hz =
        0;  // turns per second, from the plane's first axis to its second
};
// Of three components; the plane means nothing to them.
struct VectorField {
    Vec3 vector_t{};
};
// As FieldTable, by rows of vectors.
struct VectorTable {
    std::vector<double> time_s;
    std::vector<Vec3> vector_t;
    bool repeat = false;
    std::string file;    // CSV that the rows are in, instead
    std::string source;  // the file that they have been read from
};
// amplitude sin(2 pi f t + phase)
struct OscillatingField {
    Vec3 amplitude_t{};
    double frequency_hz = 0, phase_rad = 0;
};
// On a cone about the axis n, of a half angle c, right-handed:
//   magnitude [n cos c + (u cos p + n x u sin p) sin c], p = start + 2 pi f t,
// u the part across n of the coordinate axis that follows, in the order x, y, z, x, the
// one nearest to n. A cone of 90 degrees is a rotation in the plane across n.
struct PrecessingField {
    double magnitude_t = 0;
    Vec3 axis{0, 0, 1};  // of any length
    double cone_rad = std::numbers::pi / 2;
    double frequency_hz = 0, start_rad = 0;
    double ramp_s = 0;  // within it the magnitude rises by (1 - cos(pi t / ramp)) / 2
};
// Of the time, by component.
struct FormulaField {
    std::array<Formula, 3> component_t;
};

using FieldLaw =
    std::variant<ConstantField, FieldTable, RotatingField, VectorField, VectorTable,
                 OscillatingField, PrecessingField, FormulaField>;
struct FieldTerm {
    FieldLaw law;
};
struct FieldProgram {
    std::array<int, 2> plane{0, 2};  // angles run from the first axis to the second
    FieldLaw course;
    std::vector<FieldTerm> plus{};  // their fields add to it
};

// Of the flux density; symmetric and traceless, as Maxwell's equations ask without
// currents (magnetics/magnetic_forces.h). Constant in time, it adds to the course.
struct GradientInput {
    std::array<Vec3, 3> matrix_t_m{};  // row i, column j: dB_i / dx_j
    Vec3 origin_m{};                   // where the course's field is the whole field
};

// --- bodies' own field
// ------------------------------------------------------------------

// Magnetised elements act on those of other bodies as dipoles (magnetics/dipoles.h).
struct DipoleOptions {
    bool within_bodies = false;  // and on those of their own
};

// --- how a body starts and is held ----------------------------------------------------

// Rotation by an angle from the first axis of the plane towards the second.
struct PlaneRotation {
    std::array<int, 2> plane{0, 2};
    double angle_rad = 0;
};

// A body's relaxed shape, turned and moved, in this order.
struct Placement {
    std::optional<Vec3> position_m;         // of the centre of volume
    std::optional<PlaneRotation> rotation;  // about the centre of volume
    // The static shape in this constant field of the magnetic field's plane (xz without
    // one), without any other load.
    std::optional<ConstantField> relaxed;
};

// Faces whose nodes keep their coordinate along one axis of space (0 x, 1 y, 2 z) and are
// free along the others: a plane of symmetry, or plane strain with both faces held.
struct Roller {
    std::vector<std::string> faces;
    int axis = 2;
};

// amplitude (sin(2 pi f t + phase) - sin(phase)). Phase 0: at full speed at once, to
// both sides of the start; -pi / 2: from rest, to one side.
struct Oscillation {
    Vec3 amplitude_m{};
    double frequency_hz = 0;
    double phase_rad = 0;
};
// To the displacement within the duration, by (1 - cos(pi t / duration)) / 2; stays
// there.
struct DisplacementRamp {
    Vec3 displacement_m{};
    double duration_s = 0;
};
// Of the time, by component. Of faces it counts from its value at time 0.
struct FormulaMotion {
    std::array<Formula, 3> component_m;
};
using MotionCourse = std::variant<Oscillation, DisplacementRamp, FormulaMotion>;

// Faces that something outside holds and moves: displacement from where they start, zero
// at time 0.
struct PrescribedMotion {
    std::size_t body = 0;  // number of the body, for those who hold several
    std::vector<std::string> faces;
    MotionCourse course;
};

// --- what bodies touch ----------------------------------------------------------------

// A plane that bodies cannot pass; they may leave it freely.
struct Platform {
    Vec3 point_m{};
    Vec3 normal{0, 0, 1};       // unit vector, towards the bodies
    double stiffness_pa_m = 0;  // pressure over penetration; 0: from the bodies
    double friction = 0;        // Coulomb's coefficient mu; 0: smooth
    double damping_pa_s_m = 0;  // pressure over the speed of approach, while touching
};

// Between the surfaces of bodies, and of a body with itself.
struct ContactLaw {
    double distance_m = 0;      // nodes closer than this repel; 0: the smallest thickness
    double stiffness_pa_m = 0;  // pressure over approach; 0: from the bodies
    // Nodes of one body whose distance at rest is below this many distances do not repel.
    double excluded = 2;
    double friction = 0;  // Coulomb's coefficient mu; 0: smooth
};

}  // namespace magfsi::structure
