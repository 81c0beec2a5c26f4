// SPDX-License-Identifier: GPL-2.0-or-later
// Checks of bodies: mesh, magnetisation, held and moved faces, initial placement.
#include "adapters/scene/checks.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>
#include <span>
#include <type_traits>
#include <variant>

#include "adapters/scene/field.h"
#include "base/fitted/constants.h"

namespace magfsi::scene {

namespace {

// Number of elements of a mesh by numbers; 1 for files, which are counted when built.
double elements_of(const Body& body) {
    const auto product = [](const auto& counts) {
        double all = 1;
        for (const int n : counts) all *= n;
        return all;
    };
    // A section has the square of those across its core, and layers on its four sides.
    const auto of_section = [](double across, double layers) {
        return across * (across + 4 * layers);
    };
    const auto count = [&](const auto& mesh) -> double {
        using Mesh = std::decay_t<decltype(mesh)>;
        if constexpr (std::is_same_v<Mesh, BallMesh>) {
            const auto [across, layers] = mesh.elements;
            return 1.0 * across * across * (across + 6.0 * layers);
        } else if constexpr (std::is_same_v<Mesh, CapsuleMesh>) {
            const auto [across, layers, along] = mesh.elements;
            return of_section(across, layers) * (along + across) +
                   2.0 * across * across * layers;
        } else if constexpr (std::is_same_v<Mesh, CylinderMesh> ||
                             std::is_same_v<Mesh, ConeMesh> ||
                             std::is_same_v<Mesh, WireMesh>) {
            const auto [across, layers, along] = mesh.elements;
            return of_section(across, layers) * along;
        } else if constexpr (std::is_same_v<Mesh, ObliquePlate>) {
            return product(mesh.cells) * product(mesh.elements_per_cell);
        } else if constexpr (requires { mesh.elements; }) {
            return product(mesh.elements);
        } else {
            return 1;
        }
    };
    return std::visit(count, body.mesh);
}

// Place of the number of elements; of meshes without one, the mesh.
Origin place_of_elements(const Body& body, const Marks& marks) {
    if (std::holds_alternative<Box>(body.mesh))
        return marks.value({"bodies", body.name, "mesh", "box", "elements"});
    return marks.value({"bodies", body.name, "mesh"});
}

// The limit holds for all bodies together.
void check_element_count(const Scene& scene, const Marks& marks) {
    double all = 0;
    for (const Body& body : scene.bodies) {
        all += elements_of(body);
        require(all <= max_elements, place_of_elements(body, marks),
                fmt::format("{:.9g} elements in all bodies", all),
                fmt::format("at most {:.0f}", max_elements), "take fewer elements");
    }
}

// Bodies of other meshes are checked when their mesh is known (magfsi explain).
void check_marker_count(const Scene& scene, const Body& body, const Box& box,
                        const Marks& marks) {
    const double markers = most_markers(scene, box.size_m);
    require(markers <= max_markers, marks.value({"fluid", "spacing"}),
            fmt::format("up to {:.3g} markers on \"{}\"", markers, body.name),
            fmt::format("at most {:.0f}", max_markers), "take a larger fluid.spacing");
}

// Refuses the name of a face that the mesh does not have. Faces of a Gmsh file are known
// only when it is read. `list` is the key that names the face.
void check_face(const Body& body, const std::string& face, std::string_view list,
                const Origin& here) {
    if (std::holds_alternative<MeshFile>(body.mesh)) return;
    std::vector<std::string> faces(names<Face>.begin(), names<Face>.end());
    if (const auto* voxels = std::get_if<VoxelMesh>(&body.mesh))
        for (const FaceBox& named : voxels->faces) faces.push_back(named.name);
    require(std::ranges::find(faces, face) != faces.end(), here,
            fmt::format("{} as a face of {}", in_quotes(face), list), joined(faces),
            did_you_mean(face, faces));
}

// Each face may be named once.
void check_clamps(const Body& body, const Marks& marks) {
    for (std::size_t i = 0; i < body.clamps.size(); ++i) {
        const std::string& clamp = body.clamps[i];
        const Origin& here = marks.item({"bodies", body.name, "clamps"}, i);
        check_face(body, clamp, "clamps", here);
        const auto earlier = std::span(body.clamps).first(i);
        require(std::ranges::find(earlier, clamp) == earlier.end(), here,
                fmt::format("{} twice in clamps", in_quotes(clamp)), "each face once");
    }
}

void check_rollers(const Body& body, const Marks& marks) {
    for (std::size_t i = 0; i < body.rollers.size(); ++i) {
        const Origin& here = marks.item({"bodies", body.name, "rollers"}, i);
        for (const std::string& face : body.rollers[i].faces)
            check_face(body, face, "rollers", here);
    }
    // The relaxed shape is computed before the body is rotated, with rollers along axes
    // of its own frame.
    const auto& turn = body.initial.rotation;
    if (!body.initial.relaxed || !turn) return;
    for (const Roller& roller : body.rollers)
        require(roller.axis != turn->plane[0] && roller.axis != turn->plane[1],
                marks.key({"bodies", body.name, "rollers"}),
                fmt::format("rollers along {} of a body that is relaxed and then turned "
                            "about another axis",
                            axis_names[roller.axis]),
                "rollers along the axis of initial.rotation, or no relaxed shape");
}

// Checks a list of regions: blocks and cubes have none, and each may be named once.
// Whether a mesh has a region is known only when it is built. `name` is the list in
// errors.
template <class Item>
void check_regions(const Body& body, const std::vector<Item>& list, Path here,
                   std::string_view name, const Marks& marks) {
    const bool has_own = std::holds_alternative<ObliquePlate>(body.mesh) ||
                         std::holds_alternative<MeshFile>(body.mesh);
    require(list.empty() || has_own || !body.regions.empty(), marks.key(here),
            fmt::format("{} of a mesh without regions", name),
            "them for the meshes oblique and gmsh, and for bodies with `regions`",
            fmt::format("name parts of it by shapes: bodies.{}.regions", body.name));
    std::set<std::string> seen;
    for (std::size_t i = 0; i < list.size(); ++i) {
        for (const std::string& region : list[i].regions)
            require(seen.insert(region).second, marks.item(here, i),
                    fmt::format("the region {} twice in {}", in_quotes(region), name),
                    "each region once");
    }
}

// Boxes must not be empty.
void check_box(const std::optional<std::array<Vec3, 2>>& box_m, const Origin& here,
               const std::string& what) {
    for (std::size_t k = 0; box_m && k < 3; ++k)
        require((*box_m)[0][k] < (*box_m)[1][k], here,
                fmt::format("{} that is empty along {}", what, axis_names[k]),
                "[lower corner, upper corner]");
}

void check_shapes(const Body& body, const Marks& marks) {
    for (const NamedRegion& region : body.regions)
        check_box(region.shape.box_m,
                  marks.value({"bodies", body.name, "regions", region.name, "box"}),
                  "a box");
}

// A magnetisation that follows the rotation is known in uniform fields alone.
void check_follows(const Scene& scene, const Body& body, const Marks& marks) {
    if (body.magnetization->follows != MagnetizationFollows::rotation) return;
    const Origin& here = marks.value({"bodies", body.name, "magnetization", "follows"});
    const char* const allowed = "it in uniform fields, without dipoles";
    const auto& field = scene.magnetic_field;
    require(!field || !field->gradient, here, "rotation in a field with a gradient",
            allowed, "remove magnetization.follows");
    require(!field || field->sources.empty(), here, "rotation in a field of sources",
            allowed, "remove magnetization.follows");
    require(!scene.dipoles, here, "rotation beside dipoles", allowed,
            "remove magnetization.follows");
}

// The two axes of a harmonic magnetisation span a plane.
void check_magnetization(const Scene& scene, const Body& body, const Marks& marks) {
    if (!body.magnetization) return;
    check_follows(scene, body, marks);
    if (const auto* m = std::get_if<HarmonicMagnetization>(&*body.magnetization))
        require(m->along != m->into,
                marks.value({"bodies", body.name, "magnetization", "harmonic", "into"}),
                fmt::format("along and into both {}", axis_names[m->along]),
                "two different axes");
    if (const auto* m = std::get_if<RegionMagnetization>(&*body.magnetization))
        check_regions(body, m->regions, {"bodies", body.name, "magnetization", "regions"},
                      "magnetization regions", marks);
    const auto* domains = std::get_if<DomainMagnetization>(&*body.magnetization);
    for (std::size_t i = 0; domains && i < domains->domains.size(); ++i)
        check_box(domains->domains[i].shape.box_m,
                  marks.value({"bodies", body.name, "magnetization", "domains"}),
                  fmt::format("a domain box (number {})", i + 1));
}

// Named faces of a body of cubes: boxes that may be flat but not inverted, with names of
// their own.
void check_voxels(const Body& body, const VoxelMesh& voxels, const Marks& marks) {
    for (const FaceBox& face : voxels.faces) {
        const Path here{"bodies", body.name, "mesh", "voxels", "faces", face.name};
        for (int d = 0; d < 3; ++d)
            require(face.box_m[0][d] <= face.box_m[1][d], marks.value(here),
                    fmt::format("a box that is empty along {}", axis_names[d]),
                    "[lower corner, upper corner]");
        require(std::ranges::find(names<Face>, face.name) == names<Face>.end(),
                marks.value(here), fmt::format("the face {}", in_quotes(face.name)),
                "another name: x_min to z_max are there already");
    }
}

// A body in a fluid needs a position in the fluid's box; a relaxed shape needs a
// magnetisation.
void check_initial(const Scene& scene, const Body& body, const Marks& marks) {
    require(!body.initial.relaxed || body.magnetization,
            marks.key({"bodies", body.name, "initial", "relaxed"}),
            "relaxed for a body without magnetization", "it for magnetized bodies");
    require(
        !scene.fluid || body.initial.position_m,
        marks.value({"bodies", body.name, "initial"}),
        fmt::format("no initial position of \"{}\" in a scene with a fluid", body.name),
        "initial: {position: [x, y, z]}, where the centre of volume goes");
}

// Half the extent along each axis of the rotated block's bounding box.
Vec3 half_extent(const Body& body, const Box& box) {
    Vec3 half = 0.5 * box.size_m;
    if (!body.initial.rotation) return half;
    const auto [a, b] = body.initial.rotation->plane;
    const double c = std::abs(std::cos(body.initial.rotation->angle_rad));
    const double s = std::abs(std::sin(body.initial.rotation->angle_rad));
    Vec3 turned = half;
    turned[a] = c * half[a] + s * half[b];
    turned[b] = s * half[a] + c * half[b];
    return turned;
}

// Checks that the block lies in the fluid's box. A body that starts relaxed is taken as
// straight, since its shape is not known yet.
void check_inside(const Scene& scene, const Body& body, const Box& box,
                  const Marks& marks) {
    if (!scene.fluid || !body.initial.position_m) return;
    const Vec3 half = half_extent(body, box);
    for (int i = 0; i < 3; ++i) {
        const double side = scene.fluid->box_m[i];
        const double centre = (*body.initial.position_m)[i];
        const double slack = 1e-9 * side;  // a body as wide as the box may touch it
        // A body may reach through a periodic side and then appears at the opposite one.
        const bool periodic = scene.fluid->period_m()[i] > 0;
        const double reach = periodic && 2 * half[i] <= side + slack ? 0 : half[i];
        const bool below = centre - reach < -slack;
        if (!below && centre + reach <= side + slack) continue;
        const double end = below ? centre - half[i] : centre + half[i];
        const double from = reach, to = side - reach;
        refuse(marks.value({"bodies", body.name, "initial", "position"}),
               fmt::format("\"{}\" reaching {} = {}, outside the fluid box", body.name,
                           axis_names[i], metres(end)),
               fmt::format("{} from 0 m to {}", axis_names[i], metres(side)),
               from <= to ? fmt::format("put its centre between {} and {}", metres(from),
                                        metres(to))
                          : "take a larger box");
    }
}

// A face may be held or moved once; moved faces need Newton's method on paths of
// equilibria.
void check_prescribed_motion(const Scene& scene, const Body& body, const Marks& marks) {
    std::vector<std::string> held = body.clamps;
    for (std::size_t i = 0; i < body.prescribed_motion.size(); ++i) {
        const Origin& here = marks.item({"bodies", body.name, "prescribed_motion"}, i);
        const auto& path = scene.time.equilibrium;
        require(!path || path->method == EquilibriumMethod::newton, here,
                "a prescribed motion on a path of equilibria by damped motion",
                "it in runs over time, or with the method newton",
                "take time.equilibrium.method: newton");
        require(
            !std::holds_alternative<HeldDisplacement>(body.prescribed_motion[i].course) ||
                path || scene.time.start == RunStart::equilibrium,
            here, "a displacement in a run that starts with bodies as they are placed",
            "it with an equilibrium to start from", "add time.start: equilibrium");
        const auto at = [&](const char* kind, const char* name) -> const Origin& {
            return marks.value({"bodies", body.name, "prescribed_motion",
                                std::to_string(i), kind, name});
        };
        check_course(body.prescribed_motion[i].course, scene.time.end_s, at);
        // On a path of equilibria all nodes of a face have one displacement.
        require(
            !std::holds_alternative<TurningMotion>(body.prescribed_motion[i].course) ||
                !path,
            at("turning", "axis"), "a face that turns on a path of equilibria",
            "it in runs over time",
            "remove time.equilibrium, or move the face by oscillation, ramp or "
            "formula");
        for (const std::string& face : body.prescribed_motion[i].faces) {
            check_face(body, face, "prescribed_motion", here);
            require(std::ranges::find(held, face) == held.end(), here,
                    fmt::format("the moved face {} held besides", in_quotes(face)),
                    "each face once in clamps or prescribed_motion");
            held.push_back(face);
        }
    }
}

}  // namespace

// n is the extent in marker spacings; both sides of all three pairs of faces count.
double most_markers(const Scene& scene, const Vec3& extent_m) {
    if (!scene.coupling || !scene.fluid) return 0;
    const double apart_m = fitted::marker_spacing * scene.fluid->finest_spacing_m();
    const Vec3 n = extent_m / apart_m;
    return 2 * (n[0] * n[1] + n[1] * n[2] + n[2] * n[0]);
}

bool spans_fluid(const Fluid& fluid, const Body& body, int axis, double extent_m,
                 bool between_walls) {
    const auto& turn = body.initial.rotation;
    if (turn && (turn->plane[0] == axis || turn->plane[1] == axis)) return false;
    const std::size_t d = axis;
    const bool periodic = fluid.boundaries[2 * d].kind == BoundaryKind::periodic;
    // No fluid passes through a gap of less than half a cell beside a wall.
    const double gap_m =
        periodic ? 1e-6 * fluid.box_m[d] : 0.5 * fluid.finest_spacing_m();
    return (periodic || between_walls) && extent_m >= fluid.box_m[d] - gap_m;
}

// Checks that need the shape of a body are made here for blocks only, whose shape the
// keys tell.
void check_bodies(const Scene& scene, const Marks& marks) {
    check_element_count(scene, marks);
    for (const Body& body : scene.bodies) {
        const auto* box = std::get_if<Box>(&body.mesh);
        if (box) check_marker_count(scene, body, *box, marks);
        if (const auto* voxels = std::get_if<VoxelMesh>(&body.mesh))
            check_voxels(body, *voxels, marks);
        check_clamps(body, marks);
        check_rollers(body, marks);
        check_prescribed_motion(scene, body, marks);
        check_shapes(body, marks);
        check_regions(body, body.material_regions,
                      {"bodies", body.name, "material_regions"}, "material_regions",
                      marks);
        check_magnetization(scene, body, marks);
        check_initial(scene, body, marks);
        if (box) check_inside(scene, body, *box, marks);
    }
}

}  // namespace magfsi::scene
