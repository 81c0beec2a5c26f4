// SPDX-License-Identifier: GPL-2.0-or-later
// Every key of the table is stored by some scene.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "adapters/scene/effective.h"
#include "adapters/scene/keys.h"
#include "adapters/scene/reader.h"
#include "tests/unit/scene/scene_files.h"

namespace magfsi::scene {
namespace {

// Adds the paths of the leaves below `field` that no scene has a value for. places: what
// the scenes have there.
void missing_leaves(const Field& field, const std::string& path,
                    const std::vector<nlohmann::json>& places,
                    std::vector<std::string>& missing) {
    if (is_leaf(field) && field.children.empty()) {
        if (places.empty()) missing.push_back(path);
        return;
    }
    for (const Field& child : field.children) {
        std::vector<nlohmann::json> inner;
        for (const nlohmann::json& place : places) {
            const bool several = field.kind == Kind::named || field.kind == Kind::list;
            for (const nlohmann::json& one :
                 several ? place : nlohmann::json::array({place})) {
                if (one.is_object() && one.contains(child.name))
                    inner.push_back(one[child.name]);
            }
        }
        missing_leaves(child, path + "." + child.name, inner, missing);
    }
}

// A key that is read but not written would be lacking in scene.json, from which the
// participants start.
TEST(Keys, of_the_table_are_all_stored) {
    std::vector<nlohmann::json> scenes;
    for (const char* name :
         {"swimmer.yaml", "implicit.yaml", "elastic.yaml", "turning.yaml",
          "platform.yaml", "origami.yaml", "channel.yaml", "vortex.yaml", "paste.yaml",
          "blood.yaml", "formula.yaml", "rigid.yaml", "shapes.yaml", "spatial.yaml"})
        scenes.push_back(effective_scene(read_scene(test_folder / "complete" / name)));
    // A field has one first law; those that add have the same keys.
    for (const nlohmann::json& term : scenes.back()["magnetic_field"]["plus"])
        scenes.push_back({{"magnetic_field", term}});
    std::vector<std::string> missing;
    missing_leaves(scene_fields(), "", scenes, missing);
    // One side of each kind is described, and the first law; the others have no example.
    // A file of rows becomes the rows (FieldFiles), other ways to say the material the
    // usual ones (DataSheets).
    std::erase_if(missing, [](const std::string& path) {
        return path.starts_with(".fluid.boundaries.") ||
               path.starts_with(".magnetic_field.plus.") ||
               path == ".magnetic_field.vector_table.file" ||
               path.ends_with(".youngs_modulus") || path.ends_with(".poissons_ratio") ||
               path.ends_with(".dynamic_viscosity");
    });
    EXPECT_EQ(missing, std::vector<std::string>{});
}

}  // namespace
}  // namespace magfsi::scene
