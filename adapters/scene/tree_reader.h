// Fills the structs of scene.h from a validated tree, through bind.h.
#pragma once

#include <algorithm>
#include <initializer_list>
#include <stdexcept>
#include <utility>

#include "adapters/scene/bind.h"
#include "adapters/scene/value.h"

namespace magfsi::scene {

// A place in the tree with its field. node may be null: the key is absent.
class TreeReader {
  public:
    TreeReader(const Node* node, const Field& field) : node_(node), field_(&field) {}

    // Reads the key into value; an absent key leaves its default: the table's if it has
    // one, else what value holds already.
    template <class T>
    void operator()(std::string_view key, T&& value) {
        const Field& field = child_field(key);
        const Node* node = node_ ? node_->find(key) : nullptr;
        if (!node && !field.fallback.empty()) {
            const Node fallback =
                parse_document(field.fallback, {"default of " + field.name});
            TreeReader(&fallback, field).whole(value);
        } else {
            TreeReader(node, field).whole(value);
        }
    }

    template <class Body>
    void group(std::string_view key, const Body& body) {
        TreeReader inner(node_ ? node_->find(key) : nullptr, child_field(key));
        body(inner);
    }

    template <class... T>
    void alternatives(std::variant<T...>& value,
                      std::initializer_list<const char*> keys) {
        const char* const* key = keys.begin();
        (read_alternative<T>(value, *key++), ...);
    }

    template <class... T>
    void optional_alternatives(std::optional<std::variant<T...>>& value,
                               std::initializer_list<const char*> keys) {
        const char* const* key = keys.begin();
        (read_alternative<T>(value, *key++), ...);
    }

    template <class Body>
    void effect(std::string_view key, bool, const Body& body) {
        if (node_ && node_->find(key)) group(key, body);
    }

    // Reads this place itself into value.
    template <class T>
    void whole(T&& value) {
        read(value);
    }

  private:
    const Field& child_field(std::string_view key) const {
        if (const Field* field = field_->find(key)) return *field;
        throw std::logic_error("bind.h names a key that the table lacks: " +
                               std::string(key));
    }

    std::vector<const Node*> nodes() const {
        return node_ ? scalars(*node_, *field_) : std::vector<const Node*>{};
    }

    template <class T, class Variant>
    void read_alternative(Variant& value, std::string_view key) {
        if (!node_ || !node_->find(key)) return;
        T chosen;
        (*this)(key, chosen);
        value = std::move(chosen);
    }

    void read(double& value) {
        if (node_) value = number_value(*node_, *field_);
    }
    void read(int& value) {
        if (node_) value = integer_value(*node_, *field_);
    }
    void read(bool& value) {
        if (node_) value = boolean_value(*node_, *field_);
    }
    void read(std::string& value) {
        if (node_) value = text_value(*node_, *field_);
    }
    template <Named E>
    void read(E& value) {
        if (node_) value = static_cast<E>(choice_value(*node_, *field_));
    }
    void read(const AxisRef& value) {
        if (node_) value.axis = static_cast<int>(choice_value(*node_, *field_));
    }
    void read(const PlaneRef& value) {
        if (!node_) return;
        const std::string_view plane = plane_names[choice_value(*node_, *field_)];
        value.axes = {plane[0] - 'x', plane[1] - 'x'};
    }

    template <std::size_t N>
    void read(std::array<double, N>& value) {
        std::ranges::transform(nodes(), value.begin(), [&](const Node* scalar) {
            return number_value(*scalar, *field_);
        });
    }
    template <std::size_t N>
    void read(std::array<int, N>& value) {
        std::ranges::transform(nodes(), value.begin(), [&](const Node* scalar) {
            return integer_value(*scalar, *field_);
        });
    }
    void read(std::vector<double>& value) {
        for (const Node* scalar : nodes())
            value.push_back(number_value(*scalar, *field_));
    }
    template <Named E>
    void read(std::vector<E>& value) {
        for (const Node* scalar : nodes())
            value.push_back(static_cast<E>(choice_value(*scalar, *field_)));
    }
    void read(std::vector<std::string>& value) {
        for (const Node* scalar : nodes()) value.push_back(text_value(*scalar, *field_));
    }
    // Rows of vectors.
    template <std::size_t N>
    void read(std::vector<std::array<double, N>>& value) {
        const std::vector<const Node*> all = nodes();
        value.resize(all.size() / N);
        for (std::size_t i = 0; i < all.size(); ++i)
            value[i / N][i % N] = number_value(*all[i], *field_);
    }
    template <std::size_t N, std::size_t M>
    void read(std::array<std::array<double, N>, M>& value) {
        std::vector<std::array<double, N>> list;
        read(list);
        std::ranges::copy(list, value.begin());
    }

    template <class T>
    void read(std::optional<T>& value) {
        if (!node_) return;
        T inner{};
        read(inner);
        value = std::move(inner);
    }
    void read(std::array<Boundary, 6>& value) {
        for (std::size_t face = 0; face < value.size(); ++face)
            (*this)(names<Face>[face], value[face]);
    }
    void read(Boundary& value) {
        if (node_->type == Node::Type::scalar) return read(value.kind);
        const Node& map = node_->children.front();
        value.kind =
            static_cast<BoundaryKind>(std::ranges::find(names<BoundaryKind>, map.key) -
                                      names<BoundaryKind>.begin());
        TreeReader details(&map, child_field(map.key));
        bind_details(details, value);
    }

    template <class T>
    void read(std::vector<T>& value) {
        if (!node_) return;
        for (const Node& child : node_->children) {
            T item;
            TreeReader inner(&child, *field_);
            bind_keys(inner, item);
            if constexpr (requires { item.name; }) item.name = child.key;
            value.push_back(std::move(item));
        }
        // Names have no order in YAML: theirs here is that of the alphabet.
        if constexpr (requires(T item) { item.name; })
            std::ranges::sort(value, {}, &T::name);
    }
    template <class T>
    requires requires(TreeReader& io, T& value) { bind_keys(io, value); }
    void read(T& value) { bind_keys(*this, value); }

    const Node* node_;
    const Field* field_;
};

}  // namespace magfsi::scene
