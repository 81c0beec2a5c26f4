// The scene: what a user asked for, checked and in SI. Plain data; absent effects are
// empty optionals. Filled by reader.h, read by the adapters.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "adapters/scene/coupling.h"

namespace magfsi::scene {

using Vec3 = std::array<double, 3>;

// Time is then the parameter of a path of loads, and each probe row an equilibrium.
enum class EquilibriumMethod { newton, dynamics };
struct Equilibrium {
    EquilibriumMethod method = EquilibriumMethod::newton;
    double tolerance = 1e-6;  // largest nodal force over the largest nodal load
};

struct Time {
    double end_s = 0;
    std::optional<double> step_s;  // coupled step; absent: from the lattice speed
    std::optional<Equilibrium> equilibrium;
    // How often a retry has halved all steps of this run; no key of it, no part
    // of its hash.
    int halvings = 0;
};

// --- bodies -------------------------------------------------------------------------

// Block of hexahedra; the body's frame has its origin in its lowest corner.
struct BoxMesh {
    Vec3 size_m{};
    std::array<int, 3> elements{};
};

// Plate of parallelogram cells, each a region "row R column C": the flat crease pattern
// of Miura-ori (zigzag), or a sheared block.
struct ObliqueMesh {
    std::array<int, 2> cells{};  // along x and y
    double length_a_m = 0;       // a cell's side along x
    double length_b_m = 0;       // and the one at the angle
    double angle_rad = 0;
    double thickness_m = 0;
    std::array<int, 3> elements{};  // in a cell: along a, along b, layers
    bool zigzag = true;
};

// Hexahedra of a Gmsh file; its physical groups are regions and faces.
struct FileMesh {
    std::string file;
    double unit_m = 1;  // length of the file's unit
};
using BodyMesh = std::variant<BoxMesh, ObliqueMesh, FileMesh>;

// Neo-Hookean solid of eq. (1). lame_lambda is the constant called K in the paper.
struct Material {
    double shear_modulus_pa = 0;
    double lame_lambda_pa = 0;
    double density_kg_m3 = 0;
    std::optional<double> viscosity_pa_s;  // Kelvin-Voigt
};

// Of the elements of these regions of the mesh, in place of the body's material.
struct RegionMaterial {
    std::vector<std::string> regions;
    Material material;
};

enum class ElementVariant { full, mean_f, assumed_strain };

struct UniformMagnetization {
    Vec3 vector_a_m{};
};
// M(s) = amplitude [cos(2 pi s / wavelength + phase) along + sin(...) into], s from the
// body's left end (eq. 10 of the paper's strip).
struct HarmonicMagnetization {
    double amplitude_a_m = 0;
    double wavelength_m = 0;
    double phase_rad = 0;
    int along = 0;  // axis of s: 0 x, 1 y, 2 z
    int into = 2;
};
// Elements whose centre lies in the box, or in the polygon of the x-y plane, carry the
// vector; the first domain that holds a centre wins.
struct MagneticDomain {
    std::optional<std::array<Vec3, 2>> box_m;
    std::vector<std::array<double, 2>> polygon_xy_m;
    Vec3 vector_a_m{};
};
struct DomainMagnetization {
    std::vector<MagneticDomain> domains;
};
// Regions of the mesh; one that is not named carries none.
struct RegionVector {
    std::vector<std::string> regions;
    Vec3 vector_a_m{};
};
struct RegionMagnetization {
    std::vector<RegionVector> regions;
};
// A CSV file of points and vectors; each element takes the vector of the nearest point.
struct TableMagnetization {
    std::string file;
};
using Magnetization =
    std::variant<UniformMagnetization, HarmonicMagnetization, DomainMagnetization,
                 RegionMagnetization, TableMagnetization>;

// Rotation by an angle from the first axis of the plane towards the second.
struct PlaneRotation {
    std::array<int, 2> plane{0, 2};
    double angle_rad = 0;
};

// The static shape in a constant field of the magnetic field's plane (xz without one),
// found before the run without fluid and gravity.
struct RelaxedShape {
    double magnitude_t = 0;
    double direction_rad = 0;
};

struct InitialState {
    std::optional<Vec3> position_m;  // where the centre of volume goes
    std::optional<PlaneRotation> rotation;
    std::optional<RelaxedShape> relaxed;
};

// Faces held along one axis of space, free to slide along the others.
struct Roller {
    std::vector<std::string> faces;
    int axis = 2;  // 0 x, 1 y, 2 z
};

// Of a face that something outside holds and moves: amplitude (sin(2 pi f t + phase) -
// sin(phase)), or to the displacement and no further.
struct Oscillation {
    Vec3 amplitude_m{};
    double frequency_hz = 0;
    double phase_rad = 0;
};
struct DisplacementRamp {
    Vec3 displacement_m{};
    double duration_s = 0;
};
struct PrescribedMotion {
    std::vector<std::string> faces;
    std::variant<Oscillation, DisplacementRamp> course;
};

enum class Face { x_min, x_max, y_min, y_max, z_min, z_max };

struct Body {
    std::string name;
    BodyMesh mesh;
    ElementVariant element = ElementVariant::full;
    Material material;
    std::vector<RegionMaterial> material_regions;
    std::optional<Magnetization> magnetization;
    std::vector<std::string> clamps;  // faces; of a block x_min to z_max
    std::vector<Roller> rollers;
    std::vector<PrescribedMotion> prescribed_motion;
    InitialState initial;
};

// --- loads --------------------------------------------------------------------------

struct ConstantField {
    double magnitude_t = 0;
    double direction_rad = 0;
};
// Linear between the rows (eqs. 7-9); signed magnitudes flip the field.
struct FieldTable {
    std::vector<double> time_s;
    std::vector<double> magnitude_t;
    std::vector<double> direction_rad;  // one value, or one a row
    bool repeat = false;
};
struct RotatingField {
    double magnitude_t = 0;
    double start_rad = 0;
    double frequency_hz = 0;  // turns a second, from the plane's first axis to its second
};
// Of the flux density; symmetric and traceless, as Maxwell's equations ask without
// currents. It is constant in time and adds to the course.
struct FieldGradient {
    std::array<Vec3, 3> matrix_t_m{};  // row i, column j: dB_i / dx_j
    Vec3 origin_m{};                   // where the course's field is the whole field
};
struct MagneticField {
    std::array<int, 2> plane{0, 2};
    std::variant<ConstantField, FieldTable, RotatingField> course;
    std::optional<FieldGradient> gradient;
};

struct Gravity {
    double acceleration_m_s2 = 0;
    Vec3 direction{0, 0, -1};  // unit vector
};

struct Damping {
    double rate_1_s = 0;  // force = -rate * mass * velocity, on every node
};

// A plane that bodies cannot pass; they may leave it freely.
struct Platform {
    Vec3 point_m{};
    Vec3 normal{0, 0, 1};                  // unit vector, towards the bodies
    std::optional<double> stiffness_pa_m;  // pressure over penetration; absent: from the
                                           // bodies
    std::optional<double> friction;        // Coulomb's coefficient
};

// Between the surfaces of bodies, and of a body with itself.
struct Contact {
    std::optional<double> distance_m;      // absent: the thickness of the thinnest body
    std::optional<double> stiffness_pa_m;  // absent: from the bodies
};

// --- fluid --------------------------------------------------------------------------

enum class FluidSolver { lbm, openfoam };
enum class Collision { automatic, bgk, trt, recursive_regularized };
enum class Precision { double_, float_, float_double };  // storage, storage_arithmetic
enum class BoundaryKind { periodic, no_slip, free_slip, velocity_inlet, pressure_outlet };
enum class InletProfile { uniform, parabolic, plug };

// Openings of a side in its plane: coordinates along the two other axes, in the order x,
// y, z.
struct Rectangle {
    std::array<double, 2> centre_m{}, size_m{};
};
struct Disc {
    std::array<double, 2> centre_m{};
    double diameter_m = 0;
};
using Patch = std::variant<std::monostate, Rectangle, Disc>;

struct Boundary {
    BoundaryKind kind = BoundaryKind::no_slip;
    Vec3 velocity_m_s{};  // of a wall, tangential; of an inlet, mean over its opening
    InletProfile profile = InletProfile::uniform;
    double ramp_s = 0;
    double pressure_pa = 0;  // of an outlet; gauge
    Patch patch;             // of inlets and outlets; none: the whole side
};

struct Sphere {
    Vec3 centre_m{};
    double diameter_m = 0;
};
struct Cylinder {
    Vec3 centre_m{};
    double diameter_m = 0;
    int axis = 2;
    std::optional<double> length_m;  // absent: through the box
};
struct Block {
    std::array<Vec3, 2> corners_m{};
};
struct StlSurface {
    std::string file;
    double unit_m = 1;
    Vec3 shift_m{};
};
struct Obstacle {
    std::string name;
    std::variant<Sphere, Cylinder, Block, StlSurface> shape;
};

// Cubic cells in a part of the box, growing ones outside.
struct Grading {
    std::array<Vec3, 2> uniform_m{};  // lower and upper corner of the part
    double growth = 1.1;              // largest ratio of neighbouring cells
};

struct Smagorinsky {
    double constant = 0;
};

// One period along each side of a periodic cube of side L, k = 2 pi / L:
// u = U (sin kx cos ky cos kz, -cos kx sin ky cos kz, 0), with its pressure.
struct TaylorGreen {
    double speed_m_s = 0;  // U
};

struct Fluid {
    FluidSolver solver = FluidSolver::lbm;
    Vec3 box_m{};
    double spacing_m = 0;
    double density_kg_m3 = 0;
    double viscosity_m2_s = 0;       // kinematic
    double expected_speed_m_s = 0;   // largest to resolve; 0: not given, time.step is
    double lattice_speed = 0.05;     // that speed in lattice units (Mach limit)
    double courant = 0.2;            // the same for openfoam, which has no such limit
    std::optional<Grading> grading;  // of openfoam
    Collision collision = Collision::automatic;
    std::optional<double> magic_number;  // Lambda of trt; absent: by relaxation time
    Precision precision = Precision::double_;
    std::optional<Smagorinsky> smagorinsky;
    std::array<Boundary, 6> boundaries{};  // by Face
    std::vector<Obstacle> obstacles;       // by name
    std::optional<Vec3> initial_velocity_m_s;
    std::optional<TaylorGreen> taylor_green;  // in its place
    std::optional<Vec3> body_force_n_m3;
};

// --- output -------------------------------------------------------------------------

enum class BodyQuantity { com, speed, shape, max_displacement, fluid_force, energy };
enum class FluidQuantity { kinetic_energy, enstrophy, mass, max_speed, obstacle_force };

struct PointProbe {
    std::string name;
    std::string body;
    Vec3 at_m{};  // in the body's frame, before placement
};

// Over the fluid in a plane across the box, outside obstacles.
struct FluidPlane {
    int axis = 0;  // its normal: 0 x, 1 y, 2 z
    double at_m = 0;
};
// Over the elements of a body whose centre lies in a box of the body's frame.
struct BodyPart {
    std::string body;
    std::optional<std::array<Vec3, 2>> box_m;  // absent: the whole body
};
struct IntegralProbe {
    std::string name;
    std::variant<FluidPlane, BodyPart> over;
};

struct Probes {
    double every_s = 0;
    std::vector<BodyQuantity> bodies;
    std::vector<PointProbe> points;        // by name
    std::vector<IntegralProbe> integrals;  // by name
    std::vector<FluidQuantity> fluid;
    bool interface_balance = false;  // momentum and power given and received, each step
    bool energy_audit = false;       // of all bodies, and the fluid's share
};

enum class FluidField { velocity, density, vorticity };

struct StructureOutput {
    double every_s = 0;
};
struct FluidOutput {
    double every_s = 0;
    std::vector<FluidField> fields;
};
struct Output {
    std::optional<StructureOutput> structure;
    std::optional<FluidOutput> fluid;
};

// retry: go back to the last state kept and on from there with half the steps.
enum class OnDivergence { stop, retry };

// The state of every participant, kept so that a run can go on from it.
struct Checkpoint {
    double every_s = 0;
    OnDivergence on_divergence = OnDivergence::stop;
    int retries = 3;  // in a run, at most

    bool retry() const { return on_divergence == OnDivergence::retry; }
};

struct Scene {
    std::string name;
    Time time;
    std::vector<Body> bodies;  // by name, whatever their order in the file
    std::optional<MagneticField> magnetic_field;
    std::optional<Gravity> gravity;
    std::optional<Damping> damping;
    std::optional<Platform> platform;
    std::optional<Contact> contact;
    std::optional<Fluid> fluid;
    std::optional<Coupling> coupling;  // always there with both bodies and a fluid
    std::optional<Probes> probes;
    Output output;
    std::optional<Checkpoint> checkpoint;

    // Hash of the effective scene (after --set), the same for the same meaning: equal on
    // both sides of a coupled run or the handshake refuses.
    std::uint64_t hash = 0;
};

}  // namespace magfsi::scene
