// SPDX-License-Identifier: GPL-2.0-or-later
#include "adapters/solvers/bodies/mesh_estimate.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>
#include <stdexcept>
#include <vector>

#include "adapters/solvers/bodies/scene_to_body.h"
#include "structure/equilibrium/mesh_error.h"
#include "structure/lammps/field_program.h"
#include "structure/mesh/locate.h"

namespace magfsi::bodies {

namespace {

// Largest number of elements of a mesh that is solved, which takes about half a second.
// Meshes are refined twice where this allows it: where few elements meet a clamp, a
// single refinement shows too little of the error.
constexpr std::size_t most_elements = 6000;
constexpr std::size_t most_refined = most_elements / 8;
constexpr int samples_of_field = 200;

// Loads of the estimate, also in words.
struct Loads {
    structure::StaticLoads loads;
    std::string words;
};

// The strongest field and the weight; for a held body without either a weight along the
// axis of its smallest extent. No words mean no loads.
Loads loads_of(const scene::Scene& scene, const structure::Body& solid) {
    Loads out;
    if (scene.magnetic_field && !solid.magnetization_a_m.empty()) {
        out.loads.field_t = strongest_field_t(scene);
        if (norm(out.loads.field_t) > 0) out.words = "the strongest field";
    }
    const bool held = !solid.clamps.empty() || !solid.rollers.empty();
    if (held && scene.gravity) {
        out.loads.gravity_m_s2 = *to_gravity(scene);
        out.words += out.words.empty() ? "the weight" : " and the weight";
    }
    if (out.words.empty() && held) {
        const Vec3 extent_m = structure::bounds(solid.mesh.nodes).extent_m();
        const auto across = std::ranges::min_element(extent_m) - extent_m.begin();
        out.loads.gravity_m_s2[across] = 9.81;
        out.words = "a weight across the thickness";
    }
    return out;
}

// Displacement at a point of the body, interpolated from the nodes.
Vec3 at(const structure::Mesh& mesh, const std::vector<Vec3>& displacement_m,
        const Vec3& point_m) {
    const structure::MaterialPoint place = structure::PointLocator(mesh).nearest(point_m);
    Vec3 out{};
    for (std::size_t a = 0; a < 8; ++a) {
        out += place.weight[a] * displacement_m[place.node[a]];
    }
    return out;
}

}  // namespace

Vec3 strongest_field_t(const scene::Scene& scene) {
    Vec3 strongest{};
    for (int i = 0; i <= samples_of_field; ++i) {
        const Vec3 field = structure::field_at(*scene.magnetic_field,
                                               scene.time.end_s * i / samples_of_field);
        if (norm(field) > norm(strongest)) strongest = field;
    }
    return strongest;
}

namespace {

// The displacements that the mesh is compared with.
struct Right {
    std::string words;
    // Approximate values at the nodes of the mesh, good enough to find the largest.
    std::vector<Vec3> nodes_m;
    std::function<Vec3(const Vec3& point_m)> at_m;  // at any point of the body
};

// Magnetization of one row for each element of the body's own mesh.
bool has_table(const scene::Body& body) {
    return body.magnetization &&
           std::holds_alternative<structure::TableMagnetization>(*body.magnetization);
}

// The body on a mesh of `refined`, whose elements have the rows of their parents.
structure::Body refined_body(const scene::Body& body, const structure::Body& solid,
                             const structure::Mesh& mesh) {
    if (!has_table(body)) return to_body(body, mesh);
    scene::Body plain = body;
    plain.magnetization.reset();
    structure::Body out = to_body(plain, mesh);
    const std::size_t children = mesh.elements.size() / solid.mesh.elements.size();
    for (std::size_t e = 0; e < mesh.elements.size(); ++e)
        out.magnetization_a_m.push_back(solid.magnetization_a_m[e / children]);
    return out;
}

constexpr auto finer = "finer elements";

// Linear response with elements assumed_strain.
std::vector<Vec3> response_of(structure::Body body, const structure::StaticLoads& loads) {
    body.element = structure::ElementVariant::assumed_strain;
    return structure::linear_response(body, loads);
}

// Response of the mesh refined once, or twice if that is not too large. Refinement keeps
// the mesh's nodes as the first ones.
Right on_refined(const scene::Body& body, const structure::Body& solid,
                 const structure::StaticLoads& loads) {
    structure::Mesh mesh = structure::refined(solid.mesh);
    if (8 * mesh.elements.size() <= most_elements) mesh = structure::refined(mesh);
    const auto fine_m = response_of(refined_body(body, solid, mesh), loads);
    const std::ptrdiff_t nodes = solid.mesh.nodes.size();
    return {finer,
            {fine_m.begin(), fine_m.begin() + nodes},
            [mesh, fine_m](const Vec3& point_m) { return at(mesh, fine_m, point_m); }};
}

// Richardson extrapolation u + (u - v)/3 from the displacements u of a block and v of the
// same block with half as many elements along each axis, for errors that fall with the
// square of the edges.
Right extrapolated(const scene::Body& body, const structure::Body& solid,
                   const structure::StaticLoads& loads) {
    scene::Body half = body;
    auto& box = std::get<structure::Box>(half.mesh);
    for (int& n : box.elements) n = (n + 1) / 2;
    const structure::Body coarse = to_body(half);
    const auto here_m = response_of(solid, loads);
    const auto coarse_m = response_of(coarse, loads);
    const auto right_at = [mesh = solid.mesh, coarse_mesh = coarse.mesh, here_m,
                           coarse_m](const Vec3& point_m) {
        Vec3 out = at(mesh, here_m, point_m);
        out += (out - at(coarse_mesh, coarse_m, point_m)) / 3.0;
        return out;
    };
    return {finer, here_m, right_at};
}

// Response of elements assumed_strain on the same mesh: the difference is the error of
// the body's own element variant, apart from that of the mesh.
Right on_the_same_mesh(const structure::Body& solid,
                       const structure::StaticLoads& loads) {
    const auto right_m = response_of(solid, loads);
    return {"elements assumed_strain on the same mesh, whose own error is not estimated",
            right_m, [mesh = solid.mesh, right_m](const Vec3& point_m) {
                return at(mesh, right_m, point_m);
            }};
}

// A table has no rows for the coarser block.
bool has_coarser(const scene::Body& body) {
    return std::holds_alternative<structure::Box>(body.mesh) && !has_table(body);
}

// The reason why a mesh of so many elements gets no estimate; empty if it gets one.
std::string why_not(const scene::Body& body, std::size_t elements) {
    const bool by_element = body.element != structure::ElementVariant::assumed_strain;
    const std::size_t most =
        has_coarser(body) || by_element ? most_elements : most_refined;
    if (elements <= most) return "";
    return fmt::format(
        "more than {} elements{}: compare with a run on elements half or twice as large",
        most,
        has_coarser(body) ? "" : " that are no block, or have a table of magnetization");
}

Right right_response(const scene::Body& body, const structure::Body& solid,
                     const structure::StaticLoads& loads) {
    if (solid.mesh.elements.size() <= most_refined) return on_refined(body, solid, loads);
    if (has_coarser(body)) return extrapolated(body, solid, loads);
    return on_the_same_mesh(solid, loads);
}

}  // namespace

MeshEstimate estimate_mesh_error(const scene::Scene& scene, const scene::Body& body,
                                 const structure::Body& solid) {
    const Loads loads = loads_of(scene, solid);
    if (loads.words.empty()) return {"nothing bends the body", "", "", 0, {}};
    if (!solid.rigid_parts.empty()) return {"the body has rigid parts", "", "", 0, {}};
    if (const std::string why = why_not(body, solid.mesh.elements.size()); !why.empty())
        return {why, "", "", 0, {}};
    std::optional<Right> right;
    std::vector<Vec3> here_m;
    try {
        right = right_response(body, solid, loads.loads);
        here_m = structure::linear_response(solid, loads.loads);
    } catch (const std::runtime_error&) {
        return {"not stable without loads", "", "", 0, {}};
    }
    MeshEstimate out{"", loads.words, right->words, 0, {}};
    const auto farthest = std::ranges::max_element(
                              right->nodes_m, {}, [](const Vec3& u) { return norm(u); }) -
                          right->nodes_m.begin();
    const std::size_t node = farthest;
    const Vec3 largest_m = right->at_m(solid.mesh.nodes[node]);
    out.largest = structure::displacement_error(here_m[node], largest_m);
    if (!scene.probes) return out;
    for (const scene::PointProbe& point : scene.probes->points) {
        if (point.body != body.name) continue;
        const Vec3 right_m = right->at_m(point.at_m);
        // A point that hardly moves has no error to speak of.
        if (norm(right_m) < 0.01 * norm(largest_m)) continue;
        out.points.emplace_back(
            point.name,
            structure::displacement_error(at(solid.mesh, here_m, point.at_m), right_m));
    }
    return out;
}

}  // namespace magfsi::bodies
