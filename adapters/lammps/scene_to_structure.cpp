#include "adapters/lammps/scene_to_structure.h"

#include <algorithm>

#include "structure/lattice/stable_step.h"
#include "structure/magnetics/magnetization.h"
#include "structure/mesh/box_mesh.h"

namespace magfsi::lammps {

namespace {

std::vector<structure::Vec3> magnetization(const scene::Magnetization& wanted,
                                           const structure::Mesh& mesh) {
    if (const auto* uniform = std::get_if<scene::UniformMagnetization>(&wanted)) {
        return structure::uniform_magnetization(mesh, uniform->vector_a_m);
    }
    if (const auto* wave = std::get_if<scene::HarmonicMagnetization>(&wanted)) {
        return structure::harmonic_magnetization(
            mesh, {wave->amplitude_a_m, wave->wavelength_m, wave->phase_rad, wave->along,
                   wave->into});
    }
    std::vector<structure::Domain> domains;
    for (const auto& d : std::get<scene::DomainMagnetization>(wanted).domains) {
        domains.push_back({d.box_m, d.polygon_xy_m, d.vector_a_m});
    }
    return structure::domain_magnetization(mesh, domains);
}

std::string face_name(scene::Face face) {
    static const char* const names[] = {"x_min", "x_max", "y_min",
                                        "y_max", "z_min", "z_max"};
    return names[static_cast<std::size_t>(face)];
}

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

}  // namespace

structure::Box to_box(const scene::BoxMesh& mesh) {
    return {mesh.size_m, mesh.elements};
}

structure::Body to_body(const scene::Scene& scene, const scene::Body& body) {
    structure::Body out;
    out.name = body.name;
    out.mesh = structure::box_mesh(to_box(body.mesh));
    // The fluid that fills the solid's own volume moves with it on the fluid's side: its
    // inertia and weight must not be counted twice.
    const double displaced = scene.fluid ? scene.fluid->density_kg_m3 : 0;
    out.material = {body.material.shear_modulus_pa, body.material.lame_lambda_pa,
                    body.material.density_kg_m3 - displaced};
    out.element = body.element == scene::ElementVariant::full
                      ? structure::ElementVariant::full
                      : structure::ElementVariant::mean_f;
    if (body.magnetization)
        out.magnetization_a_m = magnetization(*body.magnetization, out.mesh);
    for (const scene::Face face : body.clamps) out.clamps.push_back(face_name(face));
    return out;
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

structure::LammpsInput to_lammps_input(const scene::Scene& scene, double time_step_s) {
    structure::LammpsInput input;
    for (const scene::Body& body : scene.bodies) {
        input.bodies.push_back(to_body(scene, body));
        input.placements.push_back(to_placement(body.initial));
    }
    if (scene.magnetic_field) input.field = to_field(*scene.magnetic_field);
    if (scene.gravity) {
        structure::Vec3 g{};
        for (std::size_t d = 0; d < 3; ++d) {
            g[d] = scene.gravity->acceleration_m_s2 * scene.gravity->direction[d];
        }
        input.gravity_m_s2 = g;
    }
    if (scene.damping) input.drag_rate_1_s = scene.damping->rate_1_s;
    input.time_step_s = time_step_s;
    return input;
}

double stable_step_s(const scene::Scene& scene) {
    double smallest = 0;
    for (const scene::Body& body : scene.bodies) {
        const double step = structure::stable_step_s(to_body(scene, body));
        smallest = smallest > 0 ? std::min(smallest, step) : step;
    }
    return smallest;
}

}  // namespace magfsi::lammps
