#include "adapters/scene/document.h"

#include <fmt/format.h>
#include <yaml-cpp/eventhandler.h>
#include <yaml-cpp/yaml.h>

#include <map>
#include <sstream>
#include <utility>

#include "adapters/scene/syntax.h"

namespace magfsi::scene {

namespace {

// Builds the tree from yaml-cpp's events. YAML::Node would hide keys given twice and lose
// the marks of keys.
class Builder : public YAML::EventHandler {
  public:
    explicit Builder(Origin whole) : whole_(std::move(whole)) {}

    Node take() { return std::move(root_); }

    void OnDocumentStart(const YAML::Mark&) override {}
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
    struct Level {
        Node node;
        YAML::anchor_t anchor = 0;
        bool has_key = false;
        std::string key;
        Origin key_origin;
    };

    Origin origin(const YAML::Mark& mark) const {
        if (whole_.line == 0) return whole_;
        return {whole_.source, mark.line + 1, mark.column + 1};
    }

    // Aliases of aliases grow without bound; no scene needs this many nodes.
    void count(const Node& node, const YAML::Mark& mark) {
        constexpr std::size_t most_nodes = 200'000;
        if (++nodes_ > most_nodes)
            refuse(origin(mark), "more than 200000 nodes after expansion of aliases",
                   "smaller scenes");
        for (const Node& child : node.children) count(child, mark);
    }

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

    void open(Node::Type type, const YAML::Mark& mark, YAML::anchor_t anchor) {
        if (!levels_.empty()) want_key_before_nesting(mark);
        Level level;
        level.node.type = type;
        level.node.origin = origin(mark);
        level.anchor = anchor;
        count(level.node, mark);
        levels_.push_back(std::move(level));
    }

    void want_key_before_nesting(const YAML::Mark& mark) const {
        const Level& parent = levels_.back();
        if (parent.node.type == Node::Type::map && !parent.has_key)
            refuse(origin(mark), "a list or map as a key", "plain words as keys");
    }

    void close() {
        Level level = std::move(levels_.back());
        levels_.pop_back();
        if (level.anchor != 0) anchors_[level.anchor] = level.node;
        attach(std::move(level.node), YAML::Mark());
    }

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

    void start_pair(Level& level, const Node& key, const YAML::Mark& mark) const {
        if (key.type != Node::Type::scalar)
            refuse(origin(mark), "a key that is not a word", "plain words as keys");
        if (const Node* first = level.node.find(key.scalar))
            refuse(origin(mark), fmt::format("the key {} twice", in_quotes(key.scalar)),
                   "each key once",
                   first->key_origin.line == 0
                       ? ""
                       : fmt::format("the first is on line {}", first->key_origin.line));
        level.has_key = true;
        level.key = key.scalar;
        level.key_origin = origin(mark);
    }

    Origin whole_;
    Node root_;
    std::vector<Level> levels_;
    std::map<YAML::anchor_t, Node> anchors_;
    std::size_t nodes_ = 0;
};

}  // namespace

const Node* Node::find(std::string_view name) const {
    if (type != Type::map) return nullptr;
    for (const Node& child : children) {
        if (child.key == name) return &child;
    }
    return nullptr;
}

Node* Node::find(std::string_view name) {
    return const_cast<Node*>(std::as_const(*this).find(name));
}

Node parse_document(const std::string& text, const Origin& whole) {
    check_syntax(text, whole);
    Builder builder(whole);
    std::istringstream stream(text);
    YAML::Parser parser(stream);
    parser.HandleNextDocument(builder);
    Node root = builder.take();
    if (root.type == Node::Type::null && root.origin.source.empty()) root.origin = whole;
    return root;
}

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

}  // namespace magfsi::scene
