// SPDX-License-Identifier: GPL-2.0-or-later
// The scene: what the user asked for, checked and in SI units. Plain data; an absent
// effect is an empty optional. reader.h fills it, the adapters read it.
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

#include "adapters/scene/openfoam_files.h"
#include "adapters/scene/scene_output.h"
#include "base/vector/vec3.h"
#include "coupler/options.h"
#include "fluid_lbm/options.h"
#include "structure/lammps/drag_law.h"
#include "structure/options.h"
#include "structure/source_options.h"

namespace magfsi::scene {

using magfsi::Vec3;

// The options that scene and solvers share.
using namespace structure;
using coupler::AccelerationMethod, coupler::Coupling;
using coupler::ImmersedBoundary, coupler::InitialGuess, coupler::Iteration;
using coupler::Kernel, coupler::OnNoConvergence, coupler::SampledVelocity;
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

// Names of the values of an enumeration, in its order.
template <class E>
inline constexpr auto names = words_of(E{});

inline constexpr std::array axis_names = std::to_array<std::string_view>({"x", "y", "z"});
// Planes by their first and second axis; angles are counted from the first towards the
// second.
inline constexpr std::array plane_names =
    std::to_array<std::string_view>({"xy", "xz", "yz", "yx", "zx", "zy"});

// Method for paths of static equilibria. Time is then the parameter of a path of loads,
// and each probe row an equilibrium.
enum class EquilibriumMethod { newton, dynamics };
constexpr auto words_of(EquilibriumMethod) {
    return std::to_array<std::string_view>({"newton", "dynamics"});
}
// Options of a path of equilibria.
struct Equilibrium {
    EquilibriumMethod method = EquilibriumMethod::newton;
    double tolerance = 1e-6;  // largest residual nodal force over the largest load
};

// State at time 0.
// placed: bodies are where `initial` puts them, at rest, and loads set in at once.
// equilibrium: they are in equilibrium with all loads of time 0.
enum class RunStart { placed, equilibrium };
constexpr auto words_of(RunStart) {
    return std::to_array<std::string_view>({"placed", "equilibrium"});
}

// Duration and step of the run.
struct Time {
    double end_s = 0;
    RunStart start = RunStart::placed;
    // Coupled step; without one it follows from the lattice speed or the bodies.
    std::optional<double> step_s;
    std::optional<Equilibrium> equilibrium;
    // Number of times that retries have halved all steps. It is no key of the scene and
    // not part of its hash.
    int halvings = 0;
};

// --- bodies -------------------------------------------------------------------------

// Sides of the fluid's box, and faces of a block-shaped body.
enum class Face { x_min, x_max, y_min, y_max, z_min, z_max };
constexpr auto words_of(Face) {
    return std::to_array<std::string_view>(
        {"x_min", "x_max", "y_min", "y_max", "z_min", "z_max"});
}

// A body, soft but for its rigid parts. Its mesh, regions and magnetisation refer to its
// own frame; `initial` places it. Rollers and prescribed motion are along axes of space.
struct Body {
    std::string name;
    MeshOptions mesh;
    // Places of mesh and rigid in the file, for faults that only the built mesh shows.
    std::string mesh_place, rigid_place;
    std::vector<NamedRegion> regions;  // sorted by name; the first that holds wins
    ElementVariant element = ElementVariant::assumed_strain;
    Inertia inertia = Inertia::lumped;
    Material material;
    std::vector<RegionMaterial> material_regions;
    std::optional<Remanence> magnetization;
    // Names of the clamped faces; of a block x_min to z_max.
    std::vector<std::string> clamps;
    std::vector<Roller> rollers;
    std::vector<PrescribedMotion> prescribed_motion;
    // What does not deform: names of regions, or the one word "true" for the whole body.
    std::vector<std::string> rigid;
    std::optional<RigidHold> hold;  // of its one rigid part
    Placement initial;

    bool is_all_rigid() const { return rigid == std::vector<std::string>{"true"}; }
    // The prescribed motion of the rigid part, else null.
    const RigidCourse* moved() const {
        return hold ? std::get_if<RigidCourse>(&*hold) : nullptr;
    }
};

// --- loads --------------------------------------------------------------------------

// The external field: a uniform law over time with additions, a constant gradient, and
// sources.
struct MagneticField : FieldProgram {
    bool uniform = false;  // false: no law, and `course` is not used
    std::optional<GradientInput> gradient;
    std::vector<FieldSource> sources;  // sorted by name
};

// A Python program of the user that sees probes and sets the field during the run.
struct Control {
    std::string script;               // Python file with a class Controller
    double every_s = 0;               // interval between two calls
    std::vector<std::string> probes;  // columns of probes.csv, unit optional
    double timeout_s = 60;            // longest wait for an answer
    // Place of each entry of `probes` in the file, "file:line:column". It is used in
    // errors and is no key.
    std::vector<std::string> probe_places;
};

// Uniform gravity.
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

// Graded mesh of OpenFOAM: cubic cells in a part of the box, growing ones outside.
struct Grading {
    std::array<Vec3, 2> uniform_m{};  // lower and upper corner of the part
    double growth = 1.1;              // largest ratio of neighbouring cells
};

// Refined grid of the lattice: a patch of finer cells that follows the bodies or stays in
// a part of the box. With every level the spacing and the fluid's step halve; the coupled
// step is that of the finest level.
struct Refinement {
    int levels = 1;
    // Distance between the bodies and the sides of the patch.
    std::optional<double> margin_m;
    // Fixed patch, lower and upper corner.
    std::optional<std::array<Vec3, 2>> box_m;
};

// Initial velocity with one period along each side of a periodic cube of side L, k = 2 pi
// / L: u = U (sin kx cos ky cos kz, -cos kx sin ky cos kz, 0), with its pressure
// (Taylor-Green vortex).
struct TaylorGreen {
    double speed_m_s = 0;  // U
};

// The fluid in its box, with the options of its discretisation.
struct Fluid : fluid::Options {
    Fluid() {
        for (Boundary& side : boundaries) side.kind = BoundaryKind::no_slip;
    }

    FluidSolver solver = FluidSolver::lbm;
    Vec3 box_m{};
    double spacing_m = 0;
    // Largest speed that the step must resolve; 0 if time.step is given instead.
    double expected_speed_m_s = 0;
    double lattice_speed = 0.05;           // expected speed in cells a step (Mach limit)
    double courant = 0.2;                  // expected speed in cells a step, for openfoam
    std::optional<Grading> grading;        // openfoam only
    std::optional<OpenFoam> openfoam;      // openfoam only
    std::optional<Refinement> refinement;  // lbm only
    std::optional<Vec3> initial_velocity_m_s;
    // Alternative to initial_velocity_m_s.
    std::optional<TaylorGreen> taylor_green;

    // Length of the box along periodic axes, 0 along others.
    Vec3 period_m() const {
        Vec3 period{};
        for (std::size_t d = 0; d < 3; ++d)
            period[d] = boundaries[2 * d].kind == BoundaryKind::periodic ? box_m[d] : 0;
        return period;
    }
    // Spacing of the finest level, where the bodies are.
    double finest_spacing_m() const {
        return std::ldexp(spacing_m, refinement ? -refinement->levels : 0);
    }
    // Number of coupled steps in one step of the coarsest level.
    int coupled_steps_in_one() const { return refinement ? 1 << refinement->levels : 1; }
};

// Norm of a probe's time series that a tolerance refers to.
enum class ProbeNorm { final_, peak, mean, amplitude };
constexpr auto words_of(ProbeNorm) {
    return std::to_array<std::string_view>({"final", "peak", "mean", "amplitude"});
}

// Accuracy that a run must have: magfsi run takes the cheapest setting that reaches it.
struct Accuracy {
    // Tolerance relative to the largest magnitude of a probe's time series.
    double error = 0;
    // Columns of probes.csv; if empty those of the bodies' motion, else all.
    std::vector<std::string> probes;
    ProbeNorm norm = ProbeNorm::final_;
    double budget_s = 300;  // time for the search
};

// Switch of the page report.html that magfsi run writes at the end of the run.
enum class PageAtEnd { on, off };
constexpr auto words_of(PageAtEnd) {
    return std::to_array<std::string_view>({"on", "off"});
}

// A whole scene.
struct Scene {
    std::string name = "scene";
    // Folder of the scene file; not a key, not part of the hash.
    std::filesystem::path folder;
    Time time;
    std::vector<Body> bodies;  // sorted by name
    std::optional<MagneticField> magnetic_field;
    std::optional<Control> control;
    std::optional<Gravity> gravity;
    std::optional<Damping> damping;
    std::optional<Platform> platform;
    std::optional<DipoleOptions> dipoles;
    std::optional<ContactLaw> contact;
    std::optional<Fluid> fluid;
    std::optional<Coupling> coupling;  // always set with bodies and a fluid
    std::optional<Probes> probes;
    Output output;
    PageAtEnd report = PageAtEnd::on;
    std::optional<Checkpoint> checkpoint;
    std::optional<Accuracy> accuracy;  // removed from the scene that is run

    // Hash of the effective scene (after --set), equal for scenes of equal meaning. Both
    // sides of a coupled run compare it in their handshake.
    std::uint64_t hash = 0;

    // True if a program of the user's own takes the place of the bodies.
    bool has_own_structure() const {
        return coupling && coupling->structure == StructureSide::own;
    }
    bool has_structure() const { return !bodies.empty() || has_own_structure(); }
};

}  // namespace magfsi::scene
