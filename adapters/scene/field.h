// SPDX-License-Identifier: GPL-2.0-or-later
// A key of the scene file as a table entry: what may stand there, its unit, range,
// default and doc line. keys.h makes the table from the keys_*.cpp; reading, errors,
// schema and reference page follow from it.
#pragma once

#include <array>
#include <limits>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "adapters/scene/document.h"
#include "structure/formula.h"

namespace magfsi::scene {

enum class Kind {
    group,       // map of the keys in children
    named,       // map from a name to a group of the keys in children
    list,        // list of groups of the keys in children
    quantity,    // number with a unit; SI unit "" is a plain number
    integer,     // whole number
    boolean,     // true or false
    text,        // one line
    formula,     // of the time t, whose value has the unit
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
// optional_alternative: at most one.
enum class Presence { required, optional, alternative, optional_alternative };

struct Range {
    double low = -std::numeric_limits<double>::infinity();
    double high = std::numeric_limits<double>::infinity();
    bool low_open = false;  // low itself is not allowed
    bool holds(double value) const {
        return (low_open ? value > low : value >= low) && value <= high;
    }
};

struct Field {
    static constexpr std::size_t unbounded = std::numeric_limits<std::size_t>::max();

    std::string name;
    std::string doc;
    std::string unit;  // SI
    Kind kind = Kind::group;
    std::vector<std::string> choices;
    std::vector<Field> children;

    Layout layout = Layout::single;
    std::size_t length = 0;
    std::size_t count_min = 1, count_max = unbounded;

    Range range;
    Presence presence = Presence::required;
    bool has_default = false;  // the value that the member has at first
    std::string fallback;      // it, as YAML text

    const Field* find(std::string_view key) const;  // child

    // What the member's type does not tell, for one readable line a key.
    Field optional() && { return present(Presence::optional); }
    Field alternative() && { return present(Presence::alternative); }
    Field by_default() && {
        has_default = true;
        return present(Presence::optional);
    }
    Field above(double low) && { return limited({low, range.high, true}); }
    Field at_least(double low) && { return limited({low, range.high, false}); }
    Field at_most(double high) && { return limited({range.low, high, range.low_open}); }
    Field one_or_list() && {
        layout = Layout::one_or_list;
        return std::move(*this);
    }
    Field rows(std::size_t least, std::size_t most) && {
        count_min = least;
        count_max = most;
        return std::move(*this);
    }
    Field identifier() && {
        kind = Kind::identifier;
        return std::move(*this);
    }

  private:
    Field present(Presence wanted) {
        presence = wanted;
        return std::move(*this);
    }
    Field limited(const Range& wanted) {
        range = wanted;
        return std::move(*this);
    }
};

// A key whose kind and layout follow from the member that it is stored in.
Field key(std::string_view name, std::string_view doc);
// A number with a unit.
Field quantity(std::string_view name, std::string_view si_unit, std::string_view doc);

// --- members that keys are stored in
// ----------------------------------------------------

template <class E>
concept Named = std::is_enum_v<E>;
template <class T>
concept HasName = requires(T item) {
    item.name;
};

// Integers that stand for words: "x" and "xz".
struct AxisRef {
    int& axis;
};
struct PlaneRef {
    std::array<int, 2>& axes;
};

bool is_leaf(const Field& field);

// What may stand there, in words: "3 values, each a length such as 0.2 mm".
std::string expectation(const Field& field);
// "above 0 m, at most 1 m"; "" without limits.
std::string describe(const Range& range, std::string_view unit);
// "a, b, c"
std::string joined(const std::vector<std::string>& words);

// --- validate.cpp: a tree against the table, throwing SceneError at the node's place ---

// Throws at the first unknown or missing key, wrong kind of node, value that cannot be
// read or leaves its range, and at alternatives given twice or not at all; keys are
// compared in the file's order.
void validate(const Node& node, const Field& field);

// The scalars of a leaf in order, whatever its layout; throws if the layout does not fit.
std::vector<const Node*> scalars(const Node& node, const Field& field);

double number_value(const Node& scalar, const Field& field);  // SI
int integer_value(const Node& scalar, const Field& field);
bool boolean_value(const Node& scalar, const Field& field);
std::string text_value(const Node& scalar, const Field& field);  // text and identifier
structure::Formula formula_value(const Node& scalar, const Field& field);
std::size_t choice_value(const Node& scalar, const Field& field);

}  // namespace magfsi::scene
