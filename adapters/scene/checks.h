// SPDX-License-Identifier: GPL-2.0-or-later
// Checks of a scene beyond single keys: contradictions between keys, geometry, stability
// limits. All of them throw SceneError at the first fault, with its place in the file.
#pragma once

#include <filesystem>
#include <functional>
#include <initializer_list>
#include <optional>
#include <string>
#include <string_view>

#include "adapters/scene/document.h"
#include "adapters/scene/quantity.h"
#include "adapters/scene/scene.h"

namespace magfsi::scene {

// Names of keys from the root of the scene, and indices of list items (from 0) as text.
using Path = std::initializer_list<std::string>;

// Finds the place in the file of a value or key, for errors.
class Marks {
  public:
    explicit Marks(const Node& root) : root_(&root) {}

    // Place of the value at the path, or of the nearest value around it if the path does
    // not exist.
    const Origin& value(Path path) const;
    // Place of the key at the path.
    const Origin& key(Path path) const;
    // True if the file has the key at the path.
    bool has(Path path) const;
    // Place of item i of the list at the path, or of the value itself if it is no list of
    // that length.
    const Origin& item(Path path, std::size_t i) const;

  private:
    const Node& deepest(Path path) const;
    const Node* root_;
};

// Throws SceneError unless `fine`, with what was found, what is allowed, and a
// suggestion.
inline void require(bool fine, const Origin& where, std::string_view found,
                    std::string_view allowed, std::string_view suggestion = {}) {
    if (!fine) refuse(where, found, allowed, suggestion);
}

// Throws SceneError unless `there`, for a key that needs another: "found gravity without
// bodies; allowed only with bodies".
void require_with(bool there, const Origin& where, std::string_view what,
                  std::string_view need, std::string_view suggestion = {});

// Checks that stiffness and viscosity are each given in one of their two ways, and
// completely.
void check_materials(const Scene& scene, const Marks& marks);

// Reads the tables of the magnetic field that are in CSV files, so that their rows are
// part of the scene and of its hash.
void read_field_files(Scene& scene, const Marks& marks);

// Reads and checks the courses of inlets over time, and makes the functions of time that
// the fluid calls, with their peaks.
void complete_inlets(Scene& scene, const Marks& marks);

// Checks a complete scene, with defaults that depend on other keys filled in.
void check_scene(const Scene& scene, const Marks& marks);

// Refuses folders, pipes and devices, and files above 200 MB. A missing file passes: its
// reader reports it.
void require_regular_file(const std::filesystem::path& file, const Origin& where);

// Reason why a scene cannot have coupling.immersed_boundary.forcing: no_slip.
struct NoSlipObjection {
    const char* key;  // key in coupling.immersed_boundary
    std::string found;
    const char* allowed;
    const char* suggestion;
};
std::optional<NoSlipObjection> objection_to_no_slip(const Scene& scene);

// Parts of check_scene. The first checks the scene's name and the files that it names;
// check_script also checks that the controller's file exists.
void check_files(const Scene& scene, const Marks& marks);
// Meshes, magnetisations, supports and initial placement.
void check_bodies(const Scene& scene, const Marks& marks);
// Rigid parts: their regions, holds and start.
void check_rigid_parts(const Scene& scene, const Marks& marks);
// Field, control, gravity, platform, contact, paths of equilibria, coupling.
void check_loads(const Scene& scene, const Marks& marks);
// Box, spacing, boundaries, refinement, solver; only for a scene with a fluid.
void check_fluid(const Scene& scene, const Marks& marks);
// Length of the coupled step, speeds in cells per step, relaxation time.
void check_step(const Scene& scene, const Marks& marks);
// Scenes whose steps a retry may halve.
void check_retry(const Scene& scene, const Marks& marks);
// Laws, sources and gradient; also called for fields that a controller returns.
void check_magnetic_field(const Scene& scene, const Marks& marks);
void check_script(const std::filesystem::path& file, const Origin& where);

// Largest numbers of elements of a mesh and markers of a body, for which check and
// explain answer within seconds on one core.
constexpr double max_elements = 250'000;
constexpr double max_markers = 500'000;
// Upper bound of the number of markers of a body with this bounding box, over both faces
// and the rim of a block. 0 without a fluid.
double most_markers(const Scene& scene, const Vec3& extent_m);

// True if a body of this extent [m] spans the fluid's box along the axis: from one
// periodic side to the other, or between walls so that no fluid passes.
bool spans_fluid(const Fluid& fluid, const Body& body, int axis, double extent_m,
                 bool between_walls);

inline std::string metres(double value) {
    return format_si(value, "m");
}
inline std::string seconds(double value) {
    return format_si(value, "s");
}
// Largest speed [m/s] of a body's prescribed motion within the run.
double largest_speed_m_s(const Body& body, const MotionCourse& course, double end_s);
// Checks that the axis of a prescribed motion has a direction and that its formulas have
// values at all times of the run. The marks give the place of a key by its kind of course
// and its name.
using CourseMarks = std::function<const Origin&(const char* kind, const char* name)>;
void check_course(const MotionCourse& course, double end_s, const CourseMarks& at);
// Largest magnitude of a formula over the run, sampled at 1001 instants including both
// ends. Refuses a formula without a finite value at one of them; a fault in between stops
// the run when it is met.
double largest_size(const Formula& formula, double end_s, const Origin& where);

}  // namespace magfsi::scene
