#include "adapters/bodies/scene_to_body.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <map>
#include <stdexcept>

#include "adapters/bodies/body_mesh.h"
#include "adapters/scene/fault.h"
#include "adapters/scene/suggestion.h"
#include "structure/magnetics/magnetization.h"
#include "structure/magnetics/magnetization_table.h"

namespace magfsi::bodies {

namespace {

using structure::Mesh;
using Vectors = std::vector<structure::Vec3>;

Vectors build(const scene::UniformMagnetization& uniform, const Mesh& mesh) {
    return structure::uniform_magnetization(mesh, uniform.vector_a_m);
}

Vectors build(const scene::HarmonicMagnetization& wave, const Mesh& mesh) {
    return structure::harmonic_magnetization(
        mesh, {wave.amplitude_a_m,
               wave.wavelength_m > 0 ? wave.wavelength_m : extent(mesh, wave.along),
               wave.phase_rad, wave.along, wave.into});
}

Vectors build(const scene::DomainMagnetization& wanted, const Mesh& mesh) {
    std::vector<structure::Domain> domains;
    for (const auto& d : wanted.domains)
        domains.push_back({d.box_m, d.polygon_xy_m, d.vector_a_m});
    return structure::domain_magnetization(mesh, domains);
}

Vectors build(const scene::RegionMagnetization& wanted, const Mesh& mesh) {
    std::map<std::string, structure::Vec3> vectors;
    for (const std::string& name : mesh.region_names) vectors[name] = {};
    for (const auto& entry : wanted.regions) {
        for (const std::string& region : entry.regions)
            vectors[region] = entry.vector_a_m;
    }
    return structure::region_magnetization(mesh, vectors);
}

Vectors build(const scene::TableMagnetization& table, const Mesh& mesh) {
    return structure::table_magnetization(mesh, table.file);
}

structure::ElementVariant to_element(scene::ElementVariant variant) {
    switch (variant) {
        case scene::ElementVariant::full:
            return structure::ElementVariant::full;
        case scene::ElementVariant::mean_f:
            return structure::ElementVariant::mean_f;
        case scene::ElementVariant::assumed_strain:
            return structure::ElementVariant::assumed_strain;
    }
    throw std::logic_error("an element variant without a name");
}

structure::Material to_material(const scene::Material& material) {
    return {material.shear_modulus_pa, material.lame_lambda_pa, material.density_kg_m3,
            material.viscosity_pa_s.value_or(0)};
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
    for (const scene::RegionMaterial& entry : body.material_regions) {
        out.other_materials.push_back(to_material(entry.material));
        for (const std::string& name : entry.regions) {
            of_region[static_cast<std::size_t>(region_number(out.mesh, name))] =
                static_cast<int>(out.other_materials.size());
        }
    }
    for (const int region : out.mesh.region)
        out.element_material.push_back(of_region[static_cast<std::size_t>(region)]);
}

}  // namespace

structure::Placement to_placement(const scene::InitialState& initial) {
    structure::Placement placement;
    if (initial.relaxed) {
        placement.relaxed = structure::ConstantField{initial.relaxed->magnitude_t,
                                                     initial.relaxed->direction_rad};
    }
    if (initial.rotation) {
        placement.rotation_plane = initial.rotation->plane;
        placement.rotation_rad = initial.rotation->angle_rad;
    }
    placement.position_m = initial.position_m;
    return placement;
}

structure::Body to_body(const scene::Body& body) {
    structure::Body out;
    out.name = body.name;
    out.mesh = to_mesh(body);
    out.material = to_material(body.material);
    try {
        add_materials(out, body);
    } catch (const scene::Complaint& fault) {
        throw scene::SceneError(
            fmt::format("material_regions of body '{}': {}", body.name, fault.what()));
    }
    out.element = to_element(body.element);
    out.clamps = body.clamps;
    for (const scene::Roller& roller : body.rollers) {
        for (const std::string& face : roller.faces)
            out.rollers.push_back({face, roller.axis});
    }
    for (const scene::PrescribedMotion& motion : body.prescribed_motion)
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

structure::FieldProgram to_field(const scene::MagneticField& field) {
    structure::FieldProgram program;
    program.plane = field.plane;
    if (const auto* constant = std::get_if<scene::ConstantField>(&field.course)) {
        program.course =
            structure::ConstantField{constant->magnitude_t, constant->direction_rad};
    } else if (const auto* table = std::get_if<scene::FieldTable>(&field.course)) {
        program.course = structure::FieldTable{table->time_s, table->magnitude_t,
                                               table->direction_rad, table->repeat};
    } else {
        const auto& turning = std::get<scene::RotatingField>(field.course);
        program.course = structure::RotatingField{turning.magnitude_t, turning.start_rad,
                                                  turning.frequency_hz};
    }
    return program;
}

}  // namespace magfsi::bodies
