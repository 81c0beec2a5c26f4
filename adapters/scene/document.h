// SPDX-License-Identifier: GPL-2.0-or-later
// A YAML text as a tree whose every node knows where it stands, and --set on it.
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

// Where the first byte stands that begins no well-formed character (RFC 3629: no
// surrogates, no longer forms than needed, nothing above U+10FFFF); npos: none.
std::size_t first_fault_in_utf8(std::string_view bytes);

// "nothing", "\"full\"", "a list of 3 values", "a map with keys a, b"
std::string describe(const Node& node);

// value is YAML. A missing key is created with the maps above it; an item of a list is
// addressed by its number from 0; an empty value or null removes the key. What was not
// overridden keeps its place in the file; what was is reported as "--set path.to.key".
void apply_overrides(Node& root, const std::vector<std::string>& overrides);

// The parts between the separators; one empty part of an empty text.
std::vector<std::string> split(std::string_view text, char separator);

}  // namespace magfsi::scene
