// SPDX-License-Identifier: GPL-2.0-or-later
// Checks keys and values of a tree against the table of keys.
#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <charconv>

#include "adapters/scene/fault.h"
#include "adapters/scene/field.h"
#include "adapters/scene/formula_units.h"
#include "adapters/scene/quantity.h"
#include "base/words/plain_text.h"

namespace magfsi::scene {

namespace {

// Refuses a value with the description of what its key allows.
[[noreturn]] void refuse_value(const Node& node, const Field& field) {
    refuse(node.origin, fmt::format("{} as {}", describe(node), field.name),
           expectation(field));
}

// The range is in SI units, and so is the value.
void check_range(double value, const Node& node, const Field& field) {
    if (field.range.holds(value)) return;
    refuse(node.origin, fmt::format("{} as {}", describe(node), field.name),
           "values " + describe(field.range, field.unit));
}

// Names become parts of column names, file names and LAMMPS identifiers, so only ASCII
// letters, digits and "_" are allowed.
bool is_identifier(std::string_view name) {
    const auto letter = [](char c) {
        return std::isalpha(static_cast<unsigned char>(c));
    };
    const auto inner = [](char c) {
        return std::isalnum(static_cast<unsigned char>(c)) || c == '_';
    };
    return !name.empty() && letter(name[0]) &&
           std::all_of(name.begin(), name.end(), inner);
}

void check_identifier(const std::string& name, const Origin& where) {
    if (is_identifier(name)) return;
    refuse(where, fmt::format("the name {}", in_quotes(name)),
           "letters, digits and _, a letter first");
}

// Items of a list whose length is within the limits of the field.
std::vector<const Node*> items(const Node& node, const Field& field) {
    if (node.type != Node::Type::sequence || node.children.size() < field.count_min ||
        node.children.size() > field.count_max)
        refuse_value(node, field);
    std::vector<const Node*> list;
    for (const Node& child : node.children) list.push_back(&child);
    return list;
}

// Scalars of all rows, row by row.
std::vector<const Node*> rows(const Node& node, const Field& field) {
    std::vector<const Node*> list;
    for (const Node* row : items(node, field)) {
        if (row->type != Node::Type::sequence || row->children.size() != field.length)
            refuse(row->origin, fmt::format("{} in {}", describe(*row), field.name),
                   expectation(field));
        for (const Node& child : row->children) list.push_back(&child);
    }
    return list;
}

}  // namespace

// one_or_list accepts a scalar in place of a list.
std::vector<const Node*> scalars(const Node& node, const Field& field) {
    std::vector<const Node*> list;
    if (field.layout == Layout::rows) {
        list = rows(node, field);
    } else if (field.layout == Layout::single ||
               (field.layout == Layout::one_or_list && node.type == Node::Type::scalar)) {
        list = {&node};
    } else {
        list = items(node, field);
    }
    for (const Node* scalar : list) {
        if (scalar->type != Node::Type::scalar) refuse_value(*scalar, field);
    }
    return list;
}

// parse_quantity knows no place in the file, which is added here.
double number_value(const Node& scalar, const Field& field) {
    double value = 0;
    try {
        value = parse_quantity(scalar.scalar, field.unit);
    } catch (const Complaint& complaint) {
        refuse(scalar.origin, complaint);
    }
    check_range(value, scalar, field);
    return value;
}

// Typographic minus signs and blanks are converted first; then the whole text must be the
// number.
int integer_value(const Node& scalar, const Field& field) {
    const std::string text = words::plain(scalar.scalar);
    int value = 0;
    const auto [end, error] =
        std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc{} || end != text.data() + text.size())
        refuse_value(scalar, field);
    check_range(value, scalar, field);
    return value;
}

// Only `true` and `false`: YAML 1.1's yes, no, on and off are refused.
bool boolean_value(const Node& scalar, const Field& field) {
    if (scalar.scalar == "true") return true;
    if (scalar.scalar == "false") return false;
    refuse_value(scalar, field);
}

// Control characters are refused, since texts are written to logs and terminals.
std::string text_value(const Node& scalar, const Field& field) {
    if (field.kind == Kind::identifier) check_identifier(scalar.scalar, scalar.origin);
    const auto control = [](char c) { return static_cast<unsigned char>(c) < ' '; };
    if (scalar.scalar.empty() || std::ranges::any_of(scalar.scalar, control))
        refuse_value(scalar, field);
    return scalar.scalar;
}

// Both texts are kept: the one as written for messages, the one in SI for the solvers.
structure::Formula formula_value(const Node& scalar, const Field& field) {
    const std::string text = text_value(scalar, field);
    try {
        return {.written = text, .si = formula_in_si(text, field.unit)};
    } catch (const Complaint& complaint) {
        refuse(scalar.origin, complaint);
    }
}

namespace {

// Former words of a key, with the advice that replaces them.
struct RemovedWord {
    std::string_view key, word, instead;
};
constexpr RemovedWord removed_words[] = {
    {"collision", "recursive_odd",
     "it made the fluid thicker in a stream, and was removed: leave the key out, or "
     "write recursive_regularized"},
    {"scheme", "parallel",
     "it was removed: write serial, from which it differed by a term of first order in "
     "the step"},
    {"acceleration", "under_relaxation",
     "it was removed: write aitken, which finds the factor by itself, or leave the key "
     "out for iqn_ils"},
    {"precision", "float_double", "it was removed: write float, or double"},
    {"element", "mean_f",
     "it was removed: write assumed_strain, which bends and twists as the solid does"},
};

// Advice for a removed word, else the most similar one.
std::string advice_on_word(const std::string& word, const Field& field) {
    for (const RemovedWord& entry : removed_words) {
        if (entry.key == field.name && entry.word == word)
            return std::string(entry.instead);
    }
    return did_you_mean(word, field.choices);
}

}  // namespace

// Index of the word in the list of choices.
std::size_t choice_value(const Node& scalar, const Field& field) {
    const auto found = std::ranges::find(field.choices, scalar.scalar);
    if (found == field.choices.end())
        refuse(scalar.origin, fmt::format("{} as {}", describe(scalar), field.name),
               expectation(field), advice_on_word(scalar.scalar, field));
    return found - field.choices.begin();
}

namespace {

// Name of a group for errors.
std::string place(const std::string& name) {
    return name.empty() ? "the scene" : fmt::format("\"{}\"", name);
}

// Checks that exactly one alternative is present, or at most one if they are optional.
void check_alternatives(const Node& node, const Field& field, const std::string& where) {
    std::vector<std::string> all;
    const Node* first = nullptr;
    for (const Field& child : field.children) {
        if (child.presence == Presence::alternative ||
            child.presence == Presence::optional_alternative)
            all.push_back(child.name);
    }
    if (all.empty()) return;
    const bool needed = std::ranges::none_of(field.children, [](const Field& child) {
        return child.presence == Presence::optional_alternative;
    });
    for (const Node& child : node.children) {
        if (std::ranges::find(all, child.key) == all.end()) continue;
        if (first)
            refuse(
                child.key_origin,
                fmt::format("both \"{}\" and \"{}\" in {}", first->key, child.key, where),
                "exactly one of " + joined(all));
        first = &child;
    }
    if (!first && needed)
        refuse(node.origin, fmt::format("none of the alternatives in {}", where),
               "exactly one of " + joined(all));
}

// Reports the first missing key with its description.
void check_required(const Node& node, const Field& field, const std::string& where) {
    for (const Field& child : field.children) {
        if (child.presence != Presence::required || node.find(child.name)) continue;
        refuse(node.origin, fmt::format("no key \"{}\" in {}", child.name, where),
               fmt::format("{}: {}", child.name, expectation(child)));
    }
}

// Former names of keys.
struct Renamed {
    std::string_view group, old_name, new_name;
};
constexpr Renamed renamed[] = {
    {"iteration", "most", "max_iterations"},
    {"iteration", "unconverged", "on_no_convergence"},
    {"iteration", "first_guess", "initial_guess"},
    {"iteration", "columns", "max_used_iterations"},
    {"checkpoint", "retries", "max_retries"},
};

// Former keys that have no successor, with the advice that replaces them.
struct RemovedKey {
    std::string_view group, name, instead;
};
constexpr std::string_view markers_follow =
    "it was removed: markers follow from the body's shape and the fluid's spacing; leave "
    "the key out";
constexpr RemovedKey removed_keys[] = {
    {"iteration", "filter",
     "it was removed: leave it out; columns are dropped as qr2 did, by filter_limit"},
    {"immersed_boundary", "iterations",
     "it was removed: leave it out, and take forcing: no_slip where less slip is wanted"},
    {"immersed_boundary", "markers", markers_follow},
    {"immersed_boundary", "marker_spacing", markers_follow},
    {"immersed_boundary", "retraction", markers_follow},
    {"immersed_boundary", "rim_retraction", markers_follow},
};

// Advice about an unknown key: its new name, its replacement, the group that it belongs
// to, or the most similar key; "" if none applies.
std::string advice(const std::string& key, const Field& group) {
    for (const Renamed& entry : renamed) {
        if (entry.group == group.name && entry.old_name == key)
            return fmt::format("it is now called {}", in_quotes(entry.new_name));
    }
    for (const RemovedKey& entry : removed_keys) {
        if (entry.group == group.name && entry.name == key)
            return std::string(entry.instead);
    }
    std::vector<std::string> keys, owners;
    for (const Field& known : group.children) {
        keys.push_back(known.name);
        if (known.find(key)) owners.push_back(in_quotes(known.name));
    }
    if (owners.empty()) return did_you_mean(key, keys);
    return fmt::format("it is a key of {}", joined(owners));
}

// Checks a group. `where` is its name in errors. Unknown keys are reported before missing
// ones.
void check_group(const Node& node, const Field& field, const std::string& where) {
    if (node.type != Node::Type::map)
        refuse(node.origin, fmt::format("{} as {}", describe(node), where),
               expectation(field));
    for (const Node& child : node.children) {
        if (const Field* known = field.find(child.key)) {
            validate(child, *known);
            continue;
        }
        std::vector<std::string> keys;
        for (const Field& known : field.children) keys.push_back(known.name);
        refuse(child.key_origin,
               fmt::format("the unknown key {} in {}", in_quotes(child.key), where),
               joined(keys), advice(child.key, field));
    }
    check_required(node, field, where);
    check_alternatives(node, field, where);
}

// Each entry has a name of its own and is checked as a group.
void check_named(const Node& node, const Field& field) {
    if (node.type != Node::Type::map || node.children.empty())
        refuse(node.origin, fmt::format("{} as {}", describe(node), place(field.name)),
               expectation(field));
    for (const Node& child : node.children) {
        check_identifier(child.key, child.key_origin);
        check_group(child, field, place(child.key));
    }
}

// An empty list is refused: the key could be left out.
void check_list(const Node& node, const Field& field) {
    if (node.type != Node::Type::sequence || node.children.empty())
        refuse(node.origin, fmt::format("{} as {}", describe(node), place(field.name)),
               expectation(field));
    for (const Node& child : node.children)
        check_group(child, field, "an item of " + place(field.name));
}

// Checks a word that carries a map, such as "no_slip: {...}".
void check_choice_with_map(const Node& node, const Field& field) {
    if (node.children.size() != 1 || !field.find(node.children.front().key)) {
        std::vector<std::string> maps;
        for (const Field& child : field.children) maps.push_back(child.name);
        refuse(node.origin, fmt::format("{} as {}", describe(node), field.name),
               fmt::format("{}, or a map with one key of {}", expectation(field),
                           joined(maps)));
    }
    validate(node.children.front(), *field.find(node.children.front().key));
}

// Reads each value for its errors only. A list of words may have each word once.
void check_leaf(const Node& node, const Field& field) {
    std::vector<std::size_t> chosen;
    for (const Node* scalar : scalars(node, field)) {
        switch (field.kind) {
            case Kind::quantity:
                number_value(*scalar, field);
                break;
            case Kind::integer:
                integer_value(*scalar, field);
                break;
            case Kind::formula:
                formula_value(*scalar, field);
                break;
            case Kind::boolean:
                boolean_value(*scalar, field);
                break;
            case Kind::choice: {
                const std::size_t choice = choice_value(*scalar, field);
                if (std::ranges::find(chosen, choice) != chosen.end())
                    refuse(scalar->origin,
                           fmt::format("{} twice in {}", describe(*scalar), field.name),
                           "each entry once");
                chosen.push_back(choice);
                break;
            }
            default:
                text_value(*scalar, field);
        }
    }
}

}  // namespace

// Leaves are read for their errors; TreeReader reads them again for their values.
void validate(const Node& node, const Field& field) {
    switch (field.kind) {
        case Kind::group:
            return check_group(node, field, place(field.name));
        case Kind::named:
            return check_named(node, field);
        case Kind::list:
            return check_list(node, field);
        case Kind::choice:
            if (node.type == Node::Type::map && !field.children.empty())
                return check_choice_with_map(node, field);
            return check_leaf(node, field);
        default:
            return check_leaf(node, field);
    }
}

}  // namespace magfsi::scene
