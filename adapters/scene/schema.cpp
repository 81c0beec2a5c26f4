// SPDX-License-Identifier: GPL-2.0-or-later
// Makes the JSON Schema and docs/scene.md from the table of keys.
#include "adapters/scene/schema.h"

#include <fmt/format.h>

#include <cmath>
#include <utility>
#include <vector>

#include "adapters/scene/keys.h"

namespace magfsi::scene {

namespace {

using Json = nlohmann::ordered_json;

// Patterns of a decimal number at the start of a text, and of a name (is_identifier in
// validate.cpp).
constexpr const char* number_pattern = R"(^\s*[-+]?(\d+\.?\d*|\.\d+)([eE][-+]?\d+)?)";
constexpr const char* identifier_pattern = "^[A-Za-z][A-Za-z0-9_]*$";

Json schema_of(const Field& field);

// Schema of a group of keys. Alternatives become oneOf; if none is an admissible choice,
// "none of them" becomes one of the options.
Json object_schema(const Field& field) {
    Json schema = {{"type", "object"}, {"additionalProperties", false}};
    Json required = Json::array(), alternatives = Json::array();
    bool may_have_none = false;
    for (const Field& child : field.children) {
        schema["properties"][child.name] = schema_of(child);
        if (child.presence == Presence::required) required.push_back(child.name);
        const bool optional = child.presence == Presence::optional_alternative;
        if (child.presence == Presence::alternative || optional)
            alternatives.push_back({{"required", Json::array({child.name})}});
        may_have_none = may_have_none || optional;
    }
    if (may_have_none) alternatives.push_back({{"not", {{"anyOf", alternatives}}}});
    if (!required.empty()) schema["required"] = required;
    if (!alternatives.empty()) schema["oneOf"] = alternatives;
    return schema;
}

// Schema of a map that has this key only.
Json only_key(const Field& field) {
    return {{"type", "object"},
            {"additionalProperties", false},
            {"required", Json::array({field.name})},
            {"properties", {{field.name, schema_of(field)}}}};
}

// Limits of plain numbers; infinite ones are left out.
void add_range(Json& schema, const Range& range) {
    if (std::isfinite(range.low))
        schema[range.low_open ? "exclusiveMinimum" : "minimum"] = range.low;
    if (std::isfinite(range.high)) schema["maximum"] = range.high;
}

// Schema of a single value. A quantity is text, whose range only the reader can check.
Json value_schema(const Field& field) {
    switch (field.kind) {
        case Kind::quantity: {
            if (field.unit == "%")
                return {{"type", "string"},
                        {"pattern", std::string(number_pattern) + R"(\s*%\s*$)"}};
            if (!field.unit.empty())
                return {
                    {"type", "string"},
                    {"pattern", std::string(number_pattern) + R"(\s*\S*[A-Za-z].*$)"}};
            Json schema = {{"type", "number"}};
            add_range(schema, field.range);
            return schema;
        }
        case Kind::formula:  // the number 0 is a formula, too
            return {{"anyOf", Json::array({{{"type", "string"}}, {{"type", "number"}}})}};
        case Kind::integer: {
            Json schema = {{"type", "integer"}};
            add_range(schema, field.range);
            return schema;
        }
        case Kind::boolean:
            return {{"type", "boolean"}};
        case Kind::identifier:
            return {{"type", "string"}, {"pattern", identifier_pattern}};
        case Kind::choice: {
            Json words = {{"enum", field.choices}};
            if (field.children.empty()) return words;
            Json either = Json::array({words});
            for (const Field& map : field.children) either.push_back(only_key(map));
            return {{"anyOf", either}};
        }
        default:
            return {{"type", "string"}, {"minLength", 1}};
    }
}

// Schema of a list of `least` to `most` items.
Json array_of(const Json& items, std::size_t least, std::size_t most) {
    Json schema = {{"type", "array"}, {"items", items}, {"minItems", least}};
    if (most < std::numeric_limits<std::size_t>::max()) schema["maxItems"] = most;
    return schema;
}

// Schema of a leaf, from its value and layout.
Json leaf_schema(const Field& field) {
    Json value = value_schema(field);
    const std::size_t least = field.count_min, most = field.count_max;
    switch (field.layout) {
        case Layout::vector:
        case Layout::list:
            return array_of(value, least, most);
        case Layout::one_or_list: {
            Json either = Json::array({value, array_of(value, least, most)});
            if (field.or_true) either.push_back({{"const", true}});
            return {{"anyOf", either}};
        }
        case Layout::rows:
            return array_of(array_of(value, field.length, field.length), least, most);
        case Layout::single:
            break;
    }
    return value;
}

// Schema of a key by its kind; lists and named groups repeat the schema of a group.
Json kind_schema(const Field& field) {
    switch (field.kind) {
        case Kind::group:
            return object_schema(field);
        case Kind::named:
            return {{"type", "object"},
                    {"minProperties", 1},
                    {"propertyNames", {{"pattern", identifier_pattern}}},
                    {"additionalProperties", object_schema(field)}};
        case Kind::list:
            return array_of(object_schema(field), 1,
                            std::numeric_limits<std::size_t>::max());
        default:
            return leaf_schema(field);
    }
}

// Default value for the schema: numbers, booleans and lists of words keep their type.
Json default_value(const Field& field, const Node& node) {
    if (node.type == Node::Type::sequence) {
        Json list = Json::array();
        for (const Node& child : node.children)
            list.push_back(default_value(field, child));
        return list;
    }
    if (field.kind == Kind::boolean) return boolean_value(node, field);
    if (field.kind == Kind::integer) return integer_value(node, field);
    if (field.kind == Kind::quantity && field.unit.empty())
        return number_value(node, field);
    return node.scalar;
}

// The default is parsed from its YAML text, so that it has the type that the file would
// give it.
Json schema_of(const Field& field) {
    Json schema = {{"description", field.doc}};
    schema.update(kind_schema(field));
    if (!field.fallback.empty())
        schema["default"] =
            default_value(field, parse_document(field.fallback, {field.name}));
    return schema;
}

}  // namespace

// The scene as a whole is a group like any other.
nlohmann::ordered_json scene_schema() {
    Json schema = {{"$schema", "https://json-schema.org/draft/2020-12/schema"},
                   {"title", "magfsi scene"}};
    schema.update(schema_of(scene_fields()));
    return schema;
}

namespace {

constexpr std::string_view introduction =
    R"(# The scene file

<!-- Generated by magfsi-scene-reference from the field table; do not edit. -->

A scene is one YAML file. Its top-level keys are effects: an absent key is an absent effect.
Every number with a dimension carries its unit (`0.2 mm`, `17 mT`, `33 kPa`, `45 deg`,
`9.81 m/s2`, `600 1/s`); a number without one is refused there. Units are m, g, s, A, T, N,
Pa, J, W, Hz, rad, deg, min, h, bar and L, with SI prefixes and in products such as `kg/m3`
or `N m`. Angles in a plane such as `xz` run from its first axis to its second.

`--set path.to.key=value` replaces a value before the file is read, or adds it; an empty
value removes the key, and items of a list are numbered from 0. Names under `bodies` and
`probes.points` have no order: columns and files follow the alphabet.

Below each key stands what its value may be, and whether it has a default or is required.
"one of these" marks alternatives, of which exactly one is there; "at most one of these"
those of which none may be there as well. Groups of keys are folded.

`{x_min...z_max}` stands for each of the six sides: x_min, x_max, y_min, y_max, z_min, z_max.
)";

// Groups of more keys than this have a heading and are folded: all keys at once are fifty
// screens.
constexpr std::size_t most_unfolded = 3;

// Says whether a key must be there and what it is without: "required", "default ...".
std::string presence(const Field& field) {
    if (!field.fallback.empty()) return fmt::format("default `{}`", field.fallback);
    if (field.presence == Presence::alternative) return "one of these";
    if (field.presence == Presence::optional_alternative) return "at most one of these";
    return field.presence == Presence::required ? "required" : "";
}

// Says what the value of a key may be.
std::string value(const Field& field) {
    switch (field.kind) {
        case Kind::group:
            return "map";
        case Kind::named:
            return "map by name";
        case Kind::list:
            return "list of maps";
        default:
            return expectation(field);
    }
}

// "required; map": a line in italics.
std::string conditions(const Field& field) {
    const std::string first = presence(field);
    return fmt::format("*{}{}{}*", first, first.empty() ? "" : "; ", value(field));
}

// Path of a key's children: a name or an index stands between.
std::string inner_path(const Field& field, const std::string& path) {
    if (field.kind == Kind::named) return path + ".NAME";
    if (field.kind == Kind::list) return path + "[]";
    return path;
}

std::vector<std::string> items_of_children(const Field& field, const std::string& path);

// The items of a key and of all below it. A list instead of a table, whose column of
// paths alone is wider than a phone.
std::vector<std::string> items_of(const Field& field, const std::string& path) {
    std::vector<std::string> items{
        fmt::format("- **`{}`**: {}\\\n  {}\n", path, field.doc, conditions(field))};
    for (std::string& item : items_of_children(field, inner_path(field, path)))
        items.push_back(std::move(item));
    return items;
}

// True if two keys differ in nothing but their names, such as the sides of a box. They
// share their items.
bool alike(const Field& a, const Field& b) {
    return !a.children.empty() && a.doc == b.doc && a.fallback == b.fallback &&
           items_of_children(a, "") == items_of_children(b, "");
}

// A key of a group with its path in which keys that are alike share a name.
struct Entry {
    const Field* field;
    std::string path;
};

std::vector<Entry> entries_of(const Field& field, const std::string& path) {
    std::vector<Entry> entries;
    for (std::size_t i = 0; i < field.children.size(); ++i) {
        const Field& child = field.children[i];
        std::string name = child.name;
        while (i + 1 < field.children.size() && alike(child, field.children[i + 1])) ++i;
        if (&child != &field.children[i])
            name = fmt::format("{{{}...{}}}", name, field.children[i].name);
        entries.push_back({&child, path.empty() ? name : path + "." + name});
    }
    return entries;
}

std::vector<std::string> items_of_children(const Field& field, const std::string& path) {
    std::vector<std::string> items;
    for (const Entry& entry : entries_of(field, path))
        for (std::string& item : items_of(*entry.field, entry.path))
            items.push_back(std::move(item));
    return items;
}

// A group below a heading of its own, folded; the summary has the names next below.
std::string folded(const Entry& group) {
    const std::string inner = inner_path(*group.field, group.path);
    const auto items = items_of_children(*group.field, inner);
    std::vector<std::string> names;
    for (const Entry& entry : entries_of(*group.field, ""))
        names.push_back(fmt::format("<code>{}</code>", entry.path));
    return fmt::format(
        "\n### {}\n\n{}\\\n{}\n\n<details>\n<summary>{} keys: {}</summary>\n\n{}\n"
        "</details>\n",
        group.path, group.field->doc, conditions(*group.field), items.size(),
        fmt::join(names, ", "), fmt::join(items, ""));
}

// Keys of a section: small groups first, then each large one, folded.
std::string section_keys(const Field& section) {
    if (is_leaf(section))
        return fmt::format("\n{}", fmt::join(items_of(section, section.name), ""));
    std::string open, large;
    for (const Entry& entry : entries_of(section, inner_path(section, section.name))) {
        const auto items = items_of(*entry.field, entry.path);
        if (items.size() > most_unfolded)
            large += folded(entry);
        else
            open += fmt::format("{}", fmt::join(items, ""));
    }
    return (open.empty() ? "" : "\n" + open) + large;
}

}  // namespace

// One section for each top-level key.
std::string scene_reference_markdown() {
    std::string page(introduction);
    for (const Field& section : scene_fields().children)
        page += fmt::format("\n## {}\n\n{}{}\n{}", section.name, section.doc,
                            section.presence == Presence::required ? " Required." : "",
                            section_keys(section));
    return page;
}

}  // namespace magfsi::scene
