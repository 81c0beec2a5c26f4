// A YAML text as a tree whose every node knows where it stands.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "adapters/scene/fault.h"

namespace magfsi::scene {

struct Node {
    enum class Type { null, scalar, sequence, map };

    Type type = Type::null;
    std::string scalar;
    std::vector<Node> children;  // of a sequence or a map, in the file's order
    std::string key;             // in a map: this node's key
    Origin origin;
    Origin key_origin;

    const Node* find(std::string_view name) const;  // child of a map by key
    Node* find(std::string_view name);
};

// Parses one YAML document. Anchors and aliases are expanded. Throws SceneError at syntax
// errors, keys given twice, keys that are not plain words, and a second document.
// whole.line == 0: every node gets that origin (for --set), not a line and column.
Node parse_document(const std::string& text, const Origin& whole);

// "nothing", "\"full\"", "a list of 3 values", "a map with keys a, b"
std::string describe(const Node& node);

}  // namespace magfsi::scene
