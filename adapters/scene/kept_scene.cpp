// SPDX-License-Identifier: GPL-2.0-or-later
#include "adapters/scene/kept_scene.h"

#include <fmt/format.h>
#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <array>

#include "adapters/scene/effective.h"
#include "adapters/scene/reader.h"

namespace magfsi::scene {

namespace fs = std::filesystem;

namespace {

// Keys whose value is the name of a file, wherever they stand.
constexpr auto file_keys = std::to_array<std::string_view>(
    {"file", "script", "schemes", "solution", "functions"});

bool is_scalar(const Node& node) {
    return node.type == Node::Type::scalar;
}

void emit(YAML::Emitter& out, const Node& node) {
    switch (node.type) {
        case Node::Type::null:
            out << YAML::Null;
            return;
        case Node::Type::scalar:
            out << node.scalar;
            return;
        case Node::Type::sequence:
            if (std::ranges::all_of(node.children, is_scalar)) out << YAML::Flow;
            out << YAML::BeginSeq;
            for (const Node& item : node.children) emit(out, item);
            out << YAML::EndSeq;
            return;
        case Node::Type::map:
            out << YAML::BeginMap;
            for (const Node& value : node.children) {
                out << YAML::Key << value.key << YAML::Value;
                emit(out, value);
            }
            out << YAML::EndMap;
            return;
    }
}

fs::path resolved(const fs::path& file) {
    return fs::weakly_canonical(fs::absolute(file));
}

// Files of different folders may have the same name.
std::vector<KeptFile> with_names(const std::vector<fs::path>& files) {
    std::vector<KeptFile> kept;
    for (const fs::path& file : files) {
        const std::string own = file.filename().string();
        std::string name = fmt::format("{}/{}", kept_files_folder, own);
        const auto is_taken = [&](const KeptFile& other) { return other.name == name; };
        for (int n = 2; std::ranges::any_of(kept, is_taken); ++n)
            name = fmt::format("{}/{}-{}", kept_files_folder, n, own);
        kept.push_back({file, name});
    }
    return kept;
}

// Writes the names of kept files in place of those given. Returns whether one changed.
bool rename_files(Node& node, const fs::path& folder, const std::vector<KeptFile>& kept) {
    bool changed = false;
    for (Node& child : node.children) {
        changed |= rename_files(child, folder, kept);
        const bool is_name = std::ranges::find(file_keys, child.key) != file_keys.end();
        if (!is_name || !is_scalar(child)) continue;
        const fs::path file = resolved(folder / child.scalar);
        const auto found = std::ranges::find(kept, file, &KeptFile::from);
        if (found == kept.end() || found->name == child.scalar) continue;
        child.scalar = found->name;
        changed = true;
    }
    return changed;
}

}  // namespace

std::string to_yaml(const Node& root) {
    YAML::Emitter out;
    emit(out, root);
    return std::string(out.c_str()) + "\n";
}

KeptScene kept_scene(const fs::path& path, const std::vector<std::string>& overrides,
                     const Scene& scene) {
    const fs::path file = scene_file(path);
    KeptScene kept;
    kept.as_given = kept.complete = file_text(file);
    kept.files = with_names(files_of(scene));
    Node root = parse_document(kept.as_given, {file.string(), 1, 1});
    apply_overrides(root, overrides);
    const bool renamed = rename_files(root, scene.folder, kept.files);
    if (renamed || !overrides.empty()) kept.complete = to_yaml(root);
    return kept;
}

}  // namespace magfsi::scene
