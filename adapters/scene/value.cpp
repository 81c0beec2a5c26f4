#include "adapters/scene/value.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <charconv>

#include "adapters/scene/quantity.h"
#include "adapters/scene/suggestion.h"

namespace magfsi::scene {

namespace {

[[noreturn]] void refuse_value(const Node& node, const Field& field) {
    refuse(node.origin, fmt::format("{} as {}", describe(node), field.name),
           expectation(field));
}

void check_range(double value, const Node& node, const Field& field) {
    if (field.range.holds(value)) return;
    refuse(node.origin, fmt::format("{} as {}", describe(node), field.name),
           "values " + describe(field.range, field.unit));
}

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

std::vector<const Node*> items(const Node& node, const Field& field) {
    if (node.type != Node::Type::sequence || node.children.size() < field.count_min ||
        node.children.size() > field.count_max)
        refuse_value(node, field);
    std::vector<const Node*> list;
    for (const Node& child : node.children) list.push_back(&child);
    return list;
}

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

int integer_value(const Node& scalar, const Field& field) {
    const std::string& text = scalar.scalar;
    int value = 0;
    const auto [end, error] =
        std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc{} || end != text.data() + text.size())
        refuse_value(scalar, field);
    check_range(value, scalar, field);
    return value;
}

bool boolean_value(const Node& scalar, const Field& field) {
    if (scalar.scalar == "true") return true;
    if (scalar.scalar == "false") return false;
    refuse_value(scalar, field);
}

std::string text_value(const Node& scalar, const Field& field) {
    if (field.kind == Kind::identifier) check_identifier(scalar.scalar, scalar.origin);
    const auto control = [](char c) { return static_cast<unsigned char>(c) < ' '; };
    if (scalar.scalar.empty() || std::ranges::any_of(scalar.scalar, control))
        refuse_value(scalar, field);
    return scalar.scalar;
}

std::size_t choice_value(const Node& scalar, const Field& field) {
    const auto found = std::ranges::find(field.choices, scalar.scalar);
    if (found == field.choices.end())
        refuse(scalar.origin, fmt::format("{} as {}", describe(scalar), field.name),
               expectation(field), did_you_mean(scalar.scalar, field.choices));
    return static_cast<std::size_t>(found - field.choices.begin());
}

void check_identifier(const std::string& name, const Origin& where) {
    if (is_identifier(name)) return;
    refuse(where, fmt::format("the name {}", in_quotes(name)),
           "letters, digits and _, a letter first");
}

}  // namespace magfsi::scene
