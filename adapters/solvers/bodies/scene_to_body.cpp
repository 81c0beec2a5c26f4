// SPDX-License-Identifier: GPL-2.0-or-later
#include "adapters/solvers/bodies/scene_to_body.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>
#include <stdexcept>
#include <utility>
#include <vector>

#include "adapters/scene/fault.h"
#include "adapters/solvers/bodies/filled_cubes.h"
#include "base/files/temporary_folder.h"
#include "structure/magnetics/magnetization.h"
#include "structure/mesh/block_mesh.h"
#include "structure/mesh/locate.h"
#include "structure/mesh/mesh_file.h"
#include "structure/mesh/region.h"
#include "structure/mesh/round_mesh.h"
#include "structure/mesh/swept_mesh.h"

namespace magfsi::bodies {

namespace fs = std::filesystem;

namespace {

// Results of `run` beside exit statuses.
constexpr int not_started = -1, crashed = -2;

// Runs a command, the program's path first, and waits for its end. messages: the file
// that stdout and stderr go to. Returns the exit status, or one of the values above.
int run(std::vector<std::string> words, const std::string& messages) {
    std::vector<char*> argv;
    argv.reserve(words.size() + 1);
    for (std::string& word : words) argv.push_back(word.data());
    argv.push_back(nullptr);
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_addopen(&actions, 1, messages.c_str(),
                                     O_WRONLY | O_CREAT | O_TRUNC, 0600);
    posix_spawn_file_actions_adddup2(&actions, 1, 2);
    pid_t child = 0;
    const int failed =
        posix_spawn(&child, argv[0], &actions, nullptr, argv.data(), environ);
    posix_spawn_file_actions_destroy(&actions);
    int status = 0;
    if (failed != 0 || waitpid(child, &status, 0) != child) return not_started;
    return WIFEXITED(status) ? WEXITSTATUS(status) : crashed;
}

std::string text_of(const fs::path& file) {
    std::ifstream in(file);
    std::ostringstream text;
    text << in.rdbuf();
    return text.str();
}

// Runs magfsi-mesh, which lies beside this program, and reads the mesh that it wrote. It
// is a process of its own so that Gmsh's library and the ninety libraries that come with
// it are not linked into the solvers. Throws std::invalid_argument with the converter's
// own message.
structure::Mesh convert(const std::string& file, double unit_m) {
    if (!fs::exists(file))
        throw std::invalid_argument(fmt::format(
            "no mesh file {}; its path counts from the scene's folder", file));
    const fs::path converter =
        fs::read_symlink("/proc/self/exe").parent_path() / "magfsi-mesh";
    const files::TemporaryFolder folder("magfsi-mesh");
    const auto mesh = folder / "body.mesh", messages = folder / "messages";
    const int status = run({converter.string(), file, mesh.string(), "--unit",
                            fmt::format("{:.17g}", unit_m)},
                           messages.string());
    if (status == 0) return structure::read_mesh_file(mesh);
    if (status == crashed)
        throw std::invalid_argument(
            fmt::format("mesh {}: Gmsh's library crashes on it; open it in Gmsh and save "
                        "it again, or mesh its geometry anew",
                        file));
    std::string message = text_of(messages);
    while (!message.empty() && message.back() == '\n') message.pop_back();
    throw std::invalid_argument(
        message.empty() ? fmt::format("{} did not run; ./magfsi build makes it anew",
                                      converter.string())
                        : message);
}

structure::Vec3 in_mm(const structure::Vec3& x_m) {
    return {1e3 * x_m[0], 1e3 * x_m[1], 1e3 * x_m[2]};
}

// Names the faces of a mesh of cubes: the nodes in the box of each face, with a margin of
// 0.001 of a cube.
structure::Mesh with_faces(structure::Mesh mesh, const structure::VoxelMesh& voxels) {
    for (const structure::FaceBox& face : voxels.faces) {
        // A place may be typed to fewer digits than it has.
        const structure::Bounds box{face.box_m[0], face.box_m[1]};
        std::vector<int>& nodes = mesh.faces[face.name];
        for (std::size_t n = 0; n < mesh.nodes.size(); ++n) {
            if (box.holds(mesh.nodes[n], 1e-3 * voxels.spacing_m)) nodes.push_back(n);
        }
        if (nodes.empty())
            throw std::invalid_argument(fmt::format(
                "the box of the face {} holds no node of the cubes, which reach from "
                "({:.4g}) mm to ({:.4g}) mm",
                scene::in_quotes(face.name),
                fmt::join(in_mm(structure::bounds(mesh.nodes).low_m), ", "),
                fmt::join(in_mm(structure::bounds(mesh.nodes).high_m), ", ")));
    }
    return mesh;
}

}  // namespace

namespace {

// The mesh with the regions that it has of itself.
structure::Mesh plain_mesh(const scene::Body& body) {
    if (const auto* box = std::get_if<structure::Box>(&body.mesh))
        return structure::box_mesh(*box);
    if (const auto* plate = std::get_if<structure::ObliquePlate>(&body.mesh))
        return structure::oblique_mesh(*plate);
    if (const auto* voxels = std::get_if<structure::VoxelMesh>(&body.mesh))
        return with_faces(filled_mesh(*voxels), *voxels);
    if (const auto* arc = std::get_if<structure::Arc>(&body.mesh))
        return structure::arc_mesh(*arc);
    if (const auto* helix = std::get_if<structure::Helix>(&body.mesh))
        return structure::helix_mesh(*helix);
    if (const auto* ball = std::get_if<structure::BallMesh>(&body.mesh))
        return structure::ball_mesh(*ball);
    if (const auto* cylinder = std::get_if<structure::CylinderMesh>(&body.mesh))
        return structure::cylinder_mesh(*cylinder);
    if (const auto* capsule = std::get_if<structure::CapsuleMesh>(&body.mesh))
        return structure::capsule_mesh(*capsule);
    if (const auto* cone = std::get_if<structure::ConeMesh>(&body.mesh))
        return structure::cone_mesh(*cone);
    if (const auto* wire = std::get_if<structure::WireMesh>(&body.mesh))
        return structure::wire_mesh(*wire);
    const auto& gmsh = std::get<structure::MeshFile>(body.mesh);
    return convert(gmsh.file, gmsh.unit_m);
}

}  // namespace

structure::Mesh to_mesh(const scene::Body& body) {
    try {
        structure::Mesh mesh = plain_mesh(body);
        structure::add_regions(mesh, body.regions);
        return mesh;
    } catch (const std::invalid_argument& fault) {
        throw scene::SceneError(fmt::format("{}{}body '{}': {}", body.mesh_place,
                                            body.mesh_place.empty() ? "" : ": ",
                                            body.name, fault.what()));
    }
}

double extent(const structure::Mesh& mesh, int axis) {
    const structure::Bounds box = structure::bounds(mesh.nodes);
    const std::size_t d = axis;
    return box.high_m[d] - box.low_m[d];
}

structure::MaterialPoint locate(const scene::Body& body, const structure::Mesh& mesh,
                                const structure::Vec3& at_m) {
    if (const auto* box = std::get_if<structure::Box>(&body.mesh))
        return structure::locate(*box, at_m);
    // A point typed to a few digits may lie just outside of a slanted face.
    constexpr double tolerance = 1e-3;  // in lengths of an element
    const auto found = structure::PointLocator(mesh).find(at_m, tolerance);
    if (found) return *found;
    throw std::invalid_argument(
        fmt::format("body '{}': the point ({:.6g}, {:.6g}, {:.6g}) mm lies in no element "
                    "of its mesh; give a point of the body in its own frame",
                    body.name, at_m[0] * 1e3, at_m[1] * 1e3, at_m[2] * 1e3));
}

namespace {

using structure::Mesh;

// Magnetisation of each element [A/m] by the law that the scene has chosen. A harmonic
// law without wavelength takes the length of the mesh along its axis; regions that no
// entry names are not magnetised.
std::vector<structure::Vec3> magnetize(const structure::Magnetization& wanted,
                                       const Mesh& mesh) {
    if (const auto* uniform = std::get_if<structure::UniformMagnetization>(&wanted))
        return structure::uniform_magnetization(mesh, uniform->vector_a_m);
    if (const auto* table = std::get_if<structure::TableMagnetization>(&wanted))
        return structure::table_magnetization(mesh, table->file);
    if (const auto* domains = std::get_if<structure::DomainMagnetization>(&wanted))
        return structure::domain_magnetization(mesh, domains->domains);
    if (const auto* wave = std::get_if<structure::HarmonicMagnetization>(&wanted)) {
        structure::HarmonicMagnetization whole = *wave;
        if (whole.wavelength_m == 0) whole.wavelength_m = extent(mesh, wave->along);
        return structure::harmonic_magnetization(mesh, whole);
    }
    if (const auto* curve = std::get_if<structure::CurveMagnetization>(&wanted))
        return structure::curve_magnetization(mesh, *curve);
    if (const auto* radial = std::get_if<structure::RadialMagnetization>(&wanted))
        return structure::radial_magnetization(mesh, *radial);
    std::map<std::string, structure::Vec3> vectors;
    for (const std::string& name : mesh.region_names) vectors[name] = {};
    for (const auto& entry : std::get<structure::RegionMagnetization>(wanted).regions) {
        for (const std::string& region : entry.regions)
            vectors[region] = entry.vector_a_m;
    }
    return structure::region_magnetization(mesh, vectors);
}

// Index of a region in the mesh; a scene::Complaint names the regions that there are.
int region_number(const Mesh& mesh, const std::string& name) {
    const auto found = std::ranges::find(mesh.region_names, name);
    if (found != mesh.region_names.end()) return found - mesh.region_names.begin();
    throw scene::Complaint(
        fmt::format("the region {}", scene::in_quotes(name)),
        mesh.region_names.empty()
            ? "none: the mesh has no regions"
            : fmt::format("those of the mesh: {}", fmt::join(mesh.region_names, ", ")),
        scene::did_you_mean(name, mesh.region_names));
}

// Gives the elements of the regions in material_regions their own materials; all others
// keep the body's.
void add_materials(structure::Body& out, const scene::Body& body) {
    if (body.material_regions.empty()) return;
    std::vector<int> of_region(out.mesh.region_names.size(), 0);
    for (const structure::RegionMaterial& entry : body.material_regions) {
        out.other_materials.push_back(entry.material);
        for (const std::string& name : entry.regions) {
            of_region[region_number(out.mesh, name)] = out.other_materials.size();
        }
    }
    for (const int region : out.mesh.region)
        out.element_material.push_back(of_region[region]);
}

// Makes the elements of the whole body, or of the named regions, rigid parts.
void add_rigid_parts(structure::Body& out, const scene::Body& body) {
    if (body.rigid.empty()) return;
    const std::size_t elements = out.mesh.elements.size();
    if (body.is_all_rigid()) {
        out.rigid_parts = {{"", body.hold}};
        out.element_rigid.assign(elements, 0);
    } else {
        std::vector<int> of_region(out.mesh.region_names.size(), -1);
        for (const std::string& name : body.rigid) {
            of_region[region_number(out.mesh, name)] =
                static_cast<int>(out.rigid_parts.size());
            out.rigid_parts.push_back({name, body.hold});
        }
        for (const int region : out.mesh.region)
            out.element_rigid.push_back(of_region[region]);
    }
    (void)structure::rigid_part_of_nodes(out);  // refuses parts that touch
}

// Runs what may refuse the rigid parts, and says where the scene names them.
template <class Check>
void at_rigid_key(const scene::Body& body, const Check& check) {
    try {
        check();
    } catch (const std::invalid_argument& fault) {
        throw scene::SceneError(fmt::format("{}{}body '{}': {}", body.rigid_place,
                                            body.rigid_place.empty() ? "" : ": ",
                                            body.name, fault.what()));
    }
}

}  // namespace

structure::Body to_body(const scene::Body& body) {
    return to_body(body, to_mesh(body));
}

structure::Body to_body(const scene::Body& body, structure::Mesh mesh) {
    structure::Body out;
    out.name = body.name;
    out.mesh = std::move(mesh);
    out.material = body.material;
    try {
        add_materials(out, body);
    } catch (const scene::Complaint& fault) {
        throw scene::SceneError(
            fmt::format("material_regions of body '{}': {}", body.name, fault.what()));
    }
    at_rigid_key(body, [&] { add_rigid_parts(out, body); });
    out.element = body.element;
    out.inertia = body.inertia;
    out.clamps = body.clamps;
    out.rollers = body.rollers;
    for (const structure::PrescribedMotion& motion : body.prescribed_motion)
        out.clamps.insert(out.clamps.end(), motion.faces.begin(), motion.faces.end());
    if (!out.rigid_parts.empty()) {
        const auto held = structure::held_axes(out);
        at_rigid_key(body, [&] { structure::refuse_held_rigid_parts(out, held); });
    }
    try {
        if (body.magnetization)
            out.magnetization_a_m = magnetize(*body.magnetization, out.mesh);
    } catch (const std::invalid_argument& fault) {
        throw std::invalid_argument(
            fmt::format("magnetization of body '{}': {}", body.name, fault.what()));
    }
    weigh(out);
    return out;
}

Solids to_bodies(const scene::Scene& scene) {
    Solids all;
    for (const scene::Body& body : scene.bodies) {
        const auto same =
            std::ranges::find_if(scene.bodies, [&](const scene::Body& other) {
                return other.mesh == body.mesh && other.regions == body.regions;
            });
        const std::size_t first = same - scene.bodies.begin();
        all.push_back(
            to_body(body, first < all.size() ? all[first].mesh : to_mesh(body)));
    }
    return all;
}

std::optional<structure::Vec3> to_gravity(const scene::Scene& scene) {
    if (!scene.gravity) return std::nullopt;
    return scene.gravity->acceleration_m_s2 * scene.gravity->direction;
}

}  // namespace magfsi::bodies
