// SPDX-License-Identifier: GPL-2.0-or-later
// The part of JSON Schema that scene_schema() uses, enough to hold scenes against it.
#pragma once

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>
#include <regex>
#include <set>
#include <stdexcept>
#include <string>

namespace magfsi::scene {

using Json = nlohmann::ordered_json;

bool accepts(const Json& schema, const Json& value);

inline bool has_type(const std::string& type, const Json& value) {
    if (type == "object") return value.is_object();
    if (type == "array") return value.is_array();
    if (type == "string") return value.is_string();
    if (type == "boolean") return value.is_boolean();
    if (type == "number") return value.is_number();
    if (type == "integer") return value.is_number_integer();
    throw std::invalid_argument("unknown type " + type);
}

inline int accepting(const Json& schemas, const Json& value) {
    int count = 0;
    for (const Json& schema : schemas) count += accepts(schema, value) ? 1 : 0;
    return count;
}

inline bool object_keys_accepted(const Json& schema, const Json& value) {
    static const Json none = Json::object();
    const Json& properties = schema.contains("properties") ? schema["properties"] : none;
    for (const auto& [key, inner] : value.items()) {
        if (schema.contains("propertyNames") &&
            !accepts(schema["propertyNames"], Json(key)))
            return false;
        if (properties.contains(key)) {
            if (!accepts(properties[key], inner)) return false;
        } else if (schema.contains("additionalProperties")) {
            const Json& others = schema["additionalProperties"];
            if (others.is_boolean() ? !others.get<bool>() : !accepts(others, inner))
                return false;
        }
    }
    return true;
}

inline bool rule_holds(const std::string& rule, const Json& bound, const Json& schema,
                       const Json& value) {
    if (rule == "type") return has_type(bound, value);
    if (rule == "enum")
        return std::find(bound.begin(), bound.end(), value) != bound.end();
    if (rule == "oneOf") return accepting(bound, value) == 1;
    if (rule == "anyOf") return accepting(bound, value) >= 1;
    if (rule == "not") return !accepts(bound, value);
    if (rule == "required") {
        return std::all_of(bound.begin(), bound.end(), [&](const Json& key) {
            return value.is_object() && value.contains(key.get<std::string>());
        });
    }
    if (rule == "properties" || rule == "additionalProperties" || rule == "propertyNames")
        return !value.is_object() || object_keys_accepted(schema, value);
    if (rule == "minProperties") return value.size() >= bound;
    if (rule == "items")
        return std::all_of(value.begin(), value.end(),
                           [&](const Json& item) { return accepts(bound, item); });
    if (rule == "minItems") return value.size() >= bound;
    if (rule == "maxItems") return value.size() <= bound;
    if (rule == "minLength") return value.get<std::string>().size() >= bound;
    if (rule == "minimum") return value >= bound;
    if (rule == "maximum") return value <= bound;
    if (rule == "exclusiveMinimum") return value > bound;
    if (rule == "pattern") {
        static std::map<std::string, std::regex> compiled;  // compiling is slow
        const std::string pattern = bound;
        const auto regex = compiled.try_emplace(pattern, pattern).first;
        return std::regex_search(value.get<std::string>(), regex->second);
    }
    static const std::set<std::string> notes = {"$schema", "title", "description",
                                                "default"};
    if (notes.contains(rule)) return true;
    throw std::invalid_argument("unknown rule " + rule);
}

inline bool accepts(const Json& schema, const Json& value) {
    // The type first: the other rules may then rely on it.
    if (schema.contains("type") && !has_type(schema["type"], value)) return false;
    for (const auto& [rule, bound] : schema.items()) {
        if (!rule_holds(rule, bound, schema, value)) return false;
    }
    return true;
}

}  // namespace magfsi::scene
