#include "adapters/bodies/scene_to_body.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <map>
#include <stdexcept>

#include "adapters/bodies/body_mesh.h"
#include "adapters/scene/fault.h"
#include "structure/magnetics/magnetization.h"

namespace magfsi::bodies {

namespace {

using structure::Mesh;
using Vectors = std::vector<structure::Vec3>;

Vectors build(const structure::UniformMagnetization& uniform, const Mesh& mesh) {
    return structure::uniform_magnetization(mesh, uniform.vector_a_m);
}

Vectors build(const structure::HarmonicMagnetization& wave, const Mesh& mesh) {
    structure::HarmonicMagnetization whole = wave;
    if (whole.wavelength_m == 0) whole.wavelength_m = extent(mesh, wave.along);
    return structure::harmonic_magnetization(mesh, whole);
}

Vectors build(const structure::DomainMagnetization& wanted, const Mesh& mesh) {
    return structure::domain_magnetization(mesh, wanted.domains);
}

Vectors build(const structure::RegionMagnetization& wanted, const Mesh& mesh) {
    std::map<std::string, structure::Vec3> vectors;
    for (const std::string& name : mesh.region_names) vectors[name] = {};
    for (const auto& entry : wanted.regions) {
        for (const std::string& region : entry.regions)
            vectors[region] = entry.vector_a_m;
    }
    return structure::region_magnetization(mesh, vectors);
}

Vectors build(const structure::TableMagnetization& table, const Mesh& mesh) {
    return structure::table_magnetization(mesh, table.file);
}

int region_number(const Mesh& mesh, const std::string& name) {
    const auto found = std::ranges::find(mesh.region_names, name);
    if (found != mesh.region_names.end())
        return static_cast<int>(found - mesh.region_names.begin());
    throw scene::Complaint(
        fmt::format("the region {}", scene::in_quotes(name)),
        mesh.region_names.empty()
            ? "none: the mesh has no regions"
            : fmt::format("those of the mesh: {}", fmt::join(mesh.region_names, ", ")),
        scene::did_you_mean(name, mesh.region_names));
}

void add_materials(structure::Body& out, const scene::Body& body) {
    if (body.material_regions.empty()) return;
    std::vector<int> of_region(out.mesh.region_names.size(), 0);
    for (const structure::RegionMaterial& entry : body.material_regions) {
        out.other_materials.push_back(entry.material);
        for (const std::string& name : entry.regions) {
            of_region[static_cast<std::size_t>(region_number(out.mesh, name))] =
                static_cast<int>(out.other_materials.size());
        }
    }
    for (const int region : out.mesh.region)
        out.element_material.push_back(of_region[static_cast<std::size_t>(region)]);
}

}  // namespace

structure::Body to_body(const scene::Body& body) {
    structure::Body out;
    out.name = body.name;
    out.mesh = to_mesh(body);
    out.material = body.material;
    try {
        add_materials(out, body);
    } catch (const scene::Complaint& fault) {
        throw scene::SceneError(
            fmt::format("material_regions of body '{}': {}", body.name, fault.what()));
    }
    out.element = body.element;
    out.clamps = body.clamps;
    out.rollers = body.rollers;
    for (const structure::PrescribedMotion& motion : body.prescribed_motion)
        out.clamps.insert(out.clamps.end(), motion.faces.begin(), motion.faces.end());
    try {
        if (body.magnetization) {
            out.magnetization_a_m =
                std::visit([&](const auto& wanted) { return build(wanted, out.mesh); },
                           *body.magnetization);
        }
    } catch (const std::invalid_argument& fault) {
        throw std::invalid_argument(
            fmt::format("magnetization of body '{}': {}", body.name, fault.what()));
    }
    return out;
}

std::optional<structure::Vec3> to_gravity(const scene::Scene& scene) {
    if (!scene.gravity) return std::nullopt;
    structure::Vec3 g{};
    for (std::size_t d = 0; d < 3; ++d)
        g[d] = scene.gravity->acceleration_m_s2 * scene.gravity->direction[d];
    return g;
}

}  // namespace magfsi::bodies
