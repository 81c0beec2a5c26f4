// SPDX-License-Identifier: GPL-2.0-or-later
// The scene: what a user asked for, checked and in SI. Plain data; absent effects are
// empty optionals. Filled by reader.h, read by the adapters.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "coupler/options.h"
#include "fluid_lbm/options.h"
#include "structure/lammps/drag_law.h"
#include "structure/options.h"
#include "structure/source_options.h"

namespace magfsi::scene {

using Vec3 = std::array<double, 3>;

// The options that scene and solvers share.
using namespace structure;
using coupler::AccelerationMethod, coupler::ColumnFilter, coupler::Coupling;
using coupler::ImmersedBoundary, coupler::InitialGuess, coupler::Iteration;
using coupler::Kernel, coupler::Markers, coupler::OnNoConvergence,
    coupler::SampledVelocity;
using coupler::Scheme;
using coupler::StructureSide;
using fluid::Block, fluid::Boundary, fluid::BoundaryKind, fluid::Collision;
using fluid::Carreau, fluid::PowerLaw, fluid::Precision, fluid::Rectangle,
    fluid::Rheology;
using fluid::Cylinder, fluid::Disc, fluid::Inlet, fluid::InletCourse;
using fluid::InletFormula, fluid::InletProfile, fluid::InletTable, fluid::InletWave;
using fluid::Obstacle;
using fluid::Sphere, fluid::StlSurface;
using magfsi::name_of;

// The words of an enumeration, in its order.
template <class E>
inline constexpr auto names = words_of(E{});

inline constexpr std::array axis_names = std::to_array<std::string_view>({"x", "y", "z"});
// A plane names its first and its second axis; angles run from the first to the second.
inline constexpr std::array plane_names =
    std::to_array<std::string_view>({"xy", "xz", "yz", "yx", "zx", "zy"});

// Time is then the parameter of a path of loads, and each probe row an equilibrium.
enum class EquilibriumMethod { newton, dynamics };
constexpr auto words_of(EquilibriumMethod) {
    return std::to_array<std::string_view>({"newton", "dynamics"});
}
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

// Sides of the fluid's box, and faces of a block.
enum class Face { x_min, x_max, y_min, y_max, z_min, z_max };
constexpr auto words_of(Face) {
    return std::to_array<std::string_view>(
        {"x_min", "x_max", "y_min", "y_max", "z_min", "z_max"});
}

struct Body {
    std::string name;
    MeshOptions mesh;
    std::string mesh_place;  // in the scene, for faults that only the mesh shows
    ElementVariant element = ElementVariant::assumed_strain;
    Inertia inertia = Inertia::lumped;
    Material material;
    std::vector<RegionMaterial> material_regions;
    std::optional<Magnetization> magnetization;
    std::vector<std::string> clamps;  // faces; of a block x_min to z_max
    std::vector<Roller> rollers;
    std::vector<PrescribedMotion> prescribed_motion;
    Placement initial;
};

// --- loads --------------------------------------------------------------------------

struct MagneticField : FieldProgram {
    bool uniform = false;  // whether there is a law; else `course` means nothing
    std::optional<GradientInput> gradient;
    std::vector<FieldSource> sources;  // by name
};

// A program of the user's that sees probes and sets the field as the run goes on.
struct Control {
    std::string script;               // Python, with a class Controller
    double every_s = 0;               // between two calls
    std::vector<std::string> probes;  // columns of probes.csv, with or without their unit
    double timeout_s = 60;            // longest wait for an answer
    // Of each of the probes in the scene, "file:line:column", for errors; no key.
    std::vector<std::string> probe_places;
};

struct Gravity {
    double acceleration_m_s2 = 0;
    Vec3 direction{0, 0, -1};  // unit vector
};

using Damping = structure::Drag;

// --- fluid --------------------------------------------------------------------------

enum class FluidSolver { lbm, openfoam };
constexpr auto words_of(FluidSolver) {
    return std::to_array<std::string_view>({"lbm", "openfoam"});
}

// Cubic cells in a part of the box, growing ones outside.
struct Grading {
    std::array<Vec3, 2> uniform_m{};  // lower and upper corner of the part
    double growth = 1.1;              // largest ratio of neighbouring cells
};

// A patch of finer cells around the bodies, which it follows, or in a part of the box.
// With every level the spacing and the fluid's step halve; the coupled step is the
// finest's.
struct Refinement {
    int levels = 1;
    std::optional<double> margin_m;  // between the bodies and the patch's sides
    std::optional<std::array<Vec3, 2>> box_m;
};

// One period along each side of a periodic cube of side L, k = 2 pi / L:
// u = U (sin kx cos ky cos kz, -cos kx sin ky cos kz, 0), with its pressure.
struct TaylorGreen {
    double speed_m_s = 0;  // U
};

struct Fluid : fluid::Options {
    Fluid() {
        for (Boundary& side : boundaries) side.kind = BoundaryKind::no_slip;
    }

    FluidSolver solver = FluidSolver::lbm;
    Vec3 box_m{};
    double spacing_m = 0;
    double expected_speed_m_s = 0;   // largest to resolve; 0: not given, time.step is
    double lattice_speed = 0.05;     // that speed in lattice units (Mach limit)
    double courant = 0.2;            // the same for openfoam, which has no such limit
    std::optional<Grading> grading;  // of openfoam
    std::optional<Refinement> refinement;  // of lbm
    std::optional<Vec3> initial_velocity_m_s;
    std::optional<TaylorGreen> taylor_green;  // in its place

    // Of the box along periodic axes, else 0.
    Vec3 period_m() const {
        Vec3 period{};
        for (std::size_t d = 0; d < 3; ++d)
            period[d] = boundaries[2 * d].kind == BoundaryKind::periodic ? box_m[d] : 0;
        return period;
    }
    // Where bodies are.
    double finest_spacing_m() const {
        return std::ldexp(spacing_m, refinement ? -refinement->levels : 0);
    }
    // Coupled steps in one of the whole box.
    int coupled_steps_in_one() const { return refinement ? 1 << refinement->levels : 1; }
};

// --- output -------------------------------------------------------------------------

enum class BodyQuantity {
    com,
    speed,
    shape,
    max_displacement,
    fluid_force,
    fluid_torque,
    reaction_force,
    energy,
    magnetic_load
};
constexpr auto words_of(BodyQuantity) {
    return std::to_array<std::string_view>({"com", "speed", "shape", "max_displacement",
                                            "fluid_force", "fluid_torque",
                                            "reaction_force", "energy", "magnetic_load"});
}
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
    return units[static_cast<std::size_t>(field)];
}

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

// retry: go back to the last state kept and on from there with half the steps.
enum class OnDivergence { stop, retry };
constexpr auto words_of(OnDivergence) {
    return std::to_array<std::string_view>({"stop", "retry"});
}

// The state of every participant, kept so that a run can go on from it.
struct Checkpoint {
    double every_s = 0;
    OnDivergence on_divergence = OnDivergence::stop;
    int max_retries = 3;  // in a run

    bool retry() const { return on_divergence == OnDivergence::retry; }
};

// Which number of a probe's course a tolerance is for.
enum class ProbeNorm { final_, peak, mean, amplitude };
constexpr auto words_of(ProbeNorm) {
    return std::to_array<std::string_view>({"final", "peak", "mean", "amplitude"});
}

// What a run is to be accurate to: magfsi run takes the cheapest setting for it.
struct Accuracy {
    double error = 0;                 // of the largest value of a probe's course
    std::vector<std::string> probes;  // columns; empty: how bodies move, or all
    ProbeNorm norm = ProbeNorm::final_;
    double budget_s = 300;  // for finding it out
};

// Whether magfsi run writes report.html when the run has ended.
enum class PageAtEnd { on, off };
constexpr auto words_of(PageAtEnd) {
    return std::to_array<std::string_view>({"on", "off"});
}

struct Scene {
    std::string name = "scene";
    std::filesystem::path folder;  // of its file; not of the scene itself
    Time time;
    std::vector<Body> bodies;  // by name, whatever their order in the file
    std::optional<MagneticField> magnetic_field;
    std::optional<Control> control;
    std::optional<Gravity> gravity;
    std::optional<Damping> damping;
    std::optional<Platform> platform;
    std::optional<DipoleOptions> dipoles;
    std::optional<ContactLaw> contact;
    std::optional<Fluid> fluid;
    std::optional<Coupling> coupling;  // always there with both bodies and a fluid
    std::optional<Probes> probes;
    Output output;
    PageAtEnd report = PageAtEnd::on;
    std::optional<Checkpoint> checkpoint;
    std::optional<Accuracy> accuracy;  // gone from the scene that is run

    // Hash of the effective scene (after --set), the same for the same meaning: equal on
    // both sides of a coupled run or the handshake refuses.
    std::uint64_t hash = 0;

    // A program of the user's own in the place of bodies.
    bool has_own_structure() const {
        return coupling && coupling->structure == StructureSide::own;
    }
    bool has_structure() const { return !bodies.empty() || has_own_structure(); }
};

}  // namespace magfsi::scene
