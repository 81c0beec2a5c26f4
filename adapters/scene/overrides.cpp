#include "adapters/scene/overrides.h"

#include <fmt/format.h>

#include <charconv>

#include "adapters/scene/split.h"

namespace magfsi::scene {

namespace {

Node& list_item(Node& list, const std::string& part, const Origin& origin) {
    std::size_t index = 0;
    const auto [end, error] =
        std::from_chars(part.data(), part.data() + part.size(), index);
    if (error != std::errc{} || end != part.data() + part.size() ||
        index >= list.children.size())
        refuse(origin, fmt::format("item {} of {}", in_quotes(part), describe(list)),
               fmt::format("items 0 to {}", list.children.size() - 1));
    return list.children[index];
}

// The child of that name, created if missing. What is not a container becomes a map: the
// reader then judges whether a map may stand there.
Node& descend(Node& node, const std::string& part, const Origin& origin) {
    if (node.type == Node::Type::sequence && !node.children.empty())
        return list_item(node, part, origin);
    if (Node* child = node.find(part)) return *child;
    if (node.type != Node::Type::map) {
        node.type = Node::Type::map;
        node.origin = origin;
        node.scalar.clear();
    }
    Node child;
    child.key = part;
    child.key_origin = child.origin = origin;
    node.children.push_back(std::move(child));
    return node.children.back();
}

void remove(Node& root, const std::vector<std::string>& parts, const Origin& origin) {
    Node* node = &root;
    for (std::size_t i = 0; i + 1 < parts.size() && node; ++i)
        node = node->find(parts[i]);
    if (!node || !node->find(parts.back()))
        refuse(origin, "no such key to remove", "keys that the scene has");
    std::erase_if(node->children,
                  [&](const Node& child) { return child.key == parts.back(); });
}

void apply(Node& root, const std::string& text) {
    const std::size_t equals = text.find('=');
    const std::string path = text.substr(0, equals);
    const Origin origin{fmt::format("--set {}", path)};
    const std::vector<std::string> parts = split(path, '.');
    if (equals == std::string::npos)
        refuse(origin, "no \"=\"", "--set path.to.key=value");
    for (const std::string& part : parts) {
        if (part.empty())
            refuse(origin, "an empty name in the path", "--set path.to.key=value");
    }
    Node value = parse_document(text.substr(equals + 1), origin);
    if (value.type == Node::Type::null) return remove(root, parts, origin);

    Node* target = &root;
    for (const std::string& part : parts) target = &descend(*target, part, origin);
    value.key = target->key;
    value.key_origin = target->key_origin;
    *target = std::move(value);
}

}  // namespace

void apply_overrides(Node& root, const std::vector<std::string>& overrides) {
    for (const std::string& text : overrides) apply(root, text);
}

}  // namespace magfsi::scene
