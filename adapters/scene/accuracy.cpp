#include "adapters/scene/accuracy.h"

#include "adapters/scene/fields.h"
#include "adapters/scene/reader.h"
#include "adapters/scene/validate.h"
#include "adapters/scene/value.h"

namespace magfsi::scene {

namespace {

Node placeholder(const char* yaml, const char* key, const Origin& origin) {
    Node node = parse_document(yaml, origin);
    node.key = key;
    node.key_origin = origin;
    return node;
}

Accuracy accuracy_of(const Node& node) {
    const Field& field = *scene_fields().find("accuracy");
    validate(node, field);
    Accuracy wanted;
    if (const Node* error = node.find("error"))
        wanted.error = 1e-2 * number_value(*error, *field.find("error"));
    if (const Node* time = node.find("time"))
        wanted.time_s = number_value(*time, *field.find("time"));
    return wanted;
}

// Returns whether one was missing.
bool fill(Node* parent, const char* key, const char* yaml) {
    if (!parent || parent->type != Node::Type::map || parent->find(key)) return false;
    parent->children.push_back(placeholder(yaml, key, parent->origin));
    return true;
}

std::vector<std::string> fill_elements(Node& root) {
    std::vector<std::string> filled;
    Node* bodies = root.find("bodies");
    if (!bodies) return filled;
    for (Node& body : bodies->children) {
        Node* mesh = body.find("mesh");
        if (mesh && fill(mesh->find("box"), "elements", "[1, 1, 1]"))
            filled.push_back(body.key);
    }
    return filled;
}

}  // namespace

std::optional<Unresolved> read_unresolved(const std::filesystem::path& path,
                                          const std::vector<std::string>& overrides) {
    const std::filesystem::path file = scene_file(path);
    Node root = read_tree(file, overrides);
    const Node* accuracy = root.find("accuracy");
    if (!accuracy) return std::nullopt;
    Unresolved found;
    found.mark = accuracy->key_origin;
    found.wanted = accuracy_of(*accuracy);
    found.spacing = fill(root.find("fluid"), "spacing", "1 m");
    found.meshes = fill_elements(root);
    if (!found.spacing && found.meshes.empty()) {
        refuse(found.mark, "accuracy beside spacing and elements, with nothing to choose",
               "one of the two",
               "leave fluid.spacing and the elements of blocks out, or accuracy");
    }
    found.scene = unchecked_scene(root, file.parent_path());
    return found;
}

}  // namespace magfsi::scene
