#include "adapters/scene/field.h"

#include <utility>

namespace magfsi::scene {

namespace {

Field make(Kind kind, std::string_view name, std::string_view doc) {
    Field field;
    field.kind = kind;
    field.name = name;
    field.doc = doc;
    return field;
}

Field make(Kind kind, std::string_view name, std::string_view doc,
           std::vector<Field> children) {
    Field field = make(kind, name, doc);
    field.children = std::move(children);
    return field;
}

}  // namespace

const Field* Field::find(std::string_view key) const {
    for (const Field& child : children) {
        if (child.name == key) return &child;
    }
    return nullptr;
}

Field Field::optional() && {
    presence = Presence::optional;
    return std::move(*this);
}

Field Field::alternative() && {
    presence = Presence::alternative;
    return std::move(*this);
}

Field Field::chosen_by_accuracy() && {
    presence = Presence::chosen_by_accuracy;
    return std::move(*this);
}

Field Field::optional_alternative() && {
    presence = Presence::optional_alternative;
    return std::move(*this);
}

Field Field::or_default(std::string_view yaml) && {
    presence = Presence::optional;
    fallback = yaml;
    return std::move(*this);
}

Field Field::above(double low) && {
    range.low = low;
    range.low_open = true;
    return std::move(*this);
}

Field Field::at_least(double low) && {
    range.low = low;
    return std::move(*this);
}

Field Field::at_most(double high) && {
    range.high = high;
    return std::move(*this);
}

Field Field::vector(std::size_t size) && {
    layout = Layout::vector;
    length = count_min = count_max = size;
    return std::move(*this);
}

Field Field::list(std::size_t at_least) && {
    layout = Layout::list;
    count_min = at_least;
    return std::move(*this);
}

Field Field::one_or_list() && {
    layout = Layout::one_or_list;
    count_min = 1;
    return std::move(*this);
}

Field Field::rows(std::size_t size, std::size_t least, std::size_t most) && {
    layout = Layout::rows;
    length = size;
    count_min = least;
    count_max = most;
    return std::move(*this);
}

Field Field::carrying(Field map) && {
    children.push_back(std::move(map));
    return std::move(*this);
}

Field group(std::string_view name, std::string_view doc, std::vector<Field> children) {
    return make(Kind::group, name, doc, std::move(children));
}

Field named(std::string_view name, std::string_view doc, std::vector<Field> children) {
    return make(Kind::named, name, doc, std::move(children));
}

Field list_of(std::string_view name, std::string_view doc, std::vector<Field> children) {
    return make(Kind::list, name, doc, std::move(children));
}

Field quantity(std::string_view name, std::string_view si_unit, std::string_view doc) {
    Field field = make(Kind::quantity, name, doc);
    field.unit = si_unit;
    return field;
}

Field number(std::string_view name, std::string_view doc) {
    return make(Kind::quantity, name, doc);
}

Field integer(std::string_view name, std::string_view doc) {
    return make(Kind::integer, name, doc);
}

Field boolean(std::string_view name, std::string_view doc) {
    return make(Kind::boolean, name, doc);
}

Field text(std::string_view name, std::string_view doc) {
    return make(Kind::text, name, doc);
}

Field identifier(std::string_view name, std::string_view doc) {
    return make(Kind::identifier, name, doc);
}

Field one_of(std::string_view name, std::vector<std::string> choices,
             std::string_view doc) {
    Field field = make(Kind::choice, name, doc);
    field.choices = std::move(choices);
    return field;
}

bool is_leaf(const Field& field) {
    return field.kind != Kind::group && field.kind != Kind::named &&
           field.kind != Kind::list;
}

}  // namespace magfsi::scene
