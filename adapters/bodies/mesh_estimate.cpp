#include "adapters/bodies/mesh_estimate.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <vector>

#include "adapters/bodies/scene_to_body.h"
#include "structure/equilibrium/mesh_error.h"
#include "structure/lammps/field_program.h"
#include "structure/mesh/locate.h"

namespace magfsi::bodies {

namespace {

using structure::Vec3;

// Of the refined mesh: about half a second. Meshes are refined as far as these allow, at
// most twice: where few elements meet a clamp, one refinement does not tell.
constexpr std::size_t most_elements = 6000;
constexpr int samples_of_field = 200;

double length(const Vec3& v) {
    return std::hypot(v[0], v[1], v[2]);
}

struct Loads {
    structure::StaticLoads loads;
    std::string words;
};

Loads loads_of(const scene::Scene& scene, const structure::Body& solid) {
    Loads out;
    if (scene.magnetic_field && !solid.magnetization_a_m.empty()) {
        out.loads.field_t = strongest_field_t(scene);
        if (length(out.loads.field_t) > 0) out.words = "the strongest field";
    }
    const bool held = !solid.clamps.empty() || !solid.rollers.empty();
    if (held && scene.gravity) {
        out.loads.gravity_m_s2 = *to_gravity(scene);
        out.words += out.words.empty() ? "the weight" : " and the weight";
    }
    if (out.words.empty() && held) {
        const Vec3 extent_m = structure::bounds(solid.mesh.nodes).extent_m();
        const auto across = std::ranges::min_element(extent_m) - extent_m.begin();
        out.loads.gravity_m_s2[static_cast<std::size_t>(across)] = 9.81;
        out.words = "a weight across the thickness";
    }
    return out;
}

Vec3 at(const structure::Mesh& mesh, const std::vector<Vec3>& displacement_m,
        const Vec3& point_m) {
    const structure::MaterialPoint place = structure::PointLocator(mesh).nearest(point_m);
    Vec3 out{};
    for (std::size_t a = 0; a < 8; ++a) {
        const Vec3& node = displacement_m[static_cast<std::size_t>(place.node[a])];
        for (std::size_t d = 0; d < 3; ++d) out[d] += place.weight[a] * node[d];
    }
    return out;
}

}  // namespace

Vec3 strongest_field_t(const scene::Scene& scene) {
    Vec3 strongest{};
    for (int i = 0; i <= samples_of_field; ++i) {
        const Vec3 field = structure::field_at(*scene.magnetic_field,
                                               scene.time.end_s * i / samples_of_field);
        if (length(field) > length(strongest)) strongest = field;
    }
    return strongest;
}

std::optional<MeshEstimate> estimate_mesh_error(const scene::Scene& scene,
                                                const scene::Body& body,
                                                const structure::Body& solid) {
    if (8 * solid.mesh.elements.size() > most_elements) return std::nullopt;
    const Loads loads = loads_of(scene, solid);
    if (loads.words.empty()) return std::nullopt;
    structure::Mesh mesh = structure::refined(solid.mesh);
    if (8 * mesh.elements.size() <= most_elements) mesh = structure::refined(mesh);
    structure::Body fine = to_body(body, std::move(mesh));
    fine.element = structure::ElementVariant::assumed_strain;
    std::vector<Vec3> here_m, fine_m;
    try {
        here_m = structure::linear_response(solid, loads.loads);
        fine_m = structure::linear_response(fine, loads.loads);
    } catch (const std::runtime_error&) {
        return std::nullopt;  // not stable without loads: the run will say so
    }
    MeshEstimate out{loads.words, 0, {}};
    const auto largest = std::ranges::max_element(
        fine_m.begin(), fine_m.begin() + static_cast<std::ptrdiff_t>(here_m.size()), {},
        length);
    out.largest = structure::displacement_error(
        here_m[static_cast<std::size_t>(largest - fine_m.begin())], *largest);
    if (!scene.probes) return out;
    for (const scene::PointProbe& point : scene.probes->points) {
        if (point.body != body.name) continue;
        const Vec3 refined_m = at(fine.mesh, fine_m, point.at_m);
        // A point that hardly moves has no error to speak of.
        if (length(refined_m) < 0.01 * length(*largest)) continue;
        out.points.emplace_back(
            point.name,
            structure::displacement_error(at(solid.mesh, here_m, point.at_m), refined_m));
    }
    return out;
}

}  // namespace magfsi::bodies
