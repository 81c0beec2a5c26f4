// SPDX-License-Identifier: GPL-2.0-or-later
// Checks of rigid parts. Which elements a region has is known only when the mesh is built
// (bodies::to_body).
#include <fmt/format.h>

#include <algorithm>
#include <span>

#include "adapters/scene/checks.h"
#include "adapters/scene/field.h"
#include "structure/mesh/region.h"

namespace magfsi::scene {

namespace {

// Names of the regions that a body of such a mesh has by its keys alone; empty if its
// mesh may have more.
std::vector<std::string> regions_by_keys(const Body& body) {
    if (std::holds_alternative<ObliquePlate>(body.mesh) ||
        std::holds_alternative<MeshFile>(body.mesh) || body.regions.empty())
        return {};
    std::vector<std::string> known;
    for (const NamedRegion& region : body.regions) known.push_back(region.name);
    known.emplace_back(rest_of_mesh);
    return known;
}

void check_names(const Body& body, const Marks& marks) {
    const bool has_own = std::holds_alternative<ObliquePlate>(body.mesh) ||
                         std::holds_alternative<MeshFile>(body.mesh);
    const std::vector<std::string> known = regions_by_keys(body);
    for (std::size_t i = 0; i < body.rigid.size(); ++i) {
        const std::string& name = body.rigid[i];
        const Origin& here = marks.item({"bodies", body.name, "rigid"}, i);
        require(name != "false", here, "false as rigid", "true, or names of regions",
                "leave the key out for a soft body");
        require(name != "true" || body.rigid.size() == 1, here,
                "true beside names of regions", "true alone, or names of regions");
        const auto earlier = std::span(body.rigid).first(i);
        require(std::ranges::find(earlier, name) == earlier.end(), here,
                fmt::format("the region {} twice in rigid", in_quotes(name)),
                "each region once");
        if (name == "true") continue;
        require(has_own || !known.empty(), here,
                fmt::format("the region {} of a mesh without regions", in_quotes(name)),
                "true, or regions of a mesh that has some",
                fmt::format("name parts of it by shapes: bodies.{}.regions", body.name));
        require(known.empty() || std::ranges::find(known, name) != known.end(), here,
                fmt::format("the region {} in rigid", in_quotes(name)), joined(known),
                did_you_mean(name, known));
    }
}

// Nothing else may move or hold a rigid body.
void check_holds(const Body& body, const Marks& marks) {
    const bool whole = body.is_all_rigid();
    const auto without = [&](bool given, const char* name) {
        require(
            !given || !whole, marks.key({"bodies", body.name, name}),
            fmt::format("{} of a rigid body", name), "it for soft faces",
            "hold the body by pivot or hinge, move it by moved, or leave it out of the "
            "scene and take an obstacle");
    };
    without(!body.clamps.empty(), "clamps");
    without(!body.rollers.empty(), "rollers");
    without(!body.prescribed_motion.empty(), "prescribed_motion");
    if (!body.hold) return;
    const bool hinge = std::holds_alternative<Hinge>(*body.hold);
    const char* const name = hinge ? "hinge" : body.moved() ? "moved" : "pivot";
    require(
        body.rigid.size() == 1, marks.key({"bodies", body.name, name}),
        body.moved()
            ? fmt::format("moved for a body with {} rigid parts", body.rigid.size())
            : fmt::format("a {} of a body with {} rigid parts", name, body.rigid.size()),
        "it for a body with one", "add rigid: true, or the name of one region");
    require(!hinge || norm(std::get<Hinge>(*body.hold).axis) > 0,
            marks.value({"bodies", body.name, "hinge", "axis"}), "an axis of length 0",
            "any other vector such as [0, 1, 0]");
}

// A prescribed motion has a course at all times of the run.
void check_moved(const Scene& scene, const Body& body, const Marks& marks) {
    const RigidCourse* moved = body.moved();
    if (!moved) return;
    require(moved->way || moved->turning, marks.key({"bodies", body.name, "moved"}),
            "moved without a motion",
            "oscillation, ramp or formula, or turning, or one of them with it");
    const auto at = [&](const char* kind, const char* name) -> const Origin& {
        return marks.value({"bodies", body.name, "moved", kind, name});
    };
    for (const MotionCourse& course : moved->courses())
        check_course(course, scene.time.end_s, at);
}

// The grid's fluid inside a body starts at rest: it would take a share of the motion.
void check_start(const Body& body, bool in_fluid, const Marks& marks) {
    const Placement& initial = body.initial;
    const auto key = [&](const char* name) -> const Origin& {
        return marks.key({"bodies", body.name, "initial", name});
    };
    require(body.is_all_rigid() || !initial.velocity_m_s, key("velocity"),
            "a velocity of a body that is not rigid", "it with rigid: true");
    require(body.is_all_rigid() || !initial.angular_velocity_rad_s,
            key("angular_velocity"), "an angular velocity of a body that is not rigid",
            "it with rigid: true");
    require(!in_fluid || !initial.velocity_m_s, key("velocity"),
            "a velocity at the start in a fluid, which is at rest then, inside the body, "
            "too",
            "it in scenes without a fluid", "let a force move the body");
    require(!in_fluid || !initial.angular_velocity_rad_s, key("angular_velocity"),
            "an angular velocity at the start in a fluid, which is at rest then, inside "
            "the body, too",
            "it in scenes without a fluid", "let a torque turn the body");
    require(!body.moved() || !initial.velocity_m_s, key("velocity"),
            "a velocity of a body whose motion is prescribed", "it for free bodies");
    require(!body.moved() || !initial.angular_velocity_rad_s, key("angular_velocity"),
            "an angular velocity of a body whose motion is prescribed",
            "it for free bodies, and those on a hinge or a pivot");
    require(!body.hold || !initial.velocity_m_s, key("velocity"),
            "a velocity of a body that is held", "it for free bodies",
            "give its angular_velocity");
    require(body.rigid.empty() || !initial.relaxed, key("relaxed"),
            "relaxed for a body with a rigid part", "it for soft bodies");
}

// Contact and platform derive their stiffness from moduli unless it is given.
void check_moduli(const Scene& scene, const Marks& marks) {
    const bool some = std::ranges::any_of(scene.bodies, [](const Body& body) {
        return body.material.shear_modulus_pa > 0;
    });
    if (some || scene.bodies.empty()) return;
    const auto refuse_without = [&](bool derived, const char* name) {
        require(!derived, marks.key({name}),
                fmt::format("{} of bodies without a shear modulus, from which its "
                            "stiffness follows",
                            name),
                "it with a modulus of one of the bodies",
                fmt::format("give {}.stiffness, or a modulus", name));
    };
    refuse_without(scene.platform && !(scene.platform->stiffness_pa_m > 0), "platform");
    refuse_without(scene.contact && !(scene.contact->stiffness_pa_m > 0), "contact");
}

}  // namespace

void check_rigid_parts(const Scene& scene, const Marks& marks) {
    for (const Body& body : scene.bodies) {
        check_names(body, marks);
        check_holds(body, marks);
        check_moved(scene, body, marks);
        check_start(body, scene.fluid.has_value(), marks);
        require(body.rigid.empty() || !scene.time.equilibrium,
                marks.key({"bodies", body.name, "rigid"}),
                "a rigid part on a path of equilibria", "it in runs over time",
                "remove time.equilibrium, or take a stiff material");
    }
    check_moduli(scene, marks);
}

}  // namespace magfsi::scene
