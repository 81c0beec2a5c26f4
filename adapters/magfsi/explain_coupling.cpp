#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "adapters/lammps/substeps.h"
#include "adapters/magfsi/explain_parts.h"
#include "adapters/scene/keys.h"

namespace magfsi::launch {

namespace {

// Measured (docs/coupling.md): the serial scheme runs down to this density ratio; below
// it the inertia of the enclosed fluid, which it follows late, may have to be implicit.
constexpr double lightest_explicit = 0.01;

struct Densities {
    double least = std::numeric_limits<double>::infinity(), most = 0;
    void add(double density) {
        least = std::min(least, density);
        most = std::max(most, density);
    }
};

// Of the bodies over the fluid's.
Densities density_ratios(const scene::Scene& scene) {
    Densities ratios;
    for (const scene::Body& body : scene.bodies) {
        if (body.material_regions.empty())
            ratios.add(body.material.density_kg_m3 / scene.fluid->density_kg_m3);
        for (const auto& entry : body.material_regions)
            ratios.add(entry.material.density_kg_m3 / scene.fluid->density_kg_m3);
    }
    return ratios;
}

std::string in_words(const coupler::Coupling& coupling) {
    const auto velocity = scene::name_of(*coupling.sampled_velocity);
    switch (coupling.scheme) {
        case coupler::Scheme::serial:
            return fmt::format(
                "structure and fluid take turns; the fluid's velocity is {} over the "
                "substeps",
                velocity);
        case coupler::Scheme::parallel:
            return "structure and fluid work at once; impulses act one step late";
        case coupler::Scheme::implicit:
            break;
    }
    const coupler::Iteration& i = *coupling.iteration;
    return fmt::format(
        "each step is repeated, by {}, until the fluid velocity at the markers stays "
        "within {:.2g} of itself, at most {} times; it is {} over the substeps",
        scene::name_of(i.acceleration), i.velocity_tolerance, i.max_iterations, velocity);
}

std::string cost(const coupler::Coupling& coupling) {
    switch (coupling.scheme) {
        case coupler::Scheme::serial:
            return "one step of each side after the other";
        case coupler::Scheme::parallel:
            return "one step of the slower side, on cores of its own";
        case coupler::Scheme::implicit:
            break;
    }
    return "the structure's step once an iteration (2 to 4 with iqn_ils); the fluid's "
           "step once and the rows that bodies touch again, or, with openings, moving "
           "walls or obstacles, the whole fluid and a copy of it each time";
}

std::string recommended(const scene::Scene& scene, const Densities& ratios) {
    if (ratios.least < lightest_explicit) {
        return fmt::format(
            "implicit: below a density ratio of {:.2g} the serial scheme has not been "
            "seen to be stable",
            lightest_explicit);
    }
    if (scene.coupling->immersed_boundary.strength > 2)
        return "serial: the implicit scheme has diverged at strengths above 2";
    return "serial: stable here; implicit where the inertia of light bodies or the "
           "phase of fast ones is to be followed without its lag of a step";
}

}  // namespace

std::string explain_coupling(const scene::Scene& scene) {
    const coupler::Coupling& coupling = *scene.coupling;
    const Densities ratios = density_ratios(scene);
    const lammps::Substeps s = lammps::choose_substeps(scene);
    std::string text =
        fmt::format("\ncoupling ({})\n  {}\n  cost: {}\n",
                    scene::name_of(coupling.scheme), in_words(coupling), cost(coupling));
    text += fmt::format("  density of the bodies over the fluid's: {:.3g}", ratios.least);
    if (ratios.most > ratios.least) text += fmt::format(" to {:.3g}", ratios.most);
    // 2 over the limit is the rate at which the lightest node takes on the fluid's speed.
    text += fmt::format(
        "; the lightest node follows the fluid at {:.3g} of its slip a coupled step\n",
        2 * s.coupled_step_s / s.drag_limit_s);
    return text + fmt::format("  recommended: {}\n", recommended(scene, ratios));
}

}  // namespace magfsi::launch
