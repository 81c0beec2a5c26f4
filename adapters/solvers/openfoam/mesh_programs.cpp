// SPDX-License-Identifier: GPL-2.0-or-later
#include "adapters/solvers/openfoam/mesh_programs.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <spawn.h>
#include <sys/wait.h>

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <sstream>
#include <stdexcept>

#include "base/surface/stl_file.h"
#include "coupler/output/file.h"

extern char** environ;

namespace magfsi::openfoam {

namespace fs = std::filesystem;

std::string vector_text(const scene::Vec3& v) {
    return fmt::format("({:.17g} {:.17g} {:.17g})", v[0], v[1], v[2]);
}

namespace {

// Ends of a body along an axis. One that ends at a side of the box is made longer, so
// that its end and the side do not lie in one plane.
std::array<double, 2> beyond_sides(const scene::Fluid& fluid, std::size_t axis,
                                   double low, double high) {
    const double h = fluid.spacing_m;
    if (low < 1e-6 * h) low = -2 * h;
    if (high > fluid.box_m[axis] - 1e-6 * h) high = fluid.box_m[axis] + 2 * h;
    return {low, high};
}

// Shapes as snappyHexMesh's geometry, each under the name of its patch.
struct Geometry {
    const fs::path& folder;
    const scene::Fluid& fluid;
    std::string name;

    std::string operator()(const fluid::Sphere& ball) const {
        return fmt::format("{} {{ type searchableSphere; centre {}; radius {:.17g}; }}",
                           name, vector_text(ball.centre_m), ball.diameter_m / 2);
    }
    std::string operator()(const fluid::Cylinder& rod) const {
        const std::size_t axis = rod.axis;
        const double half = rod.length_m.value_or(2 * fluid.box_m[axis]) / 2;
        const double middle = rod.length_m ? rod.centre_m[axis] : fluid.box_m[axis] / 2;
        const auto [low, high] = beyond_sides(fluid, axis, middle - half, middle + half);
        scene::Vec3 first = rod.centre_m, last = rod.centre_m;
        first[axis] = low;
        last[axis] = high;
        return fmt::format(
            "{} {{ type searchableCylinder; point1 {}; point2 {}; radius {:.17g}; }}",
            name, vector_text(first), vector_text(last), rod.diameter_m / 2);
    }
    std::string operator()(const fluid::Block& block) const {
        scene::Vec3 low{}, high{};
        for (std::size_t d = 0; d < 3; ++d) {
            const auto ends = beyond_sides(fluid, d, block.low_m[d], block.high_m[d]);
            low[d] = ends[0];
            high[d] = ends[1];
        }
        return fmt::format("{} {{ type searchableBox; min {}; max {}; }}", name,
                           vector_text(low), vector_text(high));
    }
    // The surface in its place, in metres.
    std::string operator()(const fluid::StlSurface& surface) const {
        std::string text = fmt::format("solid {}\n", name);
        for (const auto& triangle : surface::read_stl(surface.file)) {
            text += "facet normal 0 0 0\nouter loop\n";
            for (const Vec3& corner : triangle) {
                const Vec3 at = surface.shift_m + surface.unit_m * corner;
                text += fmt::format("vertex {:.9g} {:.9g} {:.9g}\n", at[0], at[1], at[2]);
            }
            text += "endloop\nendfacet\n";
        }
        fs::create_directories(folder / "constant" / "triSurface");
        output::write_atomically(folder / "constant" / "triSurface" / (name + ".stl"),
                                 text + fmt::format("endsolid {}\n", name));
        return fmt::format("{0}.stl {{ type triSurfaceMesh; name {0}; }}", name);
    }
};

// No finer cells at surfaces and no layers: the spacing is the scene's. The limits of
// quality are those of OpenFOAM's tutorials, without the ones that are lengths.
constexpr const char* controls = R"(
castellatedMesh true;
snap true;
addLayers false;
geometry
{{
{0}}}
castellatedMeshControls
{{
    maxLocalCells 100000000;
    maxGlobalCells 100000000;
    minRefinementCells 0;
    nCellsBetweenLevels 2;
    features ();
    refinementSurfaces
    {{
{1}    }}
    resolveFeatureAngle 180;
    refinementRegions {{}}
    locationInMesh {2};
    allowFreeStandingZoneFaces true;
}}
snapControls
{{
    nSmoothPatch 3;
    tolerance 2;
    nSolveIter 100;
    nRelaxIter 5;
    nFeatureSnapIter 10;
    implicitFeatureSnap true;
    explicitFeatureSnap false;
    multiRegionFeatureSnap false;
}}
addLayersControls
{{
    relativeSizes true;
    layers {{}}
    expansionRatio 1;
    finalLayerThickness 0.3;
    minThickness 0.1;
    nGrow 0;
    featureAngle 60;
    nRelaxIter 3;
    nSmoothSurfaceNormals 1;
    nSmoothNormals 3;
    nSmoothThickness 10;
    maxFaceThicknessRatio 0.5;
    maxThicknessToMedialRatio 0.3;
    minMedianAxisAngle 90;
    nBufferCellsNoExtrude 0;
    nLayerIter 50;
}}
meshQualityControls
{{
    maxNonOrtho 65;
    maxBoundarySkewness 20;
    maxInternalSkewness 4;
    maxConcave 80;
    minVol {3:.3g};
    minTetQuality 1e-30;
    minArea -1;
    minTwist 0.02;
    minDeterminant 0.001;
    minFaceWeight 0.05;
    minVolRatio 0.01;
    minTriangleTwist -1;
    nSmoothScale 4;
    errorReduction 0.75;
}}
mergeTolerance 1e-6;
)";

std::string text_of(const fs::path& file) {
    std::ostringstream text;
    text << std::ifstream(file).rdbuf();
    return text.str();
}

// What a program said of its fault: from OpenFOAM's mark on, in one line.
std::string fault_in(const std::string& log) {
    std::size_t from = log.find("--> FOAM FATAL");
    if (from == std::string::npos) from = log.size() > 300 ? log.size() - 300 : 0;
    std::string text = log.substr(from, 400);
    std::ranges::replace(text, '\n', ' ');
    return text;
}

// The environment, with / for the present folder.
std::vector<char*> environment_at_root() {
    static std::string root = "PWD=/";
    std::vector<char*> out{root.data()};
    for (char** entry = environ; *entry != nullptr; ++entry)
        if (!std::string_view(*entry).starts_with("PWD=")) out.push_back(*entry);
    out.push_back(nullptr);
    return out;
}

// Runs one of OpenFOAM's programs on the case. It gets the folder as a descriptor and
// runs in /, for OpenFOAM refuses blanks and quotes in paths, that of its own folder
// included, which it takes from the variable PWD.
void run_program(const std::string& name, const fs::path& folder) {
    constexpr int descriptor = 50;
    const std::string log = (folder / ("log." + name)).string();
    fs::remove(log);  // a foreign link, too
    posix_spawn_file_actions_t files{};
    posix_spawn_file_actions_init(&files);
    posix_spawn_file_actions_addopen(&files, descriptor, folder.c_str(),
                                     O_RDONLY | O_DIRECTORY, 0);
    posix_spawn_file_actions_addopen(&files, 0, "/dev/null", O_RDONLY, 0);
    posix_spawn_file_actions_addopen(&files, 1, log.c_str(), O_WRONLY | O_CREAT | O_EXCL,
                                     0644);
    posix_spawn_file_actions_adddup2(&files, 1, 2);
    posix_spawn_file_actions_addchdir_np(&files, "/");
    std::string program = name, option = "-case",
                way = fmt::format("/proc/self/fd/{}", descriptor), over = "-overwrite";
    char* arguments[] = {program.data(), option.data(), way.data(),
                         name == "snappyHexMesh" ? over.data() : nullptr, nullptr};
    setenv("WM_PROJECT_DIR", "/usr/share/openfoam", 0);
    pid_t child = 0;
    const int fault = posix_spawnp(&child, name.c_str(), &files, nullptr, arguments,
                                   environment_at_root().data());
    posix_spawn_file_actions_destroy(&files);
    if (fault != 0)
        throw std::runtime_error(fmt::format(
            "fluid.solver: openfoam: {} cannot be started: {}; obstacles need "
            "Debian's package openfoam",
            name, std::strerror(fault)));
    int status = 0;
    while (waitpid(child, &status, 0) < 0 && errno == EINTR) {
    }
    if (WIFEXITED(status) && WEXITSTATUS(status) == 0) return;
    throw std::runtime_error(fmt::format("fluid.obstacles: {} failed ({}): {}", name, log,
                                         fault_in(text_of(log))));
}

}  // namespace

std::string snappy_dict(const fs::path& folder, const scene::Fluid& fluid,
                        const ObstaclePlan& plan) {
    std::string geometry, surfaces;
    for (const std::size_t i : plan.snapped) {
        const scene::Obstacle& obstacle = fluid.obstacles[i];
        const std::string name = patch_name(obstacle);
        geometry += fmt::format(
            "    {}\n", std::visit(Geometry{folder, fluid, name}, obstacle.shape));
        surfaces += fmt::format(
            "        {} {{ level (0 0); patchInfo {{ type wall; }} }}\n", name);
    }
    const double h = fluid.spacing_m;
    return fmt::format(fmt::runtime(controls), geometry, surfaces,
                       vector_text(point_in_fluid(fluid)), 1e-3 * h * h * h);
}

void make_mesh_files(const fs::path& folder, const ObstaclePlan& plan) {
    run_program("blockMesh", folder);
    if (!plan.snapped.empty()) run_program("snappyHexMesh", folder);
}

}  // namespace magfsi::openfoam
