// The visitor that makes the table of keys (keys.h), with defaults from the members.
#pragma once

#include <fmt/format.h>

#include <optional>
#include <utility>
#include <variant>

#include "adapters/scene/field.h"
#include "adapters/scene/scene.h"

namespace magfsi::scene {

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

// --- defaults as YAML text ----------------------------------------------------------

std::string yaml_text(double value, const std::string& unit);
inline std::string yaml_text(int value, const std::string&) {
    return std::to_string(value);
}
inline std::string yaml_text(bool value, const std::string&) {
    return value ? "true" : "false";
}
inline std::string yaml_text(const std::string& value, const std::string&) {
    return value;
}
template <Named E>
std::string yaml_text(E value, const std::string&) {
    return std::string(name_of(value));
}
inline std::string yaml_text(const AxisRef& value, const std::string&) {
    return std::string(axis_names[static_cast<std::size_t>(value.axis)]);
}
inline std::string yaml_text(const PlaneRef& value, const std::string&) {
    return {static_cast<char>('x' + value.axes[0]),
            static_cast<char>('x' + value.axes[1])};
}
inline std::string yaml_text(const Boundary& side, const std::string&) {
    return std::string(name_of(side.kind));
}
template <class List>
requires requires(const List& list) {
    yaml_text(*list.begin(), "");
}
std::string yaml_text(const List& list, const std::string& unit) {
    std::string text;
    for (const auto& item : list)
        text += (text.empty() ? "[" : ", ") + yaml_text(item, unit);
    return text + "]";
}

// --- the table ----------------------------------------------------------------------

class Describer {
  public:
    explicit Describer(Field& field) : field_(&field) {}

    template <class T>
    void operator()(Field key, T&& value) {
        if constexpr (requires { yaml_text(value, key.unit); }) {
            if (key.has_default) key.fallback = yaml_text(value, key.unit);
        }
        Describer(key).describe(value);
        field_->children.push_back(std::move(key));
    }

    // Keys of a map that is no type of its own; there: whether the map is written.
    template <class Body>
    void group(Field key, bool, const Body& body) {
        Describer inner(key);
        body(inner);
        field_->children.push_back(std::move(key));
    }

    // Exactly one of the keys, for each type of the variant in its order.
    template <class... T, class... Keys>
    void alternatives(std::variant<T...>&, Keys... keys) {
        (alternative<T>(std::move(keys), Presence::alternative), ...);
    }
    // At most one.
    template <class... T, class... Keys>
    void alternatives(std::optional<std::variant<T...>>&, Keys... keys) {
        (alternative<T>(std::move(keys), Presence::optional_alternative), ...);
    }

    // A word that may stand alone, or carry a map of keys.
    template <Named E>
    void word(E& value) {
        describe(value);
    }
    template <Named E, class Body>
    void word_with_map(E&, E word, std::string_view doc, bool, const Body& body) {
        group(key(name_of(word), doc), true, body);
    }

    // This place itself.
    template <class T>
    void whole(T&& value) {
        describe(value);
    }

  private:
    template <class T>
    void alternative(Field key, Presence presence) {
        T value{};
        key.presence = presence;
        (*this)(std::move(key), value);
    }

    void leaf(Kind kind) {
        if (field_->kind == Kind::group) field_->kind = kind;
    }
    void describe(double&) { leaf(Kind::quantity); }
    void describe(int&) { leaf(Kind::integer); }
    void describe(bool&) { leaf(Kind::boolean); }
    void describe(std::string&) { leaf(Kind::text); }
    template <std::size_t N>
    void words(const std::array<std::string_view, N>& list) {
        leaf(Kind::choice);
        field_->choices.assign(list.begin(), list.end());
    }
    template <Named E>
    void describe(E&) {
        words(names<E>);
    }
    void describe(AxisRef&) { words(axis_names); }
    void describe(PlaneRef&) { words(plane_names); }

    template <class T>
    void describe(std::optional<T>&) {
        if (field_->presence == Presence::required) field_->presence = Presence::optional;
        T value{};
        describe(value);
    }
    template <class T, std::size_t N>
    void describe(std::array<T, N>& value) {
        describe(value[0]);
        field_->layout = Layout::vector;
        field_->length = field_->count_min = field_->count_max = N;
    }
    template <std::size_t N, std::size_t M>
    void describe(std::array<std::array<double, N>, M>& value) {
        describe(value[0]);
        field_->layout = Layout::rows;
        field_->count_min = field_->count_max = M;
    }
    template <std::size_t N>
    void describe(std::vector<std::array<double, N>>&) {
        leaf(Kind::quantity);
        field_->layout = Layout::rows;
        field_->length = N;
    }
    template <class T>
    void describe(std::vector<T>&) {
        T item{};
        describe(item);
        if (!is_leaf(*field_))
            field_->kind = HasName<T> ? Kind::named : Kind::list;
        else if (field_->layout == Layout::single)
            field_->layout = Layout::list;
    }
    template <class T>
    void describe(T& value) {
        keys(*this, value);
    }

    Field* field_;
};

}  // namespace magfsi::scene
