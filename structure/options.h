// SPDX-License-Identifier: GPL-2.0-or-later
// Options of bodies, loads and contact, in SI. The scene file describes these types
// (adapters/scene/keys_bodies.cpp) and so gets its keys from them. The names of an
// enumeration's values are in words_of beside it, in the order of the values.
#pragma once

#include <array>
#include <cstddef>
#include <numbers>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "base/vector/vec3.h"
#include "base/words/name_of.h"
#include "structure/formula.h"
#include "structure/mesh_options.h"

namespace magfsi::structure {

using magfsi::Vec3;

// --- material and element -----------------------------------------------------------

// Laws of strain stiffening (lattice/stiffening.h); the shear modulus G is that at rest.
struct Gent {
    double limit = 0;  // of I1 - 3, called J_m
    bool operator==(const Gent&) const = default;
};
struct Yeoh {
    double c2_pa = 0, c3_pa = 0;  // C1 is G / 2
    bool operator==(const Yeoh&) const = default;
};
struct ArrudaBoyce {
    double locking_stretch = 0;  // of a chain, the root of its number of segments
    bool operator==(const ArrudaBoyce&) const = default;
};
using Stiffening = std::variant<Gent, Yeoh, ArrudaBoyce>;

// Spring and dashpot in series, beside the elastic network (lattice/maxwell.h).
struct MaxwellBranch {
    double modulus_pa = 0;  // added to the shear modulus at once
    double time_s = 0;      // in which its stress falls to 1/e at rest
    bool operator==(const MaxwellBranch&) const = default;
};

// Neo-Hookean solid, eq. (1) of the paper, or with another energy of I1 in its place.
struct Material {
    double shear_modulus_pa = 0;
    double lame_lambda_pa = 0;  // first Lame constant, the paper's K
    // Density for the inertia. Of a body in a fluid it is rho_solid - rho_fluid, as the
    // fluid solver moves the enclosed fluid, too.
    double density_kg_m3 = 0;
    // Kelvin-Voigt viscosity eta (lattice/element.h); 0: purely elastic
    double viscosity_pa_s = 0;
    std::optional<Stiffening> stiffening{};
    std::vector<MaxwellBranch> branches{};
};

// A material for the elements of some regions of the mesh, in place of the body's
// material.
struct RegionMaterial {
    std::vector<std::string> regions;
    Material material;
};

// Variants of the hexahedron (lattice/element.h).
// full: the paper's element: exact volume, full spring matrix.
// assumed_strain: all of the energy from the mean deformation gradient, and a hourglass
// energy that is exact for linear bending and twist: accurate in every mode with one
// layer, for edges of any ratio.
enum class ElementVariant { full, assumed_strain };
constexpr auto words_of(ElementVariant) {
    return std::to_array<std::string_view>({"full", "assumed_strain"});
}

// Distribution of an element's mass on its nodes (lattice/inertia.h).
// lumped: by the integrals of the shape functions, an eighth on each node of a brick.
// corrected: masses moved so that bodies of two or more elements along each axis have the
// moments of inertia of the solid.
enum class Inertia { lumped, corrected };
constexpr auto words_of(Inertia) {
    return std::to_array<std::string_view>({"lumped", "corrected"});
}

// --- magnetisation, evaluated at the centres of the undeformed elements ---------------

// The same vector in all elements.
struct UniformMagnetization {
    Vec3 vector_a_m{};
};

// M(s) = amplitude [cos(2 pi s / wavelength + phase) e_along + sin(2 pi s / wavelength +
// phase) e_into], with s counted from the body's lowest coordinate on the axis `along`:
// the strip's profile, eq. (10) of the paper.
struct HarmonicMagnetization {
    double amplitude_a_m = 0;
    double wavelength_m = 0;
    double phase_rad = 0;
    int along = 0;  // axes of the mesh: 0 x, 1 y, 2 z
    int into = 2;
};

// Domain of one magnetisation.
struct MagneticDomain {
    RegionShape shape;
    Vec3 vector_a_m{};
};
// The first domain that holds an element's centre wins. Elements in none are not
// magnetised.
struct DomainMagnetization {
    std::vector<MagneticDomain> domains;
};

// One vector for the elements of some regions of the mesh.
struct RegionVector {
    std::vector<std::string> regions;
    Vec3 vector_a_m{};
};
// Magnetisation by regions. Elements of regions that are not named are not magnetised.
struct RegionMagnetization {
    std::vector<RegionVector> regions;
};

// Magnetisation from a CSV file of points and vectors (magnetics/magnetization.h).
struct TableMagnetization {
    std::string file;
};

// Magnetisation along a curve: strength times the tangent at the curve's point nearest to
// the element's centre, rotated in the plane, from its first axis towards its second, by
// phase + 2 pi s / wavelength, where s is the arc length.
struct CurveMagnetization {
    double strength_a_m = 0;
    std::vector<Vec3> points_m;  // points of the curve; none: the mesh's centre line
    double wavelength_m = 0;     // 0: the rotation is `phase` throughout
    double phase_rad = 0;
    std::array<int, 2> plane{0, 2};
};

// Magnetisation that points away from a centre or, with an axis, away from the line
// through the centre along it.
struct RadialMagnetization {
    double strength_a_m = 0;  // negative: towards the centre
    Vec3 centre_m{};
    std::optional<Vec3> axis;  // direction of any length
};

using Magnetization =
    std::variant<UniformMagnetization, HarmonicMagnetization, DomainMagnetization,
                 RegionMagnetization, TableMagnetization, CurveMagnetization,
                 RadialMagnetization>;

// What the magnetisation of a deformed element is: F M (the paper's model), or R M with
// the rotation R of F = R U (magnetics/turned_moments.h).
enum class MagnetizationFollows { deformation, rotation };
constexpr auto words_of(MagnetizationFollows) {
    return std::to_array<std::string_view>({"deformation", "rotation"});
}

// A magnetisation and how it follows the material.
struct Remanence : Magnetization {
    using Magnetization::variant;
    MagnetizationFollows follows = MagnetizationFollows::deformation;
};

// --- magnetic field -----------------------------------------------------------------

// Field of one magnitude and direction; the angle is in FieldProgram::plane.
struct ConstantField {
    double magnitude_t = 0;
    double direction_rad = 0;
};
// Field by rows: linear between them (eqs. 7-9), constant outside of them, or repeated
// with the period time_s.back() - time_s.front(). Two rows of one time are a jump: from
// that time on the later one holds. A negative magnitude reverses the field.
struct FieldTable {
    std::vector<double> time_s, magnitude_t;
    std::vector<double> direction_rad;  // one value for all rows, or one per row
    bool repeat = false;
};
// Field that rotates in FieldProgram::plane.
struct RotatingField {
    double magnitude_t = 0, start_rad = 0;
    // Turns per second, positive from the plane's first axis to its second
    double frequency_hz = 0;
};
// Constant field by its components in space. FieldProgram::plane does not matter for this
// and the following laws.
struct VectorField {
    Vec3 vector_t{};
};
// Table of vectors: as FieldTable, with the components linear between rows.
struct VectorTable {
    std::vector<double> time_s;
    std::vector<Vec3> vector_t;
    bool repeat = false;
    std::string file;    // name of a CSV file with the rows; empty: rows are given
    std::string source;  // path that the rows have been read from
};
// Field amplitude sin(2 pi f t + phase), the same phase for all components.
struct OscillatingField {
    Vec3 amplitude_t{};
    double frequency_hz = 0, phase_rad = 0;
};
// Field on a cone of half angle c about the axis n, precessing right-handed:
//   magnitude [n cos c + (u cos p + n x u sin p) sin c], p = start + 2 pi f t.
// u is the unit vector along the part perpendicular to n of a coordinate axis: the axis
// that follows, in the order x, y, z, x, the one nearest to n. A cone of 90 degrees is a
// rotation in the plane perpendicular to n.
struct PrecessingField {
    double magnitude_t = 0;
    Vec3 axis{0, 0, 1};  // direction of any length
    double cone_rad = std::numbers::pi / 2;
    double frequency_hz = 0, start_rad = 0;
    // Duration of the start, in which the magnitude rises by (1 - cos(pi t / ramp)) / 2
    double ramp_s = 0;
};
// Field by formulas of the time, one per component.
struct FormulaField {
    std::array<Formula, 3> component_t;
};

using FieldLaw =
    std::variant<ConstantField, FieldTable, RotatingField, VectorField, VectorTable,
                 OscillatingField, PrecessingField, FormulaField>;
// A further field that is added to the course.
struct FieldTerm {
    FieldLaw law;
};
// The uniform magnetic field over time: the sum of `course` and of all terms in `plus`.
struct FieldProgram {
    std::array<int, 2> plane{0, 2};  // angles run from the first axis to the second
    FieldLaw course;
    std::vector<FieldTerm> plus{};
};

// Gradient of the flux density, constant in time; its field is added to the course. The
// matrix must be symmetric and traceless, as Maxwell's equations demand of a field
// without currents (magnetics/magnetic_forces.h).
struct GradientInput {
    std::array<Vec3, 3> matrix_t_m{};  // row i, column j: dB_i / dx_j
    Vec3 origin_m{};                   // point where the gradient's own field is zero
};

// --- bodies' own field ----------------------------------------------------------------

// Interaction of magnetised elements as dipoles (magnetics/dipoles.h), always between
// elements of different bodies.
struct DipoleOptions {
    bool within_bodies = false;  // true: also between elements of one body
};

// --- start and supports ---------------------------------------------------------------

// Rotation by an angle from the first axis of the plane towards the second.
struct PlaneRotation {
    std::array<int, 2> plane{0, 2};
    double angle_rad = 0;
};

// Initial shape and place of a body: relaxed, then rotated, then moved.
struct Placement {
    std::optional<Vec3> position_m;         // goal of the centre of volume
    std::optional<PlaneRotation> rotation;  // about the centre of volume
    // Static shape in this constant field, without any other load. Its angle is in the
    // plane of the magnetic field, or in xz if the scene has no field.
    std::optional<ConstantField> relaxed;
    // Motion of a rigid body at time 0: of its centre of mass, and about it. A held body
    // has the latter only.
    std::optional<Vec3> velocity_m_s;
    std::optional<Vec3> angular_velocity_rad_s;
};

// Faces whose nodes keep their coordinate along one axis of space (0 x, 1 y, 2 z) and are
// free along the others. One such face is a plane of symmetry; two opposite ones give
// plane strain.
struct Roller {
    std::vector<std::string> faces;
    int axis = 2;
};

// Displacement amplitude (sin(2 pi f t + phase) - sin(phase)). With phase 0 the motion
// starts at full speed and goes to both sides; with -pi / 2 it starts from rest and goes
// to one side.
struct Oscillation {
    Vec3 amplitude_m{};
    double frequency_hz = 0;
    double phase_rad = 0;
};
// Smooth motion to a displacement, by the factor (1 - cos(pi t / duration)) / 2;
// afterwards the face stays there.
struct DisplacementRamp {
    Vec3 displacement_m{};
    double duration_s = 0;
};
// Motion by formulas of the time, one per component. The displacement of a face is the
// difference from the value at time 0.
struct FormulaMotion {
    std::array<Formula, 3> component_m;
};
// Angle amplitude (sin(2 pi f t + phase) - sin(phase)).
struct AngleOscillation {
    double amplitude_rad = 0;
    double frequency_hz = 0;
    double phase_rad = 0;
};
// Turn, right-handed, about an axis through a point that stays where it is in space. The
// angle of a formula counts from its value at time 0.
struct TurningMotion {
    Vec3 axis{0, 0, 1};  // direction of any length
    Vec3 about_m{};
    std::variant<AngleOscillation, Formula> angle;
};
// A face that is held away from its place in the mesh, from time 0 on. It needs an
// equilibrium to start from.
struct HeldDisplacement {
    Vec3 displacement_m{};
};
using MotionCourse = std::variant<Oscillation, DisplacementRamp, FormulaMotion,
                                  TurningMotion, HeldDisplacement>;

// Faces that are held and moved from outside, by a displacement or a turn that is zero at
// time 0, or held by HeldDisplacement.
struct PrescribedMotion {
    std::size_t body = 0;  // number of the body in the list of bodies
    std::vector<std::string> faces;
    MotionCourse course;
};

// Holds of a rigid part in space: a point that stays where it is, or an axis that does.
struct Pivot {
    Vec3 about_m{};
};
struct Hinge {
    Vec3 axis{0, 0, 1};  // direction of any length
    Vec3 about_m{};      // a point of the axis
};
// Or all of its motion, by a displacement, a turn, or both. The turn is made first: its
// axis moves with the part.
using Way = std::variant<Oscillation, DisplacementRamp, FormulaMotion>;
struct RigidCourse {
    std::optional<Way> way;
    std::optional<TurningMotion> turning;

    // Both, as far as they are there: the displacement of a turn and the turn of a
    // displacement are zero, so that values of all may be summed.
    std::vector<MotionCourse> courses() const {
        std::vector<MotionCourse> all;
        if (way)
            all.push_back(
                std::visit([](const auto& one) { return MotionCourse(one); }, *way));
        if (turning) all.emplace_back(*turning);
        return all;
    }
};
using RigidHold = std::variant<Hinge, Pivot, RigidCourse>;

// --- contact --------------------------------------------------------------------------

// Plane that bodies cannot pass; they may lift off freely.
struct Platform {
    Vec3 point_m{};
    Vec3 normal{0, 0, 1};  // unit vector, towards the bodies
    // Pressure over penetration [Pa/m]; 0: derived from the bodies
    double stiffness_pa_m = 0;
    double friction = 0;  // Coulomb's coefficient mu; 0: smooth
    // Pressure over speed of approach [Pa s/m], only while touching
    double damping_pa_s_m = 0;
};

// Contact between the surfaces of different bodies, and of a body with itself.
struct ContactLaw {
    double distance_m = 0;  // distance below which nodes repel; 0: the smallest thickness
    // Pressure over approach [Pa/m]; 0: derived from the bodies
    double stiffness_pa_m = 0;
    // Pairs of nodes of one body repel only if their distance at rest is at least this
    // many times distance_m.
    double excluded = 2;
    double friction = 0;  // Coulomb's coefficient mu; 0: smooth
};

}  // namespace magfsi::structure
