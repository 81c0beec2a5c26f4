// SPDX-License-Identifier: GPL-2.0-or-later
// Encoding check, YAML syntax, the tree built from yaml-cpp's events, and --set.
#include "adapters/scene/document.h"

#include <fmt/format.h>
#include <yaml-cpp/eventhandler.h>
#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <charconv>
#include <map>
#include <sstream>
#include <utility>

namespace magfsi::scene {

namespace {

// Number of bytes of the well-formed UTF-8 character at the start (RFC 3629, table of
// section 4); 0 if there is none.
std::size_t character_length(std::string_view bytes) {
    const auto byte = [&](std::size_t i) {
        return i < bytes.size() ? static_cast<unsigned char>(bytes[i]) : 0U;
    };
    const unsigned first = byte(0);
    if (first < 0x80) return 1;
    const std::size_t length = first >= 0xF0 ? 4 : first >= 0xE0 ? 3 : 2;
    if (first < 0xC2 || first > 0xF4) return 0;
    for (std::size_t i = 1; i < length; ++i) {
        if ((byte(i) & 0xC0U) != 0x80) return 0;
    }
    const unsigned second = byte(1);
    if (first == 0xE0 && second < 0xA0) return 0;
    if (first == 0xED && second > 0x9F) return 0;
    if (first == 0xF0 && second < 0x90) return 0;
    if (first == 0xF4 && second > 0x8F) return 0;
    return length;
}

}  // namespace

std::size_t first_fault_in_utf8(std::string_view bytes) {
    for (std::size_t at = 0; at < bytes.size();) {
        const std::size_t length = character_length(bytes.substr(at));
        if (length == 0) return at;
        at += length;
    }
    return std::string_view::npos;
}

namespace {

// Place of a mark; marks count from 0, places from 1.
Origin at(const YAML::Mark& mark, const Origin& whole) {
    if (whole.line == 0 || mark.is_null()) return whole;
    return {whole.source, mark.line + 1, mark.column + 1};
}

// Refuses invalid UTF-8, which would end up in logs and names of files.
void check_encoding(const std::string& text, const Origin& whole) {
    const std::size_t fault = first_fault_in_utf8(text);
    if (fault == std::string::npos) return;
    const std::string_view before = std::string_view(text).substr(0, fault);
    Origin where = whole;
    if (whole.line != 0) {
        where.line = 1 + static_cast<int>(std::ranges::count(before, '\n'));
        where.column = static_cast<int>(fault - (before.rfind('\n') + 1)) + 1;
    }
    refuse(where,
           fmt::format("the byte 0x{:02X}", static_cast<unsigned char>(text[fault])),
           "text in UTF-8");
}

// Builds the tree from yaml-cpp's events. YAML::Node would hide duplicate keys and lose
// the places of keys.
class Builder : public YAML::EventHandler {
  public:
    explicit Builder(Origin whole) : whole_(std::move(whole)) {}

    Node take() { return std::move(root_); }

    void OnDocumentStart(const YAML::Mark& mark) override {
        if (++documents_ == 2)
            refuse(origin(mark), "a second document", "one scene a file",
                   "remove the line \"---\" or, where there is none, the text before "
                   "the first key");
    }
    void OnDocumentEnd() override {}
    void OnNull(const YAML::Mark& mark, YAML::anchor_t anchor) override {
        add(Node::Type::null, mark, anchor, "");
    }
    void OnScalar(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
                  const std::string& value) override {
        const bool is_null = tag == "?" && (value == "null" || value == "~");
        add(is_null ? Node::Type::null : Node::Type::scalar, mark, anchor, value);
    }
    void OnAlias(const YAML::Mark& mark, YAML::anchor_t anchor) override {
        const auto found = anchors_.find(anchor);
        if (found == anchors_.end())
            refuse(origin(mark), "an alias inside its own anchor",
                   "aliases of what is complete");
        Node copy = found->second;
        count(copy, mark);
        attach(std::move(copy), mark);
    }
    void OnSequenceStart(const YAML::Mark& mark, const std::string&,
                         YAML::anchor_t anchor, YAML::EmitterStyle::value) override {
        open(Node::Type::sequence, mark, anchor);
    }
    void OnMapStart(const YAML::Mark& mark, const std::string&, YAML::anchor_t anchor,
                    YAML::EmitterStyle::value) override {
        open(Node::Type::map, mark, anchor);
    }
    void OnSequenceEnd() override { close(); }
    void OnMapEnd() override { close(); }

  private:
    // A list or map that is being read, with the key that waits for its value.
    struct Level {
        Node node;
        YAML::anchor_t anchor = 0;
        bool has_key = false;
        std::string key;
        Origin key_origin;
    };

    Origin origin(const YAML::Mark& mark) const { return at(mark, whole_); }

    // Counts nodes with all expanded aliases: aliases of aliases grow exponentially with
    // the length of the file.
    void count(const Node& node, const YAML::Mark& mark) {
        constexpr std::size_t max_nodes = 200'000;
        if (++nodes_ > max_nodes)
            refuse(origin(mark), "more than 200000 nodes after expansion of aliases",
                   "smaller scenes");
        for (const Node& child : node.children) count(child, mark);
    }

    // Takes a scalar or a null.
    void add(Node::Type type, const YAML::Mark& mark, YAML::anchor_t anchor,
             const std::string& value) {
        Node node;
        node.type = type;
        node.scalar = value;
        node.origin = origin(mark);
        count(node, mark);
        if (anchor != 0) anchors_[anchor] = node;
        attach(std::move(node), mark);
    }

    // Begins a list or map; it is attached to its parent when it is complete.
    void open(Node::Type type, const YAML::Mark& mark, YAML::anchor_t anchor) {
        if (!levels_.empty()) want_key_before_nesting(mark);
        Level level;
        level.node.type = type;
        level.node.origin = origin(mark);
        level.anchor = anchor;
        count(level.node, mark);
        levels_.push_back(std::move(level));
    }

    // Keys must be scalars; lists and maps as keys are valid YAML.
    void want_key_before_nesting(const YAML::Mark& mark) const {
        const Level& parent = levels_.back();
        if (parent.node.type == Node::Type::map && !parent.has_key)
            refuse(origin(mark), "a list or map as a key", "plain words as keys");
    }

    // An anchor is known from the end of its node on, so that no alias can contain
    // itself.
    void close() {
        Level level = std::move(levels_.back());
        levels_.pop_back();
        if (level.anchor != 0) anchors_[level.anchor] = level.node;
        attach(std::move(level.node), YAML::Mark());
    }

    // Takes a complete node as the root, as the next key of a map, or as the next value.
    void attach(Node node, const YAML::Mark& mark) {
        if (levels_.empty()) {
            root_ = std::move(node);
            return;
        }
        Level& level = levels_.back();
        if (level.node.type == Node::Type::map && !level.has_key) {
            start_pair(level, node, mark);
            return;
        }
        node.key = std::exchange(level.key, {});
        node.key_origin = level.has_key ? level.key_origin : node.origin;
        level.has_key = false;
        level.node.children.push_back(std::move(node));
    }

    // Stores a key until its value comes. Duplicate keys are refused, and so are maps of
    // extreme length, in which the search for duplicates would take quadratic time.
    void start_pair(Level& level, const Node& key, const YAML::Mark& mark) const {
        if (key.type != Node::Type::scalar)
            refuse(origin(mark), "a key that is not a word", "plain words as keys");
        if (const Node* first = level.node.find(key.scalar))
            refuse(origin(mark), fmt::format("the key {} twice", in_quotes(key.scalar)),
                   "each key once",
                   first->key_origin.line == 0
                       ? ""
                       : fmt::format("the first is on line {}", first->key_origin.line));
        constexpr std::size_t most_keys = 1000;
        if (level.node.children.size() == most_keys)
            refuse(origin(mark), fmt::format("more than {} keys in a map", most_keys),
                   "smaller maps");
        level.has_key = true;
        level.key = key.scalar;
        level.key_origin = origin(mark);
    }

    Origin whole_;
    Node root_;
    std::vector<Level> levels_;
    std::map<YAML::anchor_t, Node> anchors_;
    std::size_t nodes_ = 0;
    int documents_ = 0;
};

}  // namespace

const Node* Node::find(std::string_view name) const {
    if (type != Type::map) return nullptr;
    for (const Node& child : children) {
        if (child.key == name) return &child;
    }
    return nullptr;
}

// The same search for a node that is to be changed.
Node* Node::find(std::string_view name) {
    return const_cast<Node*>(std::as_const(*this).find(name));
}

// The text is parsed twice: once by YAML::Load for errors of syntax, once for the events.
Node parse_document(const std::string& text, const Origin& whole) {
    check_encoding(text, whole);
    Builder builder(whole);
    try {
        YAML::Load(text);  // reports errors of syntax first
        std::istringstream stream(text);
        YAML::Parser parser(stream);
        // yaml-cpp reads some invalid text, such as "!a, b", as an endless sequence of
        // empty documents; the second one is refused.
        while (parser.HandleNextDocument(builder)) {
        }
    } catch (const YAML::Exception& error) {
        refuse(at(error.mark, whole), fmt::format("no valid YAML ({})", error.msg),
               "YAML: \"key: value\" with indentation by spaces");
    }
    Node root = builder.take();
    if (root.type == Node::Type::null && root.origin.source.empty()) root.origin = whole;
    return root;
}

// Only the first key of a map is named.
std::string describe(const Node& node) {
    if (node.type == Node::Type::null) return "nothing";
    if (node.type == Node::Type::scalar) return in_quotes(node.scalar);
    if (node.type == Node::Type::sequence) {
        const std::size_t n = node.children.size();
        return fmt::format("a list of {} value{}", n, n == 1 ? "" : "s");
    }
    return node.children.empty() ? "an empty map"
                                 : fmt::format("a map with the key {}",
                                               in_quotes(node.children.front().key));
}

// All parts are kept, so that errors can name an empty one.
std::vector<std::string> split(std::string_view text, char separator) {
    std::vector<std::string> parts(1);
    for (const char c : text) {
        if (c == separator) {
            parts.emplace_back();
        } else {
            parts.back() += c;
        }
    }
    return parts;
}

namespace {

// Item of a list addressed by its index in a --set path.
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

// Child with that name, created if missing. A node that is no container becomes a map;
// the check against the table then decides whether a map is allowed there.
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

// Removes a key, which may be one of an item of a list; items cannot be removed.
void remove(Node& root, const std::vector<std::string>& parts, const Origin& origin) {
    Node* node = &root;
    for (std::size_t i = 0; i + 1 < parts.size() && node; ++i)
        node = node->type == Node::Type::sequence ? &list_item(*node, parts[i], origin)
                                                  : node->find(parts[i]);
    if (!node || !node->find(parts.back()))
        refuse(origin, "no such key to remove", "keys that the scene has");
    std::erase_if(node->children,
                  [&](const Node& child) { return child.key == parts.back(); });
}

// Applies one override "path.to.key=value".
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
