// SPDX-License-Identifier: GPL-2.0-or-later
// Checks of controllers, equilibria, gravity, platform, contact and coupling.
#include "adapters/scene/checks.h"
#include "adapters/scene/effective.h"
#include "base/fitted/constants.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace magfsi::scene {

namespace {

// The controller replaces the law of the field, which must hold until its first call;
// calls are made at probe rows.
void check_control(const Scene& scene, const Marks& marks) {
    const Control& control = *scene.control;
    require_with(scene.magnetic_field && scene.magnetic_field->uniform,
                 marks.key({"control"}), "control", "a magnetic field with a law",
                 "add magnetic_field: what the field is before the first call");
    require(!scene.time.equilibrium, marks.key({"control"}),
            "control of a path of equilibria", "it in runs with motion only",
            "remove this key, or time.equilibrium");
    check_script(control.script, marks.value({"control", "script"}));
    require_with(control.probes.empty() || scene.probes, marks.key({"control", "probes"}),
                 "control.probes", "probes", "add probes: it names what a run measures");
    if (!scene.probes) return;
    const double rows = control.every_s / scene.probes->every_s;
    require(std::round(rows) >= 1 && std::abs(rows - std::round(rows)) < 1e-6 * rows,
            marks.value({"control", "every"}),
            fmt::format("{} between two calls", seconds(control.every_s)),
            fmt::format("a whole number of times probes.every, {}",
                        seconds(scene.probes->every_s)));
}

// Refuses a step, and what Newton's method does not support: friction, contact and
// dipoles. The other method does not support prescribed motions.
void check_equilibrium(const Scene& scene, const Marks& marks) {
    require(!scene.time.step_s, marks.key({"time", "step"}),
            "a step in a scene of equilibria", "time.step for motion",
            "the points of the path are the probe rows");
    if (scene.time.equilibrium->method != EquilibriumMethod::newton) return;
    const bool moved = std::ranges::any_of(
        scene.bodies, [](const Body& body) { return !body.prescribed_motion.empty(); });
    const char* const remedy = moved
                                   ? "remove this key: only newton has prescribed_motion"
                                   : "take time.equilibrium.method: dynamics";
    const auto without = [&](bool present, Path key, const char* what) {
        require(!present, marks.key(key),
                fmt::format("{} with the equilibrium method newton", what),
                "it with the method dynamics", remedy);
    };
    without(scene.platform && scene.platform->friction > 0, {"platform", "friction"},
            "friction");
    without(scene.contact.has_value(), {"contact"}, "contact");
    without(scene.dipoles.has_value(), {"dipoles"}, "dipoles");
}

// Limit of the strength in the implicit scheme, 2. Beside a body at rest, a velocity that
// alternates from step to step decays for strengths below 1/4 divided by the fraction by
// which the scheme pulls it back. Above, each step converges, yet the run gains energy.
constexpr double max_implicit_strength = 1 / (4 * fitted::drawn_back_penalty);

// Refuses forcing: no_slip where it was asked for and cannot be. The default avoids this
// (usual_forcing).
void check_no_slip(const Scene& scene, const Marks& marks) {
    if (scene.coupling->immersed_boundary.forcing != coupler::Forcing::no_slip) return;
    const auto objection = objection_to_no_slip(scene);
    if (!objection) return;
    refuse(marks.value({"coupling", "immersed_boundary", objection->key}),
           objection->found, objection->allowed, objection->suggestion);
}

// The default avoids this (usual_scheme).
void check_scheme(const Scene& scene, const Marks& marks) {
    if (scene.coupling->scheme != Scheme::serial) return;
    require(
        !holds_openfoam(scene), marks.value({"coupling", "scheme"}),
        "serial with forcing: no_slip in OpenFOAM, where the pressure answers a force "
        "within the step",
        "implicit there", "write implicit, or remove this key");
    const Body* light = light_in_contact(scene);
    if (!light) return;
    refuse(marks.value({"coupling", "scheme"}),
           fmt::format("serial with contact of {}, of {:.3g} times the fluid's density, "
                       "which would rattle",
                       in_quotes(light->name), lightest_ratio(scene, *light)),
           fmt::format("implicit, or densities from {:g} times the fluid's on",
                       fitted::least_serial_contact_ratio),
           "write implicit, or remove this key");
}

void check_coupling(const Coupling& coupling, const Marks& marks) {
    const Scheme scheme = coupling.scheme;
    const auto& boundary = coupling.immersed_boundary;
    require(!coupling.iteration || scheme == Scheme::implicit,
            marks.key({"coupling", "iteration"}), "iteration in the serial scheme",
            "it in the implicit scheme only", "add scheme: implicit or remove this key");
    require(scheme != Scheme::implicit || boundary.strength <= max_implicit_strength,
            marks.value({"coupling", "immersed_boundary", "strength"}),
            fmt::format("strength {} in the implicit scheme", boundary.strength),
            fmt::format("at most {} there", max_implicit_strength),
            "take a smaller one, or coupling.scheme: serial");
}

// Requires two magnetised bodies, or one if its dipoles act on the body itself.
void check_dipoles(const Scene& scene, const Marks& marks) {
    const auto magnets = std::ranges::count_if(
        scene.bodies, [](const Body& b) { return b.magnetization.has_value(); });
    const bool within = scene.dipoles->within_bodies;
    require(magnets >= (within ? 1 : 2), marks.key({"dipoles"}),
            fmt::format("dipoles with {} magnetized bodies", magnets),
            within ? "them with at least one" : "them with at least two",
            magnets == 0 ? "add a magnetization or remove this key"
                         : "add a magnetization, or dipoles.within_bodies: true");
}

// --- the platform: one that no body can touch is a slip ----------------------------

// Height of a point above the platform along its normal [m].
double height_m(const Platform& platform, const Vec3& at_m) {
    return dot(at_m - platform.point_m, platform.normal);
}

double half_diagonal_m(const Box& box) {
    return 0.5 * norm(box.size_m);
}

// Centre of the block at the start; without a position the body's frame is that of space.
Vec3 centre_m(const Body& body, const Box& box) {
    return body.initial.position_m.value_or(0.5 * box.size_m);
}

// True if something can move a free body's centre of mass towards the platform. A uniform
// field only turns a body.
bool can_travel_towards(const Scene& scene, const Platform& platform) {
    const bool falls = scene.gravity && scene.gravity->acceleration_m_s2 > 0 &&
                       dot(scene.gravity->direction, platform.normal) < 0;
    const bool drawn = scene.magnetic_field && (scene.magnetic_field->gradient ||
                                                !scene.magnetic_field->sources.empty());
    return falls || drawn || scene.fluid || scene.contact || scene.dipoles;
}

// Largest distance from its centre that a body which cannot travel may reach, for a
// stretch to twice its length. A held body may swing to the other side of its support.
double reach_m(const Body& body, const Box& box) {
    const bool held = !body.clamps.empty() || !body.rollers.empty();
    return (held ? 4 : 2) * half_diagonal_m(box);
}

// True if the body surely never touches the platform: a clamped one by its reach, a free
// one if nothing drives it there.
bool out_of_reach(const Scene& scene, const Body& body) {
    const auto* box = std::get_if<Box>(&body.mesh);
    if (!box) return false;  // only the mesh knows its extent
    if (body.clamps.empty() && can_travel_towards(scene, *scene.platform)) return false;
    return height_m(*scene.platform, centre_m(body, *box)) > reach_m(body, *box);
}

// A body that starts wholly behind the platform shows a mistake in its normal or point.
void check_not_behind(const Scene& scene, const Marks& marks) {
    for (const Body& body : scene.bodies) {
        const auto* box = std::get_if<Box>(&body.mesh);
        if (!box) continue;
        const double height = height_m(*scene.platform, centre_m(body, *box));
        require(height > -half_diagonal_m(*box), marks.key({"platform"}),
                fmt::format("a platform with \"{}\" {} behind it", body.name,
                            metres(-height)),
                "bodies on the side that its normal points to",
                "turn platform.normal around, or move the body or platform.point");
    }
}

// Bodies stay in the fluid's box, so a platform outside it cannot be touched.
void check_in_box(const Scene& scene, const Marks& marks) {
    if (!scene.fluid) return;
    const Vec3& box = scene.fluid->box_m;
    double lowest = height_m(*scene.platform, {});
    for (int i = 0; i < 3; ++i)
        lowest += std::min(0.0, scene.platform->normal[i] * box[i]);
    require(lowest <= 0, marks.key({"platform"}), "a platform outside the fluid box",
            "one that a body in the box can touch",
            "move platform.point into the box or remove the key");
}

void check_platform(const Scene& scene, const Marks& marks) {
    require(scene.platform->normal != Vec3{}, marks.value({"platform", "normal"}),
            "a normal of length 0", "any other vector such as [0, 0, 1]");
    check_not_behind(scene, marks);
    check_in_box(scene, marks);
    // Gravity brings free bodies only, and does not where it is there already.
    const bool may_fall =
        !scene.gravity && std::ranges::any_of(scene.bodies, [](const Body& body) {
            return body.clamps.empty();
        });
    require(!std::ranges::all_of(scene.bodies,
                                 [&](const Body& b) { return out_of_reach(scene, b); }),
            marks.key({"platform"}), "a platform that no body can touch",
            "one within reach of a body, or bodies that gravity or a field gradient "
            "brings to it",
            may_fall ? "move platform.point, add gravity towards it, or remove the key"
                     : "move platform.point, or remove the key");
}

// Refuses options that a structure of the user's own cannot follow.
void check_own_structure(const Scene& scene, const Marks& marks) {
    require(scene.bodies.empty(), marks.value({"coupling", "structure"}),
            "structure: own beside bodies", "one of the two",
            "remove the key \"bodies\" or this one");
    require(scene.coupling->immersed_boundary.forcing == coupler::Forcing::penalty,
            marks.value({"coupling", "immersed_boundary", "forcing"}),
            "forcing: no_slip of a structure of your own", "penalty there",
            "remove the key");
    require(!scene.checkpoint, marks.key({"checkpoint"}),
            "checkpoints of a structure of your own", "runs without them",
            "remove the key");
    require(!scene.probes || !scene.probes->interface_balance,
            marks.value({"probes", "interface_balance"}),
            "the balance of a structure of your own", "it with bodies", "remove the key");
}

// A start in equilibrium is Newton's: it knows bodies one by one, without a fluid.
void check_start(const Scene& scene, const Marks& marks) {
    if (scene.time.start != RunStart::equilibrium) return;
    const Origin& here = marks.value({"time", "start"});
    const auto without = [&](bool present, const char* what) {
        require(!present, here, fmt::format("start: equilibrium {}", what),
                "it for bodies without fluid, contact and dipoles, in runs over time",
                "take start: placed");
    };
    without(scene.time.equilibrium.has_value(), "on a path of equilibria");
    without(scene.fluid.has_value(), "in a fluid");
    without(scene.contact.has_value(), "with contact");
    without(scene.dipoles.has_value(), "with dipoles");
    without(scene.bodies.empty(), "without bodies");
}

}  // namespace

std::optional<NoSlipObjection> objection_to_no_slip(const Scene& scene) {
    const ImmersedBoundary& boundary = scene.coupling->immersed_boundary;
    const auto beside = [](const char* key, const char* allowed) {
        return NoSlipObjection{key, fmt::format("{} with forcing: no_slip", key), allowed,
                               "remove this key or take forcing: penalty"};
    };
    if (boundary.kernel == Kernel::four_point)
        return beside("kernel",
                      "2-point or 3-point: the depth of a 4-point kernel's rim is "
                      "not known");
    if (boundary.strength > 1)
        return beside("strength", "at most 1, which removes a uniform slip in one step");
    return {};
}

// Loads need bodies, equilibria exclude a fluid, and a coupling needs both sides.
void check_loads(const Scene& scene, const Marks& marks) {
    const auto with_bodies = [&](bool present, const char* key) {
        require_with(!present || !scene.bodies.empty(), marks.key({key}), key, "bodies",
                     "add the key \"bodies\" or remove this one");
        return present;
    };
    if (scene.magnetic_field) check_magnetic_field(scene, marks);
    if (scene.dipoles) check_dipoles(scene, marks);
    if (scene.control) check_control(scene, marks);
    if (with_bodies(scene.gravity.has_value(), "gravity"))
        require(scene.gravity->direction != Vec3{}, marks.value({"gravity", "direction"}),
                "a direction of length 0", "any other vector such as [0, 0, -1]");
    with_bodies(scene.damping.has_value(), "damping");
    if (with_bodies(scene.platform.has_value(), "platform")) check_platform(scene, marks);
    with_bodies(scene.contact.has_value(), "contact");
    check_start(scene, marks);
    const bool equilibrium = scene.time.equilibrium.has_value();
    require(!equilibrium || !scene.fluid, marks.key({"time", "equilibrium"}),
            "an equilibrium in a scene with a fluid", "it without a fluid",
            "remove the key \"fluid\" (fluid= on the command line)");
    if (with_bodies(equilibrium, "time")) check_equilibrium(scene, marks);
    require_with(!scene.coupling || scene.fluid, marks.key({"coupling"}), "coupling",
                 "a fluid", "add the key \"fluid\" or remove this one");
    const bool own = scene.has_own_structure();
    if (own) check_own_structure(scene, marks);
    if (own || with_bodies(scene.coupling.has_value(), "coupling")) {
        check_scheme(scene, marks);
        check_coupling(*scene.coupling, marks);
        check_no_slip(scene, marks);
    }
}

}  // namespace magfsi::scene
