// SPDX-License-Identifier: GPL-2.0-or-later
// The JSON Schema and docs/scene.md say what the table of keys says.
#include <gtest/gtest.h>

#include <set>

#include "adapters/scene/document.h"
#include "adapters/scene/keys.h"
#include "adapters/scene/schema.h"
#include "tests/unit/scene/json_schema.h"
#include "tests/unit/scene/scene_files.h"

namespace magfsi::scene {
namespace {

// YAML as an editor with a JSON Schema reads it.
Json to_json(const Node& node) {
    if (node.type == Node::Type::sequence) {
        Json list = Json::array();
        for (const Node& child : node.children) list.push_back(to_json(child));
        return list;
    }
    if (node.type == Node::Type::map) {
        Json map = Json::object();
        for (const Node& child : node.children) map[child.key] = to_json(child);
        return map;
    }
    if (Json::accept(node.scalar)) return Json::parse(node.scalar);
    return node.scalar;
}

Json load(const std::filesystem::path& file) {
    return to_json(parse_document(test::read(file), {file.string(), 1, 1}));
}

TEST(Schema, accepts_right_scenes) {
    for (const auto& file : right_scenes())
        EXPECT_TRUE(accepts(scene_schema(), load(file))) << file;
}

struct Fault {
    const char* pointer;
    Json value;
};

class SchemaFault : public testing::TestWithParam<Fault> {};

TEST_P(SchemaFault, is_refused) {
    Json scene = load(test_folder / "complete/swimmer.yaml");
    ASSERT_TRUE(accepts(scene_schema(), scene));
    scene[Json::json_pointer(GetParam().pointer)] = GetParam().value;
    EXPECT_FALSE(accepts(scene_schema(), scene)) << GetParam().pointer;
}

INSTANTIATE_TEST_SUITE_P(
    of_each_kind, SchemaFault,
    testing::Values(
        Fault{"/gravty", Json::object()}, Fault{"/time", Json::object()},
        Fault{"/fluid/spacing", 0.2}, Fault{"/fluid/spacing", "small"},
        Fault{"/fluid/spacing", "0.2"},
        Fault{"/fluid/box", Json::array({"1 mm", "1 mm"})},
        Fault{"/fluid/lattice_speed", 0.3}, Fault{"/fluid/lattice_speed", 0},
        Fault{"/fluid/collision", "mrt"}, Fault{"/fluid/boundaries/x_min", "slip"},
        Fault{"/fluid/boundaries/x_min", {{"no_slip", Json::object()}}},
        Fault{"/coupling/substeps", 1.5}, Fault{"/coupling/substeps", 0},
        Fault{"/probes/interface_balance", "yes"},
        Fault{"/bodies/robot-1", Json::object()}, Fault{"/bodies", Json::object()},
        Fault{"/magnetic_field/constant", {{"magnitude", "1 T"}, {"direction", "1 deg"}}},
        Fault{"/bodies/robot/magnetization", Json::object()},
        Fault{"/bodies/robot/clamps", Json::array()},
        Fault{"/bodies/robot/mesh/box/elements", Json::array({1, 1, 0})}));

// Walks table and schema side by side; the schema of a choice with a map is in its anyOf.
void compare(const Field& field, const Json& schema, const std::string& path) {
    EXPECT_EQ(schema.value("description", ""), field.doc) << path;
    EXPECT_EQ(schema.contains("default"), !field.fallback.empty()) << path;
    if (is_leaf(field)) {
        if (schema.contains("enum")) {
            EXPECT_EQ(schema["enum"], Json(field.choices)) << path;
        }
        return;
    }
    const Json& object = field.kind == Kind::named  ? schema["additionalProperties"]
                         : field.kind == Kind::list ? schema["items"]
                                                    : schema;
    EXPECT_EQ(object["additionalProperties"], false) << path;
    EXPECT_EQ(object["properties"].size(), field.children.size()) << path;
    const Json required = object.value("required", Json::array());
    for (const Field& child : field.children) {
        const bool listed =
            std::find(required.begin(), required.end(), child.name) != required.end();
        EXPECT_EQ(listed, child.presence == Presence::required) << path << child.name;
        ASSERT_TRUE(object["properties"].contains(child.name)) << path << child.name;
        compare(child, object["properties"][child.name], path + "/" + child.name);
    }
}

TEST(Schema, has_the_keys_of_the_table) {
    compare(scene_fields(), scene_schema(), "");
}

// A default that the schema itself refuses would be offered by editors all the same.
void check_defaults(const Json& schema) {
    const bool described = schema.is_object() && schema.contains("description");
    if (described && schema.contains("default")) {
        EXPECT_TRUE(accepts(schema, schema["default"])) << schema.dump();
    }
    if (!schema.is_structured()) return;
    for (const Json& inner : schema) check_defaults(inner);
}

TEST(Schema, accepts_its_own_defaults) {
    check_defaults(scene_schema());
}

// docs/scene.md is what the field table says.

TEST(Reference, page_is_up_to_date) {
    EXPECT_EQ(test::read(source_folder / "docs/scene.md"), scene_reference_markdown())
        << "run: magfsi-scene-reference > docs/scene.md";
}

void check_lines(const Field& field) {
    EXPECT_FALSE(field.doc.empty()) << field.name;
    EXPECT_EQ(field.doc.find_first_of("|\n"), std::string::npos) << field.name;
    std::set<std::string> names;
    for (const Field& child : field.children) {
        EXPECT_TRUE(names.insert(child.name).second) << child.name << " twice";
        check_lines(child);
    }
}

TEST(Reference, table_documents_each_key_once) {
    check_lines(scene_fields());
}

}  // namespace
}  // namespace magfsi::scene
