// SPDX-License-Identifier: GPL-2.0-or-later
// Descriptions of keys in words, for errors and the reference page.
#include "adapters/scene/field.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>

#include "adapters/scene/formula_units.h"
#include "adapters/scene/quantity.h"

namespace magfsi::scene {

namespace {

// Description of a single value, with its limits.
std::string one_value(const Field& field) {
    const std::string limits = describe(field.range, field.unit);
    const std::string tail = limits.empty() ? "" : ", " + limits;
    switch (field.kind) {
        case Kind::quantity:
            return dimension_expectation(field.unit) + tail;
        case Kind::integer:
            return "a whole number" + tail;
        case Kind::boolean:
            return "true or false";
        case Kind::text:
            return "one line of text";
        case Kind::formula:
            return formula_expectation(field.unit);
        case Kind::identifier:
            return "a name of letters, digits and _, a letter first";
        case Kind::choice:
            return "one of " + joined(field.choices);
        default:
            return "";
    }
}

// Description of a group, a named group or a list.
std::string container(const Field& field) {
    std::vector<std::string> keys;
    for (const Field& child : field.children) keys.push_back(child.name);
    if (field.kind == Kind::named) return "a map from names to maps with " + joined(keys);
    if (field.kind == Kind::list) return "a list of maps with " + joined(keys);
    return "a map with the keys " + joined(keys);
}

}  // namespace

const Field* Field::find(std::string_view key) const {
    for (const Field& child : children) {
        if (child.name == key) return &child;
    }
    return nullptr;
}

// Kind, layout and range are completed by Describer (keys.h) from the type of the member.
Field key(std::string_view name, std::string_view doc) {
    Field field;
    field.name = name;
    field.doc = doc;
    return field;
}

// The unit also decides the dimension that errors and the reference page name.
Field quantity(std::string_view name, std::string_view si_unit, std::string_view doc) {
    Field field = key(name, doc);
    field.unit = si_unit;
    return field;
}

bool is_leaf(const Field& field) {
    return field.kind != Kind::group && field.kind != Kind::named &&
           field.kind != Kind::list;
}

// Words for messages, in the order given.
std::string joined(const std::vector<std::string>& words) {
    return fmt::format("{}", fmt::join(words, ", "));
}

// Limits are printed with the unit's prefixes, as users write them.
std::string describe(const Range& range, std::string_view unit) {
    std::string text;
    if (std::isfinite(range.low))
        text = fmt::format("{} {}", range.low_open ? "above" : "at least",
                           format_si(range.low, unit));
    if (std::isfinite(range.high))
        text += fmt::format("{}at most {}", text.empty() ? "" : " and ",
                            format_si(range.high, unit));
    return text;
}

// For a leaf the value with its limits, repeated for lists; for groups the names of their
// keys.
std::string expectation(const Field& field) {
    if (!is_leaf(field)) return container(field);
    const std::string value = one_value(field);
    switch (field.layout) {
        case Layout::vector:
            return fmt::format("a list of {} values, each {}", field.length, value);
        case Layout::list:
            return field.count_min > 1
                       ? fmt::format("a list of at least {} values, each {}",
                                     field.count_min, value)
                       : fmt::format("a list, each {}", value);
        case Layout::one_or_list:
            if (field.or_true) return "true, a name, or a list of names";
            return fmt::format("{}, or a list of such", value);
        case Layout::rows:
            return fmt::format("a list of {}{} lists of {} values, each {}",
                               field.count_min == field.count_max ? "" : "at least ",
                               field.count_min, field.length, value);
        case Layout::single:
            break;
    }
    return value;
}

}  // namespace magfsi::scene
