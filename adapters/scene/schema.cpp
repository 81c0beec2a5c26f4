#include "adapters/scene/schema.h"

#include <cmath>

#include "adapters/scene/fields.h"
#include "adapters/scene/tree_reader.h"

namespace magfsi::scene {

namespace {

using Json = nlohmann::ordered_json;

constexpr const char* number_pattern = R"(^\s*[-+]?(\d+\.?\d*|\.\d+)([eE][-+]?\d+)?)";
constexpr const char* identifier_pattern = "^[A-Za-z][A-Za-z0-9_]*$";

Json schema_of(const Field& field);

// The keys of a group; alternatives become oneOf.
Json object_schema(const Field& field) {
    Json schema = {{"type", "object"}, {"additionalProperties", false}};
    Json required = Json::array(), alternatives = Json::array();
    for (const Field& child : field.children) {
        schema["properties"][child.name] = schema_of(child);
        if (child.presence == Presence::required) required.push_back(child.name);
        if (child.presence == Presence::alternative)
            alternatives.push_back({{"required", Json::array({child.name})}});
    }
    if (!required.empty()) schema["required"] = required;
    if (!alternatives.empty()) schema["oneOf"] = alternatives;
    return schema;
}

// A map of this key alone.
Json only_key(const Field& field) {
    return {{"type", "object"},
            {"additionalProperties", false},
            {"required", Json::array({field.name})},
            {"properties", {{field.name, schema_of(field)}}}};
}

void add_range(Json& schema, const Range& range) {
    if (std::isfinite(range.low))
        schema[range.low_open ? "exclusiveMinimum" : "minimum"] = range.low;
    if (std::isfinite(range.high)) schema["maximum"] = range.high;
}

// A quantity is text: its range is the reader's business.
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

Json array_of(const Json& items, std::size_t least, std::size_t most) {
    Json schema = {{"type", "array"}, {"items", items}, {"minItems", least}};
    if (most < std::numeric_limits<std::size_t>::max()) schema["maxItems"] = most;
    return schema;
}

Json leaf_schema(const Field& field) {
    Json value = value_schema(field);
    const std::size_t least = field.count_min, most = field.count_max;
    switch (field.layout) {
        case Layout::vector:
        case Layout::list:
            return array_of(value, least, most);
        case Layout::one_or_list:
            return {{"anyOf", Json::array({value, array_of(value, least, most)})}};
        case Layout::rows:
            return array_of(array_of(value, field.length, field.length), least, most);
        case Layout::single:
            break;
    }
    return value;
}

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

// The default as it stands in YAML: numbers, booleans and lists of words keep their type.
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

Json schema_of(const Field& field) {
    Json schema = {{"description", field.doc}};
    schema.update(kind_schema(field));
    if (!field.fallback.empty())
        schema["default"] =
            default_value(field, parse_document(field.fallback, {field.name}));
    return schema;
}

}  // namespace

nlohmann::ordered_json scene_schema() {
    Json schema = {{"$schema", "https://json-schema.org/draft/2020-12/schema"},
                   {"title", "magfsi scene"}};
    schema.update(schema_of(scene_fields()));
    return schema;
}

}  // namespace magfsi::scene
