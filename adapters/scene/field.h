// One key of the scene file: what may stand there, its unit, range, default and doc line.
// The table made of these (fields.h) drives reading, errors, schema and reference page.
#pragma once

#include <limits>
#include <string>
#include <string_view>
#include <vector>

#include "adapters/scene/names.h"

namespace magfsi::scene {

enum class Kind {
    group,       // map of the keys in children
    named,       // map from a name to a group of the keys in children
    list,        // list of groups of the keys in children
    quantity,    // number with a unit; SI unit "" is a plain number
    integer,     // whole number
    boolean,     // true or false
    text,        // one line
    identifier,  // letters, digits and _, a letter first
    choice,      // one of choices; a child of the same name lets the choice carry a map
};

// How many values stand at a leaf.
enum class Layout {
    single,
    vector,       // a list of exactly `length`
    list,         // a list of at least `count_min`
    one_or_list,  // one value, or a list
    rows,         // a list of count_min to count_max vectors of `length`
};

// alternative: exactly one of the alternatives of a group must be there;
// optional_alternative: at most one; chosen_by_accuracy: required unless the scene has
// the key accuracy.
enum class Presence {
    required,
    optional,
    alternative,
    optional_alternative,
    chosen_by_accuracy
};

struct Range {
    double low = -std::numeric_limits<double>::infinity();
    double high = std::numeric_limits<double>::infinity();
    bool low_open = false;  // low itself is not allowed
    bool holds(double value) const {
        return (low_open ? value > low : value >= low) && value <= high;
    }
};

struct Field {
    std::string name;
    Kind kind = Kind::group;
    std::string doc;
    std::string unit;  // SI
    std::vector<std::string> choices;
    std::vector<Field> children;

    Layout layout = Layout::single;
    std::size_t length = 0;
    std::size_t count_min = 0;
    std::size_t count_max = std::numeric_limits<std::size_t>::max();

    Range range;
    Presence presence = Presence::required;
    std::string fallback;  // YAML text of the default; "" when there is none

    const Field* find(std::string_view key) const;  // child

    // Modifiers, for one readable line a key in the table.
    Field optional() &&;
    Field alternative() &&;
    Field optional_alternative() &&;
    Field chosen_by_accuracy() &&;
    Field or_default(std::string_view yaml) &&;
    Field above(double low) &&;
    Field at_least(double low) &&;
    Field at_most(double high) &&;
    Field vector(std::size_t size) &&;
    Field list(std::size_t at_least = 1) &&;
    Field one_or_list() &&;
    Field rows(std::size_t size, std::size_t least, std::size_t most) &&;
    Field carrying(Field map) &&;  // a choice that may carry a map of keys
};

Field group(std::string_view name, std::string_view doc, std::vector<Field> children);
Field named(std::string_view name, std::string_view doc, std::vector<Field> children);
Field list_of(std::string_view name, std::string_view doc, std::vector<Field> children);
Field quantity(std::string_view name, std::string_view si_unit, std::string_view doc);
Field number(std::string_view name, std::string_view doc);
Field integer(std::string_view name, std::string_view doc);
Field boolean(std::string_view name, std::string_view doc);
Field text(std::string_view name, std::string_view doc);
Field identifier(std::string_view name, std::string_view doc);
Field one_of(std::string_view name, std::vector<std::string> choices,
             std::string_view doc);

template <std::size_t N>
std::vector<std::string> words(const std::array<std::string_view, N>& list) {
    return {list.begin(), list.end()};
}
template <Named E>
Field choice(std::string_view name, std::string_view doc) {
    return one_of(name, words(names<E>), doc);
}
inline Field axis(std::string_view name, std::string_view doc) {
    return one_of(name, words(axis_names), doc);
}
inline Field plane(std::string_view name, std::string_view doc) {
    return one_of(name, words(plane_names), doc);
}

bool is_leaf(const Field& field);

// What may stand there, in words: "3 values, each a length such as 0.2 mm".
std::string expectation(const Field& field);
// "above 0 m, at most 1 m"; "" without limits.
std::string describe(const Range& range, std::string_view unit);
// "a, b, c"
std::string joined(const std::vector<std::string>& words);

}  // namespace magfsi::scene
