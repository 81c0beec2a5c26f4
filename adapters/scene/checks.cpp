// Places in the file; checks of outputs and of the whole.
#include "adapters/scene/checks.h"

#include <fmt/format.h>

#include <algorithm>

#include "adapters/scene/effective.h"
#include "adapters/scene/field.h"
#include "adapters/scene/quantity.h"

namespace magfsi::scene {

const Node& Marks::deepest(Path path) const {
    const Node* node = root_;
    for (const std::string& part : path) {
        const Node* child = node->find(part);
        if (!child) break;
        node = child;
    }
    return *node;
}

const Origin& Marks::value(Path path) const {
    return deepest(path).origin;
}

const Origin& Marks::key(Path path) const {
    const Node& node = deepest(path);
    return &node == root_ ? node.origin : node.key_origin;
}

const Origin& Marks::item(Path path, std::size_t i) const {
    const Node& node = deepest(path);
    return node.type == Node::Type::sequence && i < node.children.size()
               ? node.children[i].origin
               : node.origin;
}

bool Marks::has(Path path) const {
    const Node* node = root_;
    for (const std::string& part : path) {
        if (node) node = node->find(part);
    }
    return node != nullptr;
}

void check_scene(const Scene& scene, const Marks& marks) {
    if (scene.bodies.empty() && !scene.fluid)
        refuse(marks.value({}), "neither bodies nor a fluid", "at least one of them",
               "add the key \"bodies\" or \"fluid\"");
    check_bodies(scene, marks);
    check_loads(scene, marks);
    check_fluid(scene, marks);
    check_openfoam(scene, marks);
    check_step(scene, marks);
    check_outputs(scene, marks);
}

namespace {

void check_interval(const Scene& scene, double every_s, const Origin& where) {
    const std::optional<double> dt_s = coupled_step_s(scene);
    if (!dt_s || every_s >= *dt_s * (1 - 1e-9)) return;  // rounding is no fault
    refuse(where, fmt::format("the interval {}", format_si(every_s, "s")),
           fmt::format("at least the coupled step of {}", format_si(*dt_s, "s")));
}

const Body& body_named(const Scene& scene, const std::string& name, const Origin& where) {
    const auto body = std::ranges::find(scene.bodies, name, &Body::name);
    if (body != scene.bodies.end()) return *body;
    std::vector<std::string> bodies;
    for (const Body& b : scene.bodies) bodies.push_back(b.name);
    refuse(where, fmt::format("no body {}", in_quotes(name)),
           bodies.empty() ? "scenes with bodies" : joined(bodies),
           did_you_mean(name, bodies));
}

void check_point(const Scene& scene, const PointProbe& point, const Marks& marks) {
    const Body& body = body_named(scene, point.body,
                                  marks.value({"probes", "points", point.name, "body"}));
    const auto* box = std::get_if<Box>(&body.mesh);
    for (int i = 0; box && i < 3; ++i) {
        const double size = box->size_m[i];
        // A point on the surface may round to just outside.
        if (point.at_m[i] >= -1e-9 * size && point.at_m[i] <= size * (1 + 1e-9)) continue;
        refuse(marks.value({"probes", "points", point.name, "at"}),
               fmt::format("{} = {} outside the body \"{}\"", axis_names[i],
                           format_si(point.at_m[i], "m"), point.body),
               fmt::format("{} from 0 m to {} (the body's own frame)", axis_names[i],
                           format_si(size, "m")));
    }
}

void check_plane(const Scene& scene, const std::string& name, const FluidPlane& plane,
                 const Marks& marks) {
    if (!scene.fluid || scene.fluid->solver != FluidSolver::lbm)
        refuse(marks.key({"probes", "integrals", name, "plane"}),
               "a plane without a fluid of the solver lbm", "it with fluid.solver: lbm");
    const double side = scene.fluid->box_m[static_cast<std::size_t>(plane.axis)];
    if (plane.at_m >= 0 && plane.at_m <= side) return;
    refuse(
        marks.value({"probes", "integrals", name, "plane", "at"}),
        fmt::format("a plane at {} = {}, outside the fluid box", axis_names[plane.axis],
                    format_si(plane.at_m, "m")),
        fmt::format("{} from 0 m to {}", axis_names[plane.axis], format_si(side, "m")));
}

void check_part(const Scene& scene, const std::string& name, const BodyPart& part,
                const Marks& marks) {
    body_named(scene, part.body,
               marks.value({"probes", "integrals", name, "part", "body"}));
    for (std::size_t d = 0; part.box_m && d < 3; ++d) {
        if ((*part.box_m)[0][d] < (*part.box_m)[1][d]) continue;
        refuse(marks.value({"probes", "integrals", name, "part", "box"}),
               fmt::format("a box that is empty along {}", axis_names[d]),
               "[lower corner, upper corner]");
    }
}

void check_integrals(const Scene& scene, const Marks& marks) {
    for (const IntegralProbe& integral : scene.probes->integrals) {
        const auto taken = [&](const auto& thing) { return thing.name == integral.name; };
        if (std::ranges::any_of(scene.bodies, taken) ||
            (scene.fluid && std::ranges::any_of(scene.fluid->obstacles, taken)))
            refuse(marks.key({"probes", "integrals", integral.name}),
                   fmt::format("an integral with the name of a body or an obstacle, {}",
                               in_quotes(integral.name)),
                   "names of its own, for columns that can be told apart");
        if (const auto* plane = std::get_if<FluidPlane>(&integral.over))
            check_plane(scene, integral.name, *plane, marks);
        else
            check_part(scene, integral.name, std::get<BodyPart>(integral.over), marks);
    }
}

void check_energy_audit(const Scene& scene, const Marks& marks) {
    if (!scene.probes->energy_audit) return;
    const Origin where = marks.value({"probes", "energy_audit"});
    if (scene.bodies.empty())
        refuse(where, "energy_audit without bodies", "it with bodies only");
    if (scene.time.equilibrium)
        refuse(where, "energy_audit of a path of equilibria",
               "it in runs with motion only");
}

void check_probes(const Scene& scene, const Marks& marks) {
    if (!scene.probes) return;
    const Probes& probes = *scene.probes;
    check_interval(scene, probes.every_s, marks.value({"probes", "every"}));
    if (!probes.bodies.empty() && scene.bodies.empty())
        refuse(marks.key({"probes", "bodies"}), "body probes without bodies",
               "them with bodies only");
    if (!probes.fluid.empty() && !scene.fluid)
        refuse(marks.key({"probes", "fluid"}), "fluid probes without a fluid",
               "them with a fluid only");
    const bool obstacle_force =
        std::ranges::find(probes.fluid, FluidQuantity::obstacle_force) !=
        probes.fluid.end();
    if (obstacle_force && scene.fluid && scene.fluid->obstacles.empty())
        refuse(marks.value({"probes", "fluid"}),
               "the probe obstacle_force without obstacles", "it with obstacles only",
               "add fluid.obstacles");
    const bool force = std::ranges::find(probes.bodies, BodyQuantity::fluid_force) !=
                       probes.bodies.end();
    if (force && !scene.fluid)
        refuse(marks.value({"probes", "bodies"}), "the probe fluid_force without a fluid",
               "it with a fluid only");
    if (probes.interface_balance && !scene.coupling)
        refuse(marks.value({"probes", "interface_balance"}),
               "interface_balance without bodies in a fluid",
               "it with bodies and a fluid only");
    check_energy_audit(scene, marks);
    for (const PointProbe& point : probes.points) check_point(scene, point, marks);
    check_integrals(scene, marks);
}

void check_checkpoint(const Scene& scene, const Marks& marks) {
    if (!scene.checkpoint) return;
    if (scene.time.equilibrium)
        refuse(marks.key({"checkpoint"}), "a checkpoint of a path of equilibria",
               "it in runs with motion only",
               "take the key away: a path starts anew at once from any of its points");
    check_interval(scene, scene.checkpoint->every_s,
                   marks.value({"checkpoint", "every"}));
    if (scene.checkpoint->retry()) check_retry(scene, marks);
}

}  // namespace

void check_outputs(const Scene& scene, const Marks& marks) {
    check_probes(scene, marks);
    check_checkpoint(scene, marks);
    if (scene.output.structure) {
        if (scene.bodies.empty())
            refuse(marks.key({"output", "structure"}), "structure output without bodies",
                   "it with bodies only");
        check_interval(scene, scene.output.structure->every_s,
                       marks.value({"output", "structure", "every"}));
    }
    if (scene.output.fluid) {
        if (!scene.fluid)
            refuse(marks.key({"output", "fluid"}), "fluid output without a fluid",
                   "it with a fluid only");
        check_interval(scene, scene.output.fluid->every_s,
                       marks.value({"output", "fluid", "every"}));
    }
}

}  // namespace magfsi::scene
