// SPDX-License-Identifier: GPL-2.0-or-later
// What no single key can tell: contradictions between keys, geometry, stability limits.
#pragma once

#include <filesystem>
#include <initializer_list>
#include <optional>
#include <string>
#include <string_view>

#include "adapters/scene/document.h"
#include "adapters/scene/quantity.h"
#include "adapters/scene/scene.h"

namespace magfsi::scene {

using Path = std::initializer_list<std::string>;

// Finds the place of a value for an error. A path has the names of keys, and the numbers
// of items in lists, from 0.
class Marks {
  public:
    explicit Marks(const Node& root) : root_(&root) {}

    // The value at the path, or the nearest map around it when the key is absent.
    const Origin& value(Path path) const;
    // The key at the path itself.
    const Origin& key(Path path) const;
    bool has(Path path) const;  // a key there
    // Entry i of the list at the path, or the value itself where it is no such list.
    const Origin& item(Path path, std::size_t i) const;

  private:
    const Node& deepest(Path path) const;
    const Node* root_;
};

// Refuses unless it is fine.
inline void require(bool fine, const Origin& where, std::string_view found,
                    std::string_view allowed, std::string_view suggestion = {}) {
    if (!fine) refuse(where, found, allowed, suggestion);
}

// Refuses a key of the scene without what it needs: "gravity without bodies".
void require_with(bool there, const Origin& where, std::string_view what,
                  std::string_view need, std::string_view suggestion = {});

// Stiffness and viscosity may be said in two ways each: refuses both at once, or half.
void check_materials(const Scene& scene, const Marks& marks);

// Field tables that are in files: their rows become the scene's, before it is checked.
void read_field_files(Scene& scene, const Marks& marks);

// Courses of inlets: rows of files become the scene's; what the fluid calls is made.
void complete_inlets(Scene& scene, const Marks& marks);

// Throws SceneError at the first fault. The scene is complete (wavelengths, coupling).
void check_scene(const Scene& scene, const Marks& marks);

// Refuses what is there but no regular file, or too large to be meant.
void require_regular_file(const std::filesystem::path& file, const Origin& where);

// Why forcing: no_slip cannot be: its markers follow from kernel, spacing and thickness,
// so that what else would move them means nothing; nor do the passes that its memory
// replaces.
struct NoSlipObjection {
    const char* key;  // of coupling.immersed_boundary
    std::string found;
    const char* allowed;
    const char* suggestion;
};
std::optional<NoSlipObjection> objection_to_no_slip(const Scene& scene);

// Its parts, a source file each.
void check_files(const Scene& scene, const Marks& marks);
void check_bodies(const Scene& scene, const Marks& marks);
void check_loads(const Scene& scene, const Marks& marks);
void check_fluid(const Scene& scene, const Marks& marks);
void check_retry(const Scene& scene, const Marks& marks);
void check_magnetic_field(const Scene& scene, const Marks& marks);
void check_script(const std::filesystem::path& file, const Origin& where);

// What check and explain answer for in seconds, on one core.
constexpr double max_elements = 250'000;
constexpr double max_markers = 500'000;
// How many a body of this extent may take: over both faces and the rim of a block, or
// over its volume. 0 without a fluid.
double most_markers(const Scene& scene, const Vec3& extent_m);

// Along this axis the body, of this extent, spans the fluid's box from one periodic side
// to the other, or between walls so that no fluid passes.
bool spans_fluid(const Fluid& fluid, const Body& body, int axis, double extent_m,
                 bool between_walls);
// Refuses a marker spacing that is asked for and above what markers keep, as each element
// carries at least one: longest_edge_m, of the elements along the body's surface.
void require_marker_spacing(const Scene& scene, const Body& body, double longest_edge_m,
                            const Origin& where);

double length(const Vec3& v);
inline std::string metres(double value) {
    return format_si(value, "m");
}
inline std::string seconds(double value) {
    return format_si(value, "s");
}
double largest_speed_m_s(const PrescribedMotion& motion, double end_s);
// The largest size of a formula over the run, of a thousand instants with both ends.
// Refuses one without a value there; what lies in between stops the run.
double largest_size(const Formula& formula, double end_s, const Origin& where);

}  // namespace magfsi::scene
