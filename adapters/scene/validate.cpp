#include "adapters/scene/validate.h"

#include <fmt/format.h>

#include <algorithm>

#include "adapters/scene/suggestion.h"
#include "adapters/scene/value.h"

namespace magfsi::scene {

namespace {

std::string place(const std::string& name) {
    return name.empty() ? "the scene" : fmt::format("\"{}\"", name);
}

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

void check_required(const Node& node, const Field& field, const std::string& where) {
    for (const Field& child : field.children) {
        if (child.presence != Presence::required &&
            child.presence != Presence::chosen_by_accuracy)
            continue;
        if (node.find(child.name)) continue;
        refuse(node.origin, fmt::format("no key \"{}\" in {}", child.name, where),
               fmt::format("{}: {}", child.name, expectation(child)));
    }
}

// Keys that had another name once.
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

// What to do about a key that the group has not, or "".
std::string advice(const std::string& key, const Field& group) {
    for (const Renamed& entry : renamed) {
        if (entry.group == group.name && entry.old_name == key)
            return fmt::format("it is now called {}", in_quotes(entry.new_name));
    }
    std::vector<std::string> keys, owners;
    for (const Field& known : group.children) {
        keys.push_back(known.name);
        if (known.find(key)) owners.push_back(in_quotes(known.name));
    }
    if (owners.empty()) return did_you_mean(key, keys);
    return fmt::format("it is a key of {}", joined(owners));
}

// where: the group as errors call it.
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

void check_named(const Node& node, const Field& field) {
    if (node.type != Node::Type::map || node.children.empty())
        refuse(node.origin, fmt::format("{} as {}", describe(node), place(field.name)),
               expectation(field));
    for (const Node& child : node.children) {
        check_identifier(child.key, child.key_origin);
        check_group(child, field, place(child.key));
    }
}

void check_list(const Node& node, const Field& field) {
    if (node.type != Node::Type::sequence || node.children.empty())
        refuse(node.origin, fmt::format("{} as {}", describe(node), place(field.name)),
               expectation(field));
    for (const Node& child : node.children)
        check_group(child, field, "an item of " + place(field.name));
}

// "no_slip", or "no_slip: {...}" where the choice may carry a map.
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
