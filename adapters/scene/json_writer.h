// Dumps the structs of scene.h in SI under the scene file's keys, through bind.h.
#pragma once

#include <nlohmann/json.hpp>

#include "adapters/scene/bind.h"
#include "adapters/scene/names.h"

namespace magfsi::scene {

class JsonWriter {
  public:
    nlohmann::ordered_json take() { return std::move(json_); }

    template <class T>
    void operator()(std::string_view key, T&& value) {
        JsonWriter inner;
        inner.write(value);
        if (!inner.json_.is_null()) json_[std::string(key)] = std::move(inner.json_);
    }

    template <class Body>
    void group(std::string_view key, const Body& body) {
        JsonWriter inner;
        body(inner);
        json_[std::string(key)] = std::move(inner.json_);
    }

    template <class... T>
    void alternatives(std::variant<T...>& value,
                      std::initializer_list<const char*> keys) {
        std::visit([&](auto& chosen) { (*this)(keys.begin()[value.index()], chosen); },
                   value);
    }

    template <class... T>
    void optional_alternatives(std::optional<std::variant<T...>>& value,
                               std::initializer_list<const char*> keys) {
        if (value) alternatives(*value, keys);
    }

    template <class Body>
    void effect(std::string_view key, bool there, const Body& body) {
        if (there) group(key, body);
    }

    template <class T>
    void whole(T&& value) {
        write(value);
    }

  private:
    void write(double value) { json_ = value; }
    void write(int value) { json_ = value; }
    void write(bool value) { json_ = value; }
    void write(const std::string& value) { json_ = value; }
    template <Named E>
    void write(E value) {
        json_ = name_of(value);
    }
    void write(const AxisRef& value) { json_ = axis_names[value.axis]; }
    void write(const PlaneRef& value) {
        json_ = std::string{static_cast<char>('x' + value.axes[0]),
                            static_cast<char>('x' + value.axes[1])};
    }
    // An absent effect has no key.
    template <class T>
    void write(std::optional<T>& value) {
        if (value) write(*value);
    }
    template <class T, std::size_t N>
    void write(std::array<T, N>& value) {
        json_ = nlohmann::ordered_json::array();
        for (T& item : value) append(item);
    }
    template <class T>
    void write(std::vector<T>& value) {
        if constexpr (requires(T item) { item.name; }) {
            for (T& item : value) (*this)(item.name, item);
        } else if (!value.empty()) {
            json_ = nlohmann::ordered_json::array();
            for (T& item : value) append(item);
        }
    }
    void write(std::array<Boundary, 6>& value) {
        for (std::size_t face = 0; face < value.size(); ++face)
            (*this)(names<Face>[face], value[face]);
    }
    void write(Boundary& value) {
        write(value.kind);
        const bool at_rest =
            value.kind == BoundaryKind::no_slip && value.wall_velocity_m_s == Vec3{};
        JsonWriter details;
        if (!at_rest) bind_details(details, value);
        if (details.json_.is_null()) return;
        json_ = {{name_of(value.kind), details.take()}};
    }
    template <class T>
    requires requires(JsonWriter& io, T& value) { bind_keys(io, value); }
    void write(T& value) { bind_keys(*this, value); }

    template <class T>
    void append(T& item) {
        JsonWriter inner;
        inner.write(item);
        json_.push_back(std::move(inner.json_));
    }

    nlohmann::ordered_json json_;
};

}  // namespace magfsi::scene
