#include "adapters/magfsi/explain.h"

#include <fmt/format.h>

#include <cmath>

#include "adapters/bodies/body_mesh.h"
#include "adapters/bodies/marker_placement.h"
#include "adapters/lammps/substeps.h"
#include "coupler/scene/effective.h"
#include "coupler/scene/names.h"

namespace magfsi::launch {

namespace {

std::string join(const std::vector<std::string>& words) {
    return words.empty() ? "none" : fmt::format("{}", fmt::join(words, ", "));
}

std::string explain_body(const scene::Scene& scene, const scene::Body& body) {
    std::string text;
    if (const auto* box = std::get_if<scene::BoxMesh>(&body.mesh)) {
        const auto& n = box->elements;
        text = fmt::format("{} x {} x {} = {} elements", n[0], n[1], n[2],
                           n[0] * n[1] * n[2]);
    } else {
        const structure::Mesh mesh = bodies::to_mesh(body);
        text = fmt::format("{} elements, {} nodes", mesh.elements.size(),
                           mesh.nodes.size());
        if (!mesh.region_names.empty())
            text += fmt::format(", regions {}", join(mesh.region_names));
    }
    text = fmt::format("  body '{}': {}, {}\n", body.name, text,
                       scene::name_of(body.element));
    if (scene.coupling) {
        text += fmt::format(
            "    {} markers\n",
            bodies::place_markers(body, scene.coupling->immersed_boundary,
                                  scene.fluid->spacing_m, 0)
                .size());
    }
    return text;
}

std::string explain_structure(const scene::Scene& scene) {
    const lammps::Substeps s = lammps::choose_substeps(scene);
    std::string text = "\nstructure (LAMMPS, fix magttice)\n";
    for (const scene::Body& body : scene.bodies) text += explain_body(scene, body);
    text +=
        fmt::format("  coupled step {:.4g} us = {} LAMMPS steps of {:.4g} us\n",
                    s.coupled_step_s * 1e6, s.count, s.coupled_step_s / s.count * 1e6);
    text += fmt::format("    stable step of the lattice        {:.4g} us\n",
                        s.elastic_limit_s * 1e6);
    if (s.drag_limit_s > 0) {
        text += fmt::format("    stable step of the fluid's force  {:.4g} us\n",
                            s.drag_limit_s * 1e6);
    }
    return text;
}

std::string explain_fluid(const scene::Scene& scene) {
    const scene::Fluid& fluid = *scene.fluid;
    const double h = fluid.spacing_m;
    const double dt = *scene::coupled_step_s(scene);
    const double tau = 3 * fluid.viscosity_m2_s * dt / (h * h) + 0.5;
    std::array<long, 3> n{};
    for (std::size_t d = 0; d < 3; ++d) n[d] = std::lround(fluid.box_m[d] / h);
    const double cells = static_cast<double>(n[0] * n[1] * n[2]);
    std::string text =
        "\nfluid (lattice-Boltzmann, D3Q19)           SI            lattice\n";
    const auto row = [&](const char* name, const std::string& si, double lattice) {
        text += fmt::format("  {:<34} {:>14} {:>12.5g}\n", name, si, lattice);
    };
    row("spacing", fmt::format("{:.4g} mm", h * 1e3), 1);
    row("time step", fmt::format("{:.4g} us", dt * 1e6), 1);
    row("viscosity", fmt::format("{:.4g} mm2/s", fluid.viscosity_m2_s * 1e6),
        (tau - 0.5) / 3);
    if (fluid.expected_speed_m_s > 0) {
        row("expected speed", fmt::format("{:.4g} m/s", fluid.expected_speed_m_s),
            fluid.expected_speed_m_s * dt / h);
    }
    row("speed of sound", fmt::format("{:.4g} m/s", h / dt / std::sqrt(3.0)),
        1 / std::sqrt(3.0));
    row("relaxation time", "", tau);
    text += fmt::format("  {} x {} x {} = {:.0f} cells, {:.0f} MB of populations\n", n[0],
                        n[1], n[2], cells, cells * 19 * 8 / 1e6);
    return text;
}

}  // namespace

std::string explain(const scene::Scene& scene) {
    std::string text = fmt::format(
        "scene '{}'\n  active, in step order: {}\n  absent: {}\n", scene.name,
        join(scene::active_effects(scene)), join(scene::absent_effects(scene)));
    if (!scene.bodies.empty()) text += explain_structure(scene);
    if (scene.fluid) text += explain_fluid(scene);
    return text;
}

}  // namespace magfsi::launch
