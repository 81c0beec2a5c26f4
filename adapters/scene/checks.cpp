// SPDX-License-Identifier: GPL-2.0-or-later
// Places in the file (Marks), and checks of outputs, of material constants, and of the
// whole scene.
#include "adapters/scene/checks.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "adapters/scene/effective.h"
#include "adapters/scene/field.h"

namespace magfsi::scene {

namespace {

// Item of a list by its index from 0, or null.
const Node* item_of(const Node& list, const std::string& number) {
    for (std::size_t i = 0; i < list.children.size(); ++i) {
        if (std::to_string(i) == number) return &list.children[i];
    }
    return nullptr;
}

}  // namespace

// The deepest node that exists along the path, so that the fault of a missing key is
// reported at the group that should have it.
const Node& Marks::deepest(Path path) const {
    const Node* node = root_;
    for (const std::string& part : path) {
        const Node* child =
            node->type == Node::Type::sequence ? item_of(*node, part) : node->find(part);
        if (!child) break;
        node = child;
    }
    return *node;
}

const Origin& Marks::value(Path path) const {
    return deepest(path).origin;
}

// A deeper key missing leaves the walk at a node with another name.
bool Marks::has(Path path) const {
    const Node& node = deepest(path);
    return &node != root_ && node.key == *(path.end() - 1);
}

const Origin& Marks::key(Path path) const {
    const Node& node = deepest(path);
    return &node == root_ ? node.origin : node.key_origin;
}

// A single value in place of a list stands for its only item.
const Origin& Marks::item(Path path, std::size_t i) const {
    const Node& node = deepest(path);
    return node.type == Node::Type::sequence && i < node.children.size()
               ? node.children[i].origin
               : node.origin;
}

// Error for a key that means nothing without another one.
void require_with(bool there, const Origin& where, std::string_view what,
                  std::string_view need, std::string_view suggestion) {
    require(there, where, fmt::format("{} without {}", what, need),
            fmt::format("only with {}", need), suggestion);
}

namespace {

// Probes, files and checkpoints are written after whole coupled steps.
void check_interval(const Scene& scene, double every_s, const Origin& where) {
    const double dt_s = coupled_step_s(scene).value_or(0);
    require(every_s >= dt_s * (1 - 1e-9), where,  // admits rounding
            fmt::format("the interval {}", seconds(every_s)),
            fmt::format("at least the coupled step of {}", seconds(dt_s)));
}

// Finds a body or refuses with the most similar name.
const Body& body_named(const Scene& scene, const std::string& name, const Origin& where) {
    const auto body = std::ranges::find(scene.bodies, name, &Body::name);
    if (body != scene.bodies.end()) return *body;
    std::vector<std::string> bodies;
    for (const Body& b : scene.bodies) bodies.push_back(b.name);
    refuse(where, fmt::format("no body {}", in_quotes(name)),
           bodies.empty() ? "scenes with bodies" : joined(bodies),
           did_you_mean(name, bodies));
}

// Only blocks are checked here; for other meshes the point is located when the mesh is
// built.
void check_point(const Scene& scene, const PointProbe& point, const Marks& marks) {
    const Body& body = body_named(scene, point.body,
                                  marks.value({"probes", "points", point.name, "body"}));
    const auto* box = std::get_if<Box>(&body.mesh);
    for (int i = 0; box && i < 3; ++i) {
        const double size = box->size_m[i];
        // The tolerance admits a point on the surface that rounds to just outside.
        require(point.at_m[i] >= -1e-9 * size && point.at_m[i] <= size * (1 + 1e-9),
                marks.value({"probes", "points", point.name, "at"}),
                fmt::format("{} = {} outside the body \"{}\"", axis_names[i],
                            metres(point.at_m[i]), point.body),
                fmt::format("{} from 0 m to {} (the body's own frame)", axis_names[i],
                            metres(size)));
    }
}

// The plane must cut the fluid's box.
void check_plane(const Scene& scene, const std::string& name, const FluidPlane& plane,
                 const Marks& marks) {
    require_with(scene.fluid.has_value(),
                 marks.key({"probes", "integrals", name, "plane"}), "a plane", "a fluid");
    const std::size_t axis = plane.axis;
    const std::string side = metres(scene.fluid->box_m[axis]);
    require(plane.at_m >= 0 && plane.at_m <= scene.fluid->box_m[axis],
            marks.value({"probes", "integrals", name, "plane", "at"}),
            fmt::format("a plane at {} = {}, outside the fluid box", axis_names[axis],
                        metres(plane.at_m)),
            fmt::format("{} from 0 m to {}", axis_names[axis], side));
}

// The body must exist and the box must not be empty.
void check_part(const Scene& scene, const std::string& name, const BodyPart& part,
                const Marks& marks) {
    body_named(scene, part.body,
               marks.value({"probes", "integrals", name, "part", "body"}));
    for (std::size_t d = 0; part.box_m && d < 3; ++d)
        require((*part.box_m)[0][d] < (*part.box_m)[1][d],
                marks.value({"probes", "integrals", name, "part", "box"}),
                fmt::format("a box that is empty along {}", axis_names[d]),
                "[lower corner, upper corner]");
}

// Names of integrals become prefixes of columns, which those of bodies and obstacles are,
// too.
void check_integrals(const Scene& scene, const Marks& marks) {
    for (const IntegralProbe& integral : scene.probes->integrals) {
        const auto taken = [&](const auto& thing) { return thing.name == integral.name; };
        require(std::ranges::none_of(scene.bodies, taken) &&
                    std::ranges::none_of(scene.fluid.value_or(Fluid{}).obstacles, taken),
                marks.key({"probes", "integrals", integral.name}),
                fmt::format("an integral with the name of a body or an obstacle, {}",
                            in_quotes(integral.name)),
                "names of its own, for columns that can be told apart");
        if (const auto* plane = std::get_if<FluidPlane>(&integral.over))
            check_plane(scene, integral.name, *plane, marks);
        else
            check_part(scene, integral.name, std::get<BodyPart>(integral.over), marks);
    }
}

// Every probe needs the effect that it measures.
void check_probes(const Scene& scene, const Marks& marks) {
    if (!scene.probes) return;
    const Probes& probes = *scene.probes;
    check_interval(scene, probes.every_s, marks.value({"probes", "every"}));
    const bool bodies = !scene.bodies.empty(), fluid = scene.fluid.has_value();
    const auto asks = [](const auto& list, auto quantity) {
        return std::ranges::find(list, quantity) != list.end();
    };
    require_with(probes.bodies.empty() || bodies, marks.key({"probes", "bodies"}),
                 "body probes", "bodies");
    require_with(probes.fluid.empty() || fluid, marks.key({"probes", "fluid"}),
                 "fluid probes", "a fluid");
    require_with(!asks(probes.fluid, FluidQuantity::obstacle_force) ||
                     !scene.fluid->obstacles.empty(),
                 marks.value({"probes", "fluid"}), "the probe obstacle_force",
                 "obstacles", "add fluid.obstacles");
    require_with(!asks(probes.bodies, BodyQuantity::fluid_force) || fluid,
                 marks.value({"probes", "bodies"}), "the probe fluid_force", "a fluid");
    require_with(!asks(probes.bodies, BodyQuantity::fluid_torque) || fluid,
                 marks.value({"probes", "bodies"}), "the probe fluid_torque", "a fluid");
    const bool held = std::ranges::any_of(scene.bodies, [](const Body& body) {
        return !body.clamps.empty() || !body.rollers.empty() ||
               !body.prescribed_motion.empty();
    });
    require_with(!asks(probes.bodies, BodyQuantity::reaction_force) || held,
                 marks.value({"probes", "bodies"}), "the probe reaction_force",
                 "a face that is held or moved", "add clamps to a body");
    require_with(
        !asks(probes.bodies, BodyQuantity::magnetic_load) || scene.magnetic_field,
        marks.value({"probes", "bodies"}), "the probe magnetic_load", "a magnetic_field");
    require_with(!asks(probes.bodies, BodyQuantity::contact_load) || scene.platform ||
                     scene.contact,
                 marks.value({"probes", "bodies"}), "the probe contact_load",
                 "contact or platform");
    require(!asks(probes.bodies, BodyQuantity::contact_load) || !scene.time.equilibrium,
            marks.value({"probes", "bodies"}), "contact_load of a path of equilibria",
            "it in runs over time");
    const bool rigid = std::ranges::any_of(
        scene.bodies, [](const Body& body) { return !body.rigid.empty(); });
    require_with(!asks(probes.bodies, BodyQuantity::rigid_motion) || rigid,
                 marks.value({"probes", "bodies"}), "the probe rigid_motion",
                 "a rigid part", "add rigid to a body");
    const bool on_part = std::ranges::any_of(probes.integrals, [](const auto& one) {
        return std::holds_alternative<BodyPart>(one.over);
    });
    require_with(
        !probes.mean_forces ||
            (fluid && (on_part || asks(probes.bodies, BodyQuantity::fluid_force))),
        marks.value({"probes", "mean_forces"}), "mean_forces",
        "the probe fluid_force or a part of a body, in a fluid",
        "add fluid_force to probes.bodies");
    require_with(!probes.interface_balance || scene.coupling,
                 marks.value({"probes", "interface_balance"}), "interface_balance",
                 "bodies in a fluid");
    const Origin& audit = marks.value({"probes", "energy_audit"});
    require_with(!probes.energy_audit || bodies, audit, "energy_audit", "bodies");
    require(!probes.energy_audit || !scene.time.equilibrium, audit,
            "energy_audit of a path of equilibria", "it in runs with motion only",
            "remove this key, or time.equilibrium");
    for (const PointProbe& point : probes.points) check_point(scene, point, marks);
    check_integrals(scene, marks);
}

// Paths of equilibria have no history, so that a checkpoint of them would be of no use.
void check_checkpoint(const Scene& scene, const Marks& marks) {
    if (!scene.checkpoint) return;
    require(!scene.time.equilibrium, marks.key({"checkpoint"}),
            "a checkpoint of a path of equilibria", "it in runs with motion only",
            "take the key away: a path starts anew at once from any of its points");
    check_interval(scene, scene.checkpoint->every_s,
                   marks.value({"checkpoint", "every"}));
    if (scene.checkpoint->retry()) check_retry(scene, marks);
}

// Files of a side need that side; the field `obstacle` needs obstacles.
void check_output(const Scene& scene, const Marks& marks) {
    if (scene.output.structure) {
        require_with(!scene.bodies.empty(), marks.key({"output", "structure"}),
                     "structure output", "bodies");
        check_interval(scene, scene.output.structure->every_s,
                       marks.value({"output", "structure", "every"}));
    }
    if (scene.output.fluid) {
        require_with(scene.fluid.has_value(), marks.key({"output", "fluid"}),
                     "fluid output", "a fluid");
        check_interval(scene, scene.output.fluid->every_s,
                       marks.value({"output", "fluid", "every"}));
        const auto& fields = scene.output.fluid->fields;
        require_with(std::ranges::find(fields, FluidField::obstacle) == fields.end() ||
                         !scene.fluid->obstacles.empty(),
                     marks.value({"output", "fluid", "fields"}), "the field obstacle",
                     "obstacles");
    }
    if (scene.fluid && scene.fluid->openfoam && scene.fluid->openfoam->write)
        check_interval(scene, scene.fluid->openfoam->write->every_s,
                       marks.value({"fluid", "openfoam", "write", "every"}));
}

}  // namespace

// Files come first: a name or path that is not allowed must be refused before anything
// uses it.
void check_scene(const Scene& scene, const Marks& marks) {
    require(!scene.bodies.empty() || scene.fluid, marks.value({}),
            "neither bodies nor a fluid", "at least one of them",
            "add the key \"bodies\" or \"fluid\"");
    check_files(scene, marks);
    check_bodies(scene, marks);
    check_rigid_parts(scene, marks);
    check_loads(scene, marks);
    if (scene.fluid) check_fluid(scene, marks);
    check_step(scene, marks);
    check_probes(scene, marks);
    check_checkpoint(scene, marks);
    require_with(!scene.accuracy || scene.probes, marks.key({"accuracy"}), "accuracy",
                 "probes");
    check_output(scene, marks);
}

namespace {

// Places of the keys of a material: the body's own, or that of one of its regions.
struct MaterialMarks {
    const Marks& marks;
    const std::string& body;
    std::string region;  // index in material_regions; "": the body's

    bool has(const char* key) const {
        return region.empty()
                   ? marks.has({"bodies", body, "material", key})
                   : marks.has({"bodies", body, "material_regions", region, key});
    }
    const Origin& at(const char* key) const {
        return region.empty()
                   ? marks.value({"bodies", body, "material", key})
                   : marks.value({"bodies", body, "material_regions", region, key});
    }
};

// A Yeoh material must not lose its stiffness: 2 W' = G + 4 c2 s + 6 c3 s^2 is positive
// for every s >= 0.
void check_yeoh(const MaterialMarks& at, const Material& material) {
    if (!material.stiffening) return;
    const auto* yeoh = std::get_if<Yeoh>(&*material.stiffening);
    if (!yeoh) return;
    const double least_pa = -std::sqrt(1.5 * yeoh->c3_pa * material.shear_modulus_pa);
    require(yeoh->c2_pa >= 0 || yeoh->c2_pa > least_pa, at.at("yeoh"),
            fmt::format("yeoh with c2 = {:g} Pa, which loses its stiffness when it is "
                        "stretched",
                        yeoh->c2_pa),
            fmt::format("c2 above {:g} Pa with this c3 and shear modulus", least_pa));
}

// Requires a preset, or density and a complete pair: shear_modulus with lame_lambda, or
// youngs_modulus with poissons_ratio. A rigid body may have no pair.
void check(const MaterialMarks& at, bool rigid) {
    const char* pairs[][2] = {{"shear_modulus", "lame_lambda"},
                              {"youngs_modulus", "poissons_ratio"}};
    const auto& [ours, theirs] = pairs;
    const bool by_ours = at.has(ours[0]) || at.has(ours[1]);
    const bool by_theirs = at.has(theirs[0]) || at.has(theirs[1]);
    require(at.has("density") || at.has("preset"), at.at("density"), "no key \"density\"",
            "a density such as 1000 kg/m3, or a preset");
    if (rigid && !by_ours && !by_theirs) return;
    const char* second = at.has(theirs[0]) ? theirs[0] : theirs[1];
    require(!by_ours || !by_theirs, at.at(second),
            fmt::format("{} beside {}", second, at.has(ours[0]) ? ours[0] : ours[1]),
            "shear_modulus and lame_lambda, or youngs_modulus and poissons_ratio");
    if (at.has("preset")) return;
    for (const char* key : by_theirs ? theirs : ours)
        require(at.has(key), at.at(key), fmt::format("no key \"{}\"", key),
                "shear_modulus and lame_lambda, or youngs_modulus and poissons_ratio");
}

}  // namespace

// The check reads the keys of the file, since the scene has only G, lambda and the
// kinematic viscosity, whichever way they were given.
void check_materials(const Scene& scene, const Marks& marks) {
    for (const Body& body : scene.bodies) {
        const bool rigid = body.is_all_rigid();
        check({marks, body.name, ""}, rigid);
        check_yeoh({marks, body.name, ""}, body.material);
        for (std::size_t i = 0; i < body.material_regions.size(); ++i) {
            check({marks, body.name, std::to_string(i)}, rigid);
            check_yeoh({marks, body.name, std::to_string(i)},
                       body.material_regions[i].material);
        }
    }
    if (!scene.fluid) return;
    const bool usual = marks.has({"fluid", "viscosity"});
    const bool dynamic = marks.has({"fluid", "dynamic_viscosity"});
    require(usual || dynamic, marks.value({"fluid", "viscosity"}), "no key \"viscosity\"",
            "viscosity, or dynamic_viscosity");
    require(!usual || !dynamic, marks.value({"fluid", "viscosity"}),
            "viscosity beside dynamic_viscosity", "one of the two");
}

}  // namespace magfsi::scene
