#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "adapters/bodies/body_mesh.h"
#include "adapters/bodies/fluid_inside.h"
#include "adapters/bodies/marker_placement.h"
#include "adapters/bodies/scene_to_body.h"
#include "adapters/lammps/substeps.h"
#include "adapters/magfsi/explain_parts.h"
#include "adapters/scene/effective.h"
#include "adapters/scene/keys.h"
#include "structure/lattice/element_advice.h"

namespace magfsi::launch {

namespace {

// Of the block's bricks; thickness: the body's shortest side.
std::string explain_elements(const structure::Body& solid, const structure::Box& box) {
    structure::Vec3 edges{};
    for (std::size_t d = 0; d < 3; ++d) edges[d] = box.size_m[d] / box.elements[d];
    const auto axis = std::ranges::min_element(box.size_m) - box.size_m.begin();
    const structure::ElementAdvice advice = structure::element_advice(
        solid.element, edges, static_cast<int>(axis), box.elements[axis], solid.material);
    const auto percent = [](double error) {
        // An error of rounding is none.
        return fmt::format("{:+.3g} %", std::abs(error) < 5e-5 ? 0.0 : 100 * error);
    };
    std::string text = fmt::format(
        "    stiffness of the mesh against the exact plate: bending {}, twist {}, dome "
        "{}, "
        "saddle {}\n",
        percent(advice.bending_error), percent(advice.twist_error),
        percent(advice.dome_error), percent(advice.saddle_error));
    if (!advice.text.empty()) text += fmt::format("    warning: {}\n", advice.text);
    return text;
}

// Of the fluid that the grid has inside the body.
std::string explain_inertia(const scene::Scene& scene, const structure::Body& solid) {
    const double off = bodies::off_nodes_kg_m3(scene, solid);
    const double fluid = scene.fluid->density_kg_m3;
    if (off == fluid) return "    inertia of the fluid inside: off the nodes' mass\n";
    if (off == 0)
        return "    inertia of the fluid inside: a force that follows the fluid\n";
    return fmt::format(
        "    inertia of the fluid inside: {:.3g} % off the nodes' mass, the rest a force "
        "that follows the fluid\n",
        100 * off / fluid);
}

std::string explain_body(const scene::Scene& scene, const scene::Body& body) {
    const structure::Body solid = bodies::to_body(body);
    std::string text = fmt::format("  body '{}': ", body.name);
    const auto* box = std::get_if<structure::Box>(&body.mesh);
    if (box) {
        const auto& n = box->elements;
        text += fmt::format("{} x {} x {} = ", n[0], n[1], n[2]);
    }
    text += fmt::format("{} elements {}, {} nodes\n", solid.mesh.elements.size(),
                        scene::name_of(body.element), solid.mesh.nodes.size());
    if (!solid.mesh.region_names.empty()) {
        text +=
            fmt::format("    regions: {}\n", fmt::join(solid.mesh.region_names, ", "));
    }
    for (const auto& entry : body.material_regions) {
        text +=
            fmt::format("    {}: G {:.4g} Pa, lambda {:.4g} Pa, density {:.4g} kg/m3\n",
                        fmt::join(entry.regions, ", "), entry.material.shear_modulus_pa,
                        entry.material.lame_lambda_pa, entry.material.density_kg_m3);
    }
    if (box) text += explain_elements(solid, *box);
    if (scene.coupling) {
        text += explain_inertia(scene, solid);
        text += fmt::format("    {} markers\n",
                            bodies::place_markers(body, scene.coupling->immersed_boundary,
                                                  scene.fluid->spacing_m, 0,
                                                  bodies::spans_fluid(*scene.fluid, body))
                                .size());
    }
    return text;
}

std::string explain_steps(const scene::Scene& scene) {
    const lammps::Substeps s = lammps::choose_substeps(scene);
    std::string text =
        fmt::format("  coupled step {:.4g} us = {} LAMMPS steps of {:.4g} us\n",
                    s.coupled_step_s * 1e6, s.count, s.lammps_step_s * 1e6);
    text += fmt::format("    stable step of the lattice        {:.4g} us\n",
                        s.elastic_limit_s * 1e6);
    if (s.drag_limit_s > 0) {
        text += fmt::format("    stable step of the fluid's force  {:.4g} us\n",
                            s.drag_limit_s * 1e6);
    }
    return text;
}

}  // namespace

std::string explain_structure(const scene::Scene& scene) {
    const bool newton = scene.time.equilibrium && scene.time.equilibrium->method ==
                                                      scene::EquilibriumMethod::newton;
    std::string text = newton ? "\nstructure (Newton's method)\n"
                              : "\nstructure (LAMMPS, fix magttice)\n";
    for (const scene::Body& body : scene.bodies) text += explain_body(scene, body);
    if (!scene.time.equilibrium) return text + explain_steps(scene);
    const double points = scene.time.end_s / scene::path_step_s(scene);
    text += fmt::format("  {:.0f} equilibria along the path of loads\n", points);
    if (!newton) {
        text += fmt::format("  LAMMPS steps of {:.4g} us until at rest\n",
                            lammps::choose_substeps(scene).lammps_step_s * 1e6);
    }
    return text;
}

}  // namespace magfsi::launch
