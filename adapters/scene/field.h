// SPDX-License-Identifier: GPL-2.0-or-later
// Description of a key of the scene file: its kind, unit, range, default and
// documentation. keys.h builds the table of all keys from the keys_*.cpp; reading,
// errors, JSON schema and reference page follow from that table.
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

// Kind of a key's value. The first three are groups of keys, the others leaves.
enum class Kind {
    group,       // map of the keys in `children`
    named,       // map from a name to a group of `children`
    list,        // list of groups of `children`
    quantity,    // number with a unit; SI unit "": plain number
    integer,     // whole number
    boolean,     // true or false
    text,        // one line
    formula,     // function of the time t; its value has the unit
    identifier,  // letters, digits and _, a letter first
    choice,      // word of `choices`; a child of that name gives it a map
};

// Number and arrangement of values at a leaf.
enum class Layout {
    single,
    vector,       // list of exactly `length` values
    list,         // list of at least `count_min` values
    one_or_list,  // one value, or a list
    rows,         // list of count_min to count_max vectors of `length`
};

// Presence of a key. Of all `alternative` keys of a group exactly one must be present, of
// all `optional_alternative` keys at most one.
enum class Presence { required, optional, alternative, optional_alternative };

// Allowed interval of a number, in SI units, both ends included unless low_open.
struct Range {
    double low = -std::numeric_limits<double>::infinity();
    double high = std::numeric_limits<double>::infinity();
    bool low_open = false;  // `low` itself is not allowed
    bool holds(double value) const {
        return (low_open ? value > low : value >= low) && value <= high;
    }
};

// A key with all that is known of it.
struct Field {
    static constexpr std::size_t unbounded = std::numeric_limits<std::size_t>::max();

    std::string name;
    std::string doc;
    std::string unit;  // SI unit
    Kind kind = Kind::group;
    std::vector<std::string> choices;
    std::vector<Field> children;

    Layout layout = Layout::single;
    std::size_t length = 0;
    std::size_t count_min = 1, count_max = unbounded;

    bool or_true = false;  // the word true may stand in place of a name
    Range range;
    Presence presence = Presence::required;
    bool has_default = false;  // the member's initial value is the default
    std::string fallback;      // the default as YAML text

    const Field* find(std::string_view key) const;  // child by name, or null

    // Modifiers for what the member's type does not tell, chained so that a key fits on a
    // readable line.
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
    Field true_or_list() && {
        or_true = true;
        return std::move(*this).one_or_list();
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

// Makes a key whose kind and layout follow from the type of the member that stores it.
Field key(std::string_view name, std::string_view doc);
// Makes a key for a number with a unit.
Field quantity(std::string_view name, std::string_view si_unit, std::string_view doc);

// --- members that keys are stored in
// ----------------------------------------------------

template <class E>
concept Named = std::is_enum_v<E>;
// Arrays and vectors, whose number of elements is fixed.
template <class T>
concept FixedLength = (std::tuple_size<T>::value > 0);
template <class T>
concept HasName = requires(T item) {
    item.name;
};

// References to integers that the file gives as words, such as "x" (an axis) and "xz" (a
// plane).
struct AxisRef {
    int& axis;
};
struct PlaneRef {
    std::array<int, 2>& axes;
};

// True unless the key is a group, a named group or a list of groups.
bool is_leaf(const Field& field);

// Description of the allowed values, for errors: "a list of 3 values, each a length such
// as 0.2 mm".
std::string expectation(const Field& field);
// Description of a range such as "above 0 m and at most 1 m"; "" without limits.
std::string describe(const Range& range, std::string_view unit);
// The words separated by commas.
std::string joined(const std::vector<std::string>& words);

// --- validate.cpp: a tree against the table, throwing SceneError at the node's place ---

// Checks a tree against the table in the file's order. Throws SceneError at the first
// unknown or missing key, wrong kind of node, value that cannot be read or is out of
// range, and at alternatives given twice or not at all.
void validate(const Node& node, const Field& field);

// The scalars of a leaf in the file's order, whatever its layout. Throws SceneError if
// the layout does not fit.
std::vector<const Node*> scalars(const Node& node, const Field& field);

// Value of a scalar, by the kind of its key. All throw SceneError for a value that cannot
// be read or is out of range. Numbers are in SI units; a choice is given by its index.
double number_value(const Node& scalar, const Field& field);
int integer_value(const Node& scalar, const Field& field);
bool boolean_value(const Node& scalar, const Field& field);
// For both text and identifier.
std::string text_value(const Node& scalar, const Field& field);
structure::Formula formula_value(const Node& scalar, const Field& field);
std::size_t choice_value(const Node& scalar, const Field& field);

}  // namespace magfsi::scene
