// SPDX-License-Identifier: GPL-2.0-or-later
// A YAML text as a tree in which every node knows its place in the file, and overrides
// (--set) of such a tree.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "adapters/scene/fault.h"

namespace magfsi::scene {

// A node of the tree: nothing, a scalar as text, a sequence, or a map.
struct Node {
    enum class Type { null, scalar, sequence, map };

    Type type = Type::null;
    std::string scalar;
    std::vector<Node> children;  // items or values, in the file's order
    std::string key;             // this node's key if the parent is a map
    Origin origin;
    Origin key_origin;

    const Node* find(std::string_view name) const;  // child of a map by key, or null
    Node* find(std::string_view name);
};

// Parses one YAML document and expands anchors and aliases. Throws SceneError at syntax
// errors, duplicate keys, keys that are not plain words, and a second document. With
// whole.line == 0 (used for --set) every node gets the origin `whole` in place of its
// line and column.
Node parse_document(const std::string& text, const Origin& whole);

// Index of the first byte that does not begin a well-formed UTF-8 character (RFC 3629: no
// surrogates, no overlong forms, nothing above U+10FFFF); npos if there is none.
std::size_t first_fault_in_utf8(std::string_view bytes);

// Short description of a node for errors: "nothing", "\"full\"", "a list of 3 values", "a
// map with the key \"a\"" (its first one).
std::string describe(const Node& node);

// Applies overrides "path.to.key=value", where the value is YAML. A missing key is
// created with the maps above it; an item of a list is addressed by its index from 0; an
// empty value or null removes the key. Nodes that are not overridden keep their place in
// the file; others are reported as "--set path.to.key". Throws SceneError.
void apply_overrides(Node& root, const std::vector<std::string>& overrides);

// Splits a text at every separator; an empty text gives one empty part.
std::vector<std::string> split(std::string_view text, char separator);

}  // namespace magfsi::scene
