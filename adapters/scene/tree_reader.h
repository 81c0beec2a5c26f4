// SPDX-License-Identifier: GPL-2.0-or-later
// The visitor of keys (keys.h) that reads a scene from a validated tree.
#pragma once

#include <algorithm>
#include <optional>
#include <utility>
#include <variant>

#include "adapters/scene/field.h"
#include "adapters/scene/scene.h"

namespace magfsi::scene {

// A node of a validated tree with its entry in the table. An absent key leaves its member
// unchanged.
class TreeReader {
  public:
    TreeReader(const Node& node, const Field& field) : node_(&node), field_(&field) {}

    // Reads a key into its member if the file has it.
    template <class T>
    void operator()(const Field& key, T&& value) {
        if (const Node* node = node_->find(key.name))
            TreeReader(*node, *field_->find(key.name)).read(value);
    }

    // Reads a map whose keys belong to the same type as those around it.
    template <class Body>
    void group(const Field& key, bool, const Body& body) {
        const Node* node = node_->find(key.name);
        if (!node) return;
        TreeReader inner(*node, *field_->find(key.name));
        body(inner);
    }

    // Sets the variant to the alternative that is present; validate() has made sure of
    // their number.
    template <class... T, class... Keys>
    void alternatives(std::variant<T...>& value, const Keys&... keys) {
        (alternative<T>(value, keys), ...);
    }
    template <class... T, class... Keys>
    void alternatives(std::optional<std::variant<T...>>& value, const Keys&... keys) {
        (alternative<T>(value, keys), ...);
    }

    // Reads a word that carries a map, "word: {...}"; see whole() for the word alone.
    template <Named E, class Body>
    void word_with_map(E& value, E word, std::string_view, bool, const Body& body) {
        const Node* map = node_->find(name_of(word));
        if (!map) return;
        value = word;
        TreeReader inner(*map, *field_->find(map->key));
        body(inner);
    }

    // Reads the value that stands in the place of a map.
    template <class T>
    void whole(T&& value) {
        // A word that carries a map is read by word_with_map.
        if (!Named<std::decay_t<T>> || node_->type == Node::Type::scalar) read(value);
    }

  private:
    // An alternative starts from its default values.
    template <class T, class Variant>
    void alternative(Variant& value, const Field& key) {
        if (!node_->find(key.name)) return;
        T chosen{};
        (*this)(key, chosen);
        value = std::move(chosen);
    }

    void read(double& value) { value = number_value(*node_, *field_); }
    void read(int& value) { value = integer_value(*node_, *field_); }
    void read(bool& value) { value = boolean_value(*node_, *field_); }
    void read(std::string& value) { value = text_value(*node_, *field_); }
    void read(structure::Formula& value) { value = formula_value(*node_, *field_); }
    template <Named E>
    void read(E& value) {
        value = static_cast<E>(choice_value(*node_, *field_));
    }
    // An axis is stored as an index, a plane as the indices of its two axes.
    void read(AxisRef& value) { value.axis = choice_value(*node_, *field_); }
    void read(PlaneRef& value) {
        const std::string_view plane = plane_names[choice_value(*node_, *field_)];
        value.axes = {plane[0] - 'x', plane[1] - 'x'};
    }

    // Reads the scalars of a leaf one after the other into consecutive elements.
    template <class T>
    void read_each(T first) {
        for (const Node* scalar : scalars(*node_, *field_))
            TreeReader(*scalar, *field_).read(*first++);
    }
    template <FixedLength Row>
    void read(Row& value) {
        read_each(value.begin());
    }
    // Rows of vectors, read one after the other into the contiguous memory of the rows.
    template <FixedLength Row>
    void read(std::vector<Row>& value) {
        value.resize(scalars(*node_, *field_).size() / std::tuple_size_v<Row>);
        read_each(value.front().begin());
    }
    template <std::size_t M>
    void read(std::array<Vec3, M>& value) {
        read_each(value.front().begin());
    }
    // A key that is present makes the optional non-empty.
    template <class T>
    void read(std::optional<T>& value) {
        T inner{};
        read(inner);
        value = std::move(inner);
    }
    // A list of scalars, a list of maps, or a map by name.
    template <class T>
    void read(std::vector<T>& value) {
        value.clear();
        if (is_leaf(*field_)) {
            value.resize(scalars(*node_, *field_).size());
            read_each(value.begin());
            return;
        }
        for (const Node& child : node_->children) {
            T item{};
            TreeReader(child, *field_).read(item);
            if constexpr (HasName<T>) item.name = child.key;
            value.push_back(std::move(item));
        }
        // Names have no order in YAML; they are sorted alphabetically.
        if constexpr (HasName<T>) std::ranges::sort(value, {}, &T::name);
    }
    template <class T>
    void read(T& value) {
        keys(*this, value);
    }

    const Node* node_;
    const Field* field_;
};

}  // namespace magfsi::scene
