// SPDX-License-Identifier: GPL-2.0-or-later
// From file to scene: text, tree, overrides, check of single keys, values, completion by
// dependent defaults, check of the whole.
#include "adapters/scene/reader.h"

#include <fmt/format.h>

#include <cmath>
#include <fstream>
#include <sstream>

#include "adapters/scene/checks.h"
#include "adapters/scene/document.h"
#include "adapters/scene/effective.h"
#include "adapters/scene/keys.h"
#include "adapters/scene/named_files.h"

namespace magfsi::scene {

namespace {

// Size limit of a scene file: larger than any scene, and still read quickly.
constexpr std::uintmax_t largest_scene_bytes = 4'000'000;

// Scales a vector to unit length. A zero vector is left as it is; check_scene refuses it.
void normalise(Vec3& v) {
    const double length = norm(v);
    v /= length > 0 ? length : 1;
}

// Default scheme: serial, unless that is known to be wrong.
Scheme usual_scheme(const Scene& scene) {
    return light_in_contact(scene) || holds_openfoam(scene) ? Scheme::implicit
                                                            : Scheme::serial;
}

// Fills in defaults of the coupling that depend on the scheme. finds_force: the step is
// repeated until the fluid moves with the body, for which 1 % of its speed is enough.
void complete(Coupling& coupling, bool finds_force) {
    const bool implicit = coupling.scheme == Scheme::implicit;
    if (implicit && !coupling.iteration) {
        coupling.iteration.emplace();
        if (finds_force) coupling.iteration->velocity_tolerance = 0.01;
    }
    if (!coupling.sampled_velocity)
        coupling.sampled_velocity =
            implicit ? SampledVelocity::linear : SampledVelocity::frozen;
}

// Default forcing: no_slip where it is possible, with the lattice. A strength other than
// 1 has a meaning only with the penalty method, so it selects that one.
coupler::Forcing usual_forcing(const Scene& scene) {
    const bool penalty = scene.has_own_structure() || objection_to_no_slip(scene) ||
                         scene.coupling->immersed_boundary.strength != 1 ||
                         (scene.fluid && scene.fluid->solver != FluidSolver::lbm);
    return penalty ? coupler::Forcing::penalty : coupler::Forcing::no_slip;
}

// Fills in defaults that depend on other keys, and makes file names relative to the
// scene's folder.
void complete(Scene& scene, const Marks& marks, const std::filesystem::path& folder) {
    for_each_named_file(scene,
                        [&](std::string& file) { file = (folder / file).string(); });
    for (Body& body : scene.bodies) {
        if (!body.magnetization) continue;
        auto* harmonic = std::get_if<HarmonicMagnetization>(&*body.magnetization);
        const auto* box = std::get_if<Box>(&body.mesh);
        if (harmonic && box && harmonic->wavelength_m == 0)
            harmonic->wavelength_m = box->size_m[harmonic->along];
    }
    if (scene.gravity) normalise(scene.gravity->direction);
    if (scene.platform) normalise(scene.platform->normal);
    if (scene.fluid && !scene.bodies.empty() && !scene.coupling) scene.coupling.emplace();
    if (!scene.coupling) return;
    auto& forcing = scene.coupling->immersed_boundary.forcing;
    if (!forcing) forcing = usual_forcing(scene);
    if (!marks.has({"coupling", "scheme"})) scene.coupling->scheme = usual_scheme(scene);
    complete(*scene.coupling, holds_openfoam(scene));
}

// The tree of the file with all overrides.
Node read_tree(const std::filesystem::path& file,
               const std::vector<std::string>& overrides) {
    const Origin start{file.string(), 1, 1};
    Node root = parse_document(file_text(file), start);
    if (root.type == Node::Type::null)
        refuse(start, "an empty file", "a map with keys such as time and bodies");
    apply_overrides(root, overrides);
    return root;
}

// Reads a scene whose keys are checked one by one, but not against each other.
Scene unchecked_scene(const Node& root, const std::filesystem::path& folder) {
    validate(root, scene_fields());
    Scene scene;
    TreeReader reader(root, scene_fields());
    keys(reader, scene);
    scene.folder = folder;
    complete(scene, Marks(root), folder);
    return scene;
}

}  // namespace

// An empty file is left to the parser; a folder or a device is refused first, since
// reading it could block.
std::string file_text(const std::filesystem::path& file) {
    std::error_code none;
    require_regular_file(file, {file.string()});
    const std::uintmax_t bytes = std::filesystem::file_size(file, none);
    require(none || bytes <= largest_scene_bytes, {file.string()},
            fmt::format("a scene file of {} bytes", bytes),
            fmt::format("at most {} bytes", largest_scene_bytes));
    std::ifstream stream(file, std::ios::binary);
    std::ostringstream text;
    if (stream.peek() != std::ifstream::traits_type::eof()) text << stream.rdbuf();
    if (!stream.is_open() || stream.bad())
        refuse({file.string()}, "a file that cannot be read", "readable scene files");
    return text.str();
}

// Keys of the text replace the scene's; `plus` is emptied first, and the sources are
// replaced as a whole. A gradient is refused, since the solvers hold it constant.
MagneticField read_field(const std::string& text, const std::string& source,
                         const Scene& scene) {
    constexpr const char* key = "magnetic_field";
    const Node root = parse_document(text, {source, 0, 0});
    const Node* const node = root.find(key);
    if (!node) refuse({source}, describe(root), "a map with the key magnetic_field");
    const Field& field = *scene_fields().find(key);
    validate(*node, field);
    require(!node->find("gradient"), {source}, "a gradient",
            "a field that is uniform: the gradient is the scene's, and constant");
    Scene changed = scene;
    changed.magnetic_field->plus.clear();
    TreeReader reader(*node, field);
    keys(reader, *changed.magnetic_field);
    // The scene's own sources have their full paths already.
    if (node->find("sources"))
        for_each_grid(*changed.magnetic_field,
                      [&](std::string& file) { file = (scene.folder / file).string(); });
    read_field_files(changed, Marks(root));
    check_magnetic_field(changed, Marks(root));
    return *changed.magnetic_field;
}

// A folder stands for its scene.yaml.
std::filesystem::path scene_file(const std::filesystem::path& path) {
    const bool folder = std::filesystem::is_directory(path);
    std::filesystem::path file = folder ? path / "scene.yaml" : path;
    if (!std::filesystem::exists(file))
        refuse({file.string()}, "no such file",
               "a scene file, or a folder with a scene.yaml");
    const std::filesystem::path run = file.parent_path();
    require(file.filename() != "scene.json" || !std::filesystem::exists(run / "run.json"),
            {file.string()}, "a scene as a run has read it, in numbers without units",
            "scene files, and run folders",
            fmt::format("give the folder, {}", run.empty() ? "." : run.string()));
    return file;
}

// Order: keys one by one, materials as given, files, then checks of the whole scene.
// Places in the file are kept for faults that show later. The hash comes last, of the
// complete scene.
Scene read_scene(const std::filesystem::path& path,
                 const std::vector<std::string>& overrides) {
    const std::filesystem::path file = scene_file(path);
    const Node root = read_tree(file, overrides);
    Scene scene = unchecked_scene(root, file.parent_path());
    check_materials(scene, Marks(root));
    read_field_files(scene, Marks(root));
    complete_inlets(scene, Marks(root));
    check_scene(scene, Marks(root));
    for (Body& body : scene.bodies) {
        body.mesh_place = to_string(Marks(root).value({"bodies", body.name, "mesh"}));
        body.rigid_place = to_string(Marks(root).value({"bodies", body.name, "rigid"}));
    }
    if (scene.control) {
        for (std::size_t i = 0; i < scene.control->probes.size(); ++i)
            scene.control->probe_places.push_back(
                to_string(Marks(root).item({"control", "probes"}, i)));
    }
    scene.hash = scene_hash(scene);
    return scene;
}

}  // namespace magfsi::scene
