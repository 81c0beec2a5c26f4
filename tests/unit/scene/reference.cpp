// docs/scene.md is what the field table says.
#include <gtest/gtest.h>

#include <set>

#include "adapters/scene/fields.h"
#include "adapters/scene/schema.h"
#include "tests/unit/scene/scene_files.h"

namespace magfsi::scene {
namespace {

TEST(Reference, page_is_up_to_date) {
    EXPECT_EQ(text_of(source_folder / "docs/scene.md"), scene_reference_markdown())
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
