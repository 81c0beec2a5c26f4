// SPDX-License-Identifier: GPL-2.0-or-later
// Texts of the dictionaries and fields of a case. Numbers are printed with 17 digits, so
// that OpenFOAM reads the same doubles.
#include "adapters/solvers/openfoam/case.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <functional>
#include <string>
#include <vector>

#include "adapters/scene/scene.h"
#include "adapters/solvers/openfoam/block_mesh.h"
#include "adapters/solvers/openfoam/inlet.h"
#include "adapters/solvers/openfoam/mesh.h"
#include "adapters/solvers/openfoam/mesh_programs.h"
#include "adapters/solvers/openfoam/user_files.h"
#include "coupler/output/file.h"

namespace magfsi::openfoam {

namespace {

// Dictionary entries of one side of the box: its patch in the mesh, and its conditions
// for velocity and pressure.
struct SideEntries {
    std::string patch, velocity, pressure;
};

// The pressure of OpenFOAM's incompressible solvers is divided by the density [m2/s2].
SideEntries entries_of(const scene::Fluid& fluid, std::size_t number) {
    const fluid::Boundary& side = fluid.boundaries[number];
    switch (side.kind) {
        case fluid::BoundaryKind::periodic:
            return {fmt::format("type cyclic; neighbourPatch {};",
                                scene::names<scene::Face>[number ^ 1]),
                    "type cyclic;", "type cyclic;"};
        case fluid::BoundaryKind::free_slip:
            return {"type symmetryPlane;", "type symmetryPlane;", "type symmetryPlane;"};
        case fluid::BoundaryKind::pressure_outlet:
            return {"type patch;",
                    "type pressureInletOutletVelocity; value uniform (0 0 0);",
                    fmt::format("type fixedValue; value uniform {:.17g};",
                                side.outlet_pressure_pa / fluid.density_kg_m3)};
        case fluid::BoundaryKind::velocity_inlet:  // zero before the first step
            return {"type patch;", "type fixedValue; value uniform (0 0 0);",
                    "type zeroGradient;"};
        default:  // no_slip; to_mesh refuses what OpenFOAM lacks
            break;
    }
    return {"type wall;",
            fmt::format("type fixedValue; value uniform {};",
                        vector_text(side.wall_velocity_m_s)),
            "type zeroGradient;"};
}

// The body force as a stock fvOption. OpenFOAM takes force over mass [m/s2].
std::string body_force(const scene::Fluid& fluid) {
    scene::Vec3 a = *fluid.body_force_n_m3;
    for (double& component : a) component /= fluid.density_kg_m3;
    return fmt::format(
        "bodyForce\n{{\n    type vectorSemiImplicitSource;\n    "
        "selectionMode all;\n    volumeMode specific;\n    "
        "injectionRateSuSp {{ U ({} 0); }}\n}}\n",
        vector_text(a));
}

// Template of controlDict. Times have as many digits as a double, for the step is seldom
// a round number.
constexpr const char* control = R"(
application pimpleFoam;
startFrom startTime;
startTime 0;
stopAt endTime;
endTime {1:.17g};
deltaT {0:.17g};
writeControl timeStep;
writeInterval {2};
writeFormat {3};
writePrecision 12;
timeFormat general;
timePrecision 15;
runTimeModifiable false;
)";

// A function object for stock programs: fields at the end of the run.
constexpr const char* write_last_time = R"(
functions
{
    lastTime
    {
        type writeObjects;
        libs (utilityFunctionObjects);
        objects (U p phi);
        writeControl onEnd;
    }
}
)";

// Schemes of second order in time and space. Central differences are taken because an
// upwind scheme adds numerical viscosity. OpenFOAM's correction of fluxes by their old
// values (ddtPhiCoeff) does so, too; the 0 switches it off: with it a Taylor-Green vortex
// on 24 cells loses 8 % of its energy beyond the exact law in half a turn, without it 0.6
// %.
constexpr const char* schemes = R"(
ddtSchemes { default backward 0; }
gradSchemes { default Gauss linear; }
divSchemes
{
    default none;
    div(phi,U) Gauss linear;
    div((nuEff*dev2(T(grad(U))))) Gauss linear;
}
laplacianSchemes { default Gauss linear orthogonal; }
interpolationSchemes { default linear; }
snGradSchemes { default orthogonal; }
)";

// Where snappyHexMesh has moved points, faces are not normal to the lines between cells:
// gradients along these lines are corrected, the pressure's in one more solution.
constexpr const char* oblique_schemes = R"(
laplacianSchemes { default Gauss linear corrected; }
snGradSchemes { default corrected; }
)";
constexpr const char* oblique_solution = R"(
PIMPLE { nNonOrthogonalCorrectors 1; }
)";

// One outer pass of PISO with two pressure corrections, of second order at small Courant
// numbers. maxIter bounds the time that a diverged step takes; check_divergence reports
// it right after the step.
constexpr const char* solution = R"(
solvers
{
    p
    {
        solver GAMG;
        smoother GaussSeidel;
        tolerance 1e-6;
        relTol 0.05;
        maxIter 100;
    }
    pFinal { $p; relTol 0; }
    U
    {
        solver smoothSolver;
        smoother symGaussSeidel;
        tolerance 1e-8;
        relTol 0;
        maxIter 100;
    }
    UFinal { $U; }
}
PIMPLE
{
    nOuterCorrectors 1;
    nCorrectors 2;
    nNonOrthogonalCorrectors 0;
    pRefCell 0;
    pRefValue 0;
}
)";

// Text of a field file: a uniform interior and the condition at_side(side) for each side,
// and at_obstacle at each obstacle.
template <class AtSide>
std::string field(const scene::Fluid& fluid, const std::string& dimensions,
                  const std::string& inside, const std::string& at_obstacle,
                  AtSide&& at_side) {
    std::string text =
        fmt::format("dimensions {};\ninternalField uniform {};\nboundaryField\n{{\n",
                    dimensions, inside);
    for (std::size_t side = 0; side < 6; ++side) {
        text += fmt::format("    {} {{ {} }}\n", scene::names<scene::Face>[side],
                            at_side(side));
    }
    for (const scene::Obstacle& obstacle : fluid.obstacles)
        text += fmt::format("    {} {{ {} }}\n", patch_name(obstacle), at_obstacle);
    // Patches between ranks are addressed by their type, for their number depends on the
    // ranks.
    for (const char* between : {"processor", "processorCyclic"}) {
        text +=
            fmt::format("    {0} {{ type {0}; value uniform {1}; }}\n", between, inside);
    }
    return text + "}\n";
}

// Writes one file of the case with OpenFOAM's header.
void write_foam_file(const std::filesystem::path& folder, const char* location,
                     const char* name, const char* type, const std::string& text) {
    std::filesystem::create_directories(folder / location);
    output::write_atomically(
        folder / location / name,
        fmt::format("// Every run writes this file anew; entries of your own: "
                    "fluid.openfoam of the scene.\n"
                    "FoamFile {{ version 2.0; format ascii; class {}; location \"{}\"; "
                    "object {}; }}\n{}",
                    type, location, name, text));
}

// Names in system/ of the copies of the user's dictionaries.
constexpr const char* user_schemes = "userSchemes";
constexpr const char* user_solution = "userSolution";
constexpr const char* user_functions = "userFunctions";

// Copies a dictionary of the user's into the case. Returns the line that merges it.
std::string merge(const std::filesystem::path& folder, const char* name,
                  const std::optional<std::string>& text) {
    if (!text) return "";
    std::filesystem::create_directories(folder / "system");
    output::write_atomically(folder / "system" / name, *text);
    return fmt::format("#include \"{}\"\n", name);
}

// The last corrector must not be relaxed, or the step would be incomplete.
constexpr const char* whole_last_corrector = R"(
relaxationFactors
{
    fields { ".*Final" 1; }
    equations { ".*Final" 1; }
}
)";

// Writes the dictionaries of system/ with the user's merged into them.
void write_system(const std::filesystem::path& folder, const scene::Fluid& fluid,
                  const CaseTimes& times, const std::string& more_control) {
    const UserFiles user = read_user_files(fluid);
    const auto format = fluid.openfoam && fluid.openfoam->write
                            ? fluid.openfoam->write->format
                            : scene::FoamFormat::ascii;
    std::string functions = merge(folder, user_functions, user.functions);
    if (user.functions && !user.functions_are_grouped)
        functions = fmt::format("functions\n{{\n    {}}}\n", functions);
    write_foam_file(
        folder, "system", "controlDict", "dictionary",
        fmt::format(fmt::runtime(control), times.step_s, 1.0 * times.steps * times.step_s,
                    times.steps_between_files, scene::name_of(format)) +
            functions + more_control);
    const bool snapped = times.snapped;
    write_foam_file(folder, "system", "fvSchemes", "dictionary",
                    schemes + std::string(snapped ? oblique_schemes : "") +
                        merge(folder, user_schemes, user.schemes));
    write_foam_file(folder, "system", "fvSolution", "dictionary",
                    solution + std::string(snapped ? oblique_solution : "") +
                        merge(folder, user_solution, user.solution) +
                        (user.has_relaxation ? whole_last_corrector : ""));
}

// Writes 0/U, with the condition at_inlet(side) for each inlet.
void write_velocity(const std::filesystem::path& folder, const scene::Fluid& fluid,
                    const std::function<std::string(std::size_t side)>& at_inlet) {
    write_foam_file(
        folder, "0", "U", "volVectorField",
        field(fluid, "[0 1 -1 0 0 0 0]",
              vector_text(fluid.initial_velocity_m_s.value_or(scene::Vec3{})),
              "type fixedValue; value uniform (0 0 0);", [&](std::size_t side) {
                  const auto kind = fluid.boundaries[side].kind;
                  return kind == fluid::BoundaryKind::velocity_inlet
                             ? at_inlet(side)
                             : entries_of(fluid, side).velocity;
              }));
}

void write_block_mesh(const std::filesystem::path& folder, const scene::Fluid& fluid,
                      const BoxMesh& mesh, const ObstaclePlan& plan) {
    write_foam_file(folder, "system", "blockMeshDict", "dictionary",
                    block_mesh(fluid, mesh, plan, [&](std::size_t side) {
                        return entries_of(fluid, side).patch;
                    }));
}

void write_pressure(const std::filesystem::path& folder, const scene::Fluid& fluid) {
    write_foam_file(
        folder, "0", "p", "volScalarField",
        field(fluid, "[0 2 -2 0 0 0 0]", "0", "type zeroGradient;",
              [&](std::size_t side) { return entries_of(fluid, side).pressure; }));
}

std::filesystem::path folder_of_rank(const std::filesystem::path& folder, int rank) {
    return folder / fmt::format("processor{}", rank);
}

// True for the folder of a time or of a rank, and for what function objects have written.
bool is_result(const std::string& name) {
    return std::isdigit(static_cast<unsigned char>(name.front())) != 0 ||
           name.starts_with("processor") || name == "postProcessing";
}

// Deletes all that the engine reads from a folder used before: a body force or mesh of an
// earlier run, or foreign files, which may contain code (OpenFOAM compiles code in
// dictionaries). Results stay where the run goes on, on as many ranks as before.
void clear_stock_case(const std::filesystem::path& folder, bool goes_on, int ranks) {
    namespace fs = std::filesystem;
    for (const char* part : {"0", "constant", "system"}) fs::remove_all(folder / part);
    if (!fs::exists(folder)) return;
    std::vector<fs::path> results, of_ranks;
    for (const auto& entry : fs::directory_iterator(folder)) {
        const std::string name = entry.path().filename().string();
        if (is_result(name)) results.push_back(entry.path());
        if (name.starts_with("processor")) of_ranks.push_back(entry.path());
    }
    const bool same_ranks = of_ranks.size() == (ranks > 1 ? std::size_t(ranks) : 0);
    for (const fs::path& path : !goes_on     ? results
                                : same_ranks ? std::vector<fs::path>()
                                             : of_ranks)
        fs::remove_all(path);
    for (const fs::path& path : of_ranks)  // those that are left
        for (const char* part : {"0", "constant", "system"}) fs::remove_all(path / part);
}

}  // namespace

bool has_own_files(const scene::Fluid& fluid) {
    return fluid.openfoam && (fluid.openfoam->write || fluid.openfoam->functions);
}

// The end time and the intervals matter only to stock programs.
void write_case(const std::filesystem::path& folder, const scene::Fluid& fluid,
                const CaseTimes& times, int ranks) {
    const bool parts = has_own_files(fluid) && ranks > 1;
    clear_stock_case(folder, times.goes_on, parts ? ranks : 1);
    write_system(folder, fluid, times, "");
    write_foam_file(
        folder, "constant", "transportProperties", "dictionary",
        fmt::format("transportModel Newtonian;\nnu {:.17g};\n", fluid.viscosity_m2_s));
    write_foam_file(folder, "constant", "turbulenceProperties", "dictionary",
                    "simulationType laminar;\n");
    std::vector<std::filesystem::path> folders{folder};
    for (int rank = 0; parts && rank < ranks; ++rank)
        folders.push_back(folder_of_rank(folder, rank));
    for (const auto& one : folders) {
        write_velocity(one, fluid, [&](std::size_t side) {
            return entries_of(fluid, side).velocity;
        });
        write_pressure(one, fluid);
    }
}

// The dictionaries of the mesh come first, for its programs read them.
void make_obstacle_mesh(const std::filesystem::path& folder, const scene::Fluid& fluid,
                        const BoxMesh& mesh, const ObstaclePlan& plan) {
    write_block_mesh(folder, fluid, mesh, plan);
    if (!plan.snapped.empty())
        write_foam_file(folder, "system", "snappyHexMeshDict", "dictionary",
                        snappy_dict(folder, fluid, plan));
    make_mesh_files(folder, plan);
}

// The file 0/U is written again, with the inlets' expressions in place of zero velocity,
// and controlDict where the last step is none of those that have a time folder.
void complete_case(const std::filesystem::path& folder, const scene::Fluid& fluid,
                   const CaseTimes& times, const BoxMesh& mesh) {
    if (times.steps % times.steps_between_files != 0)
        write_system(folder, fluid, times, write_last_time);
    if (fluid.obstacles.empty()) write_block_mesh(folder, fluid, mesh, {});
    if (fluid.body_force_n_m3)
        write_foam_file(folder, "constant", "fvOptions", "dictionary", body_force(fluid));
    write_velocity(folder, fluid, [&](std::size_t side) {
        return inlet_condition(fluid, mesh, static_cast<int>(side));
    });
}

}  // namespace magfsi::openfoam
