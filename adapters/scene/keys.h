// SPDX-License-Identifier: GPL-2.0-or-later
// The keys of the scene file, each declared once. keys_*.cpp have one function for each
// type of options: keys(io, value) names every key with its unit, range and meaning, and
// the member that stores it. Three visitors use it: Describer makes the table of all
// keys, TreeReader (tree_reader.h) reads a validated tree, and JsonWriter writes a
// scene's values. A key's kind, layout and default follow from its member.
#pragma once

#include <algorithm>
#include <nlohmann/json.hpp>
#include <numbers>
#include <optional>
#include <utility>
#include <variant>

#include "adapters/scene/field.h"
#include "adapters/scene/scene.h"
#include "adapters/scene/tree_reader.h"

namespace magfsi::scene {

// Table of the whole scene, as a group without a name.
const Field& scene_fields();

// --- writing ------------------------------------------------------------------------

// Visitor that writes values in SI units under the keys of the scene file. Absent values
// have no key.
class JsonWriter {
  public:
    template <class T>
    static nlohmann::ordered_json of(T& value) {
        JsonWriter writer;
        writer.write(value);
        return std::move(writer.json_);
    }

    // Optional numbers without a default use 0 for "not given" and are then left out.
    template <class T>
    void operator()(const Field& key, T&& value) {
        if constexpr (std::is_arithmetic_v<std::decay_t<T>>) {
            if (key.presence == Presence::optional && !key.has_default && value == 0)
                return;
        }
        add(key.name, of(value));
    }

    // Writes a map of keys if `there`.
    template <class Body>
    void group(const Field& key, bool there, const Body& body) {
        if (!there) return;
        JsonWriter inner;
        body(inner);
        add(key.name, std::move(inner.json_));
    }

    // Writes the alternative that the variant holds under the key of the same index.
    template <class... T, class... Keys>
    void alternatives(std::variant<T...>& value, const Keys&... keys) {
        const Field* list[] = {&keys...};
        std::visit([&](auto& chosen) { (*this)(*list[value.index()], chosen); }, value);
    }
    template <class... T, class... Keys>
    void alternatives(std::optional<std::variant<T...>>& value, const Keys&... keys) {
        if (value) alternatives(*value, keys...);
    }

    // Writes "word: {...}" over the plain word that whole() has written.
    template <Named E, class Body>
    void word_with_map(E& value, E word, std::string_view, bool there, const Body& body) {
        if (value != word || !there) return;
        json_ = nullptr;
        group(key(name_of(word), ""), true, body);
    }

    template <class T>
    void whole(T&& value) {
        write(value);
    }

  private:
    void add(const std::string& name, nlohmann::ordered_json value) {
        if (!value.is_null()) json_[name] = std::move(value);
    }

    template <class T>
    requires std::is_arithmetic_v<T> || std::is_same_v<T, std::string>
    void write(T& value) { json_ = value; }
    template <Named E>
    void write(E& value) {
        json_ = name_of(value);
    }
    // Formulas are written as the user gave them.
    void write(structure::Formula& value) { json_ = value.written; }
    void write(AxisRef& value) { json_ = axis_names[value.axis]; }
    void write(PlaneRef& value) {
        for (const std::string_view plane : plane_names) {
            if (plane[0] - 'x' == value.axes[0] && plane[1] - 'x' == value.axes[1])
                json_ = plane;
        }
    }
    template <class T>
    void write(std::optional<T>& value) {
        if (!value) return;
        write(*value);
        // An effect without a value of its own, such as contact: {}, is in the scene.
        if constexpr (std::is_class_v<T> && !requires { value->begin(); })
            if (json_.is_null()) json_ = nlohmann::ordered_json::object();
    }
    template <class List>
    void write_list(List& list) {
        json_ = nlohmann::ordered_json::array();
        for (auto& item : list) json_.push_back(of(item));
    }
    template <FixedLength Row>
    void write(Row& value) {
        write_list(value);
    }
    template <class T>
    void write(std::vector<T>& value) {
        if constexpr (HasName<T>) {
            for (T& item : value) (*this)(key(item.name, ""), item);
        } else if (!value.empty()) {
            write_list(value);
        }
    }
    template <class T>
    void write(T& value) {
        keys(*this, value);
    }

    nlohmann::ordered_json json_;
};

// --- the table ----------------------------------------------------------------------

// Text of a default value in YAML, with its unit.
std::string yaml_text(const nlohmann::ordered_json& value, const std::string& unit);

// Visitor that makes the table of keys, with defaults from the initial values of the
// members.
class Describer {
  public:
    explicit Describer(Field& field) : field_(&field) {}

    template <class T>
    void operator()(Field key, T&& value) {
        if (key.has_default) key.fallback = yaml_text(JsonWriter::of(value), key.unit);
        Describer(key).describe(value);
        field_->children.push_back(std::move(key));
    }

    // A map of keys without a type of its own. The bool tells JsonWriter whether to write
    // the map.
    template <class Body>
    void group(Field key, bool, const Body& body) {
        Describer inner(key);
        body(inner);
        field_->children.push_back(std::move(key));
    }

    // Exactly one of the keys must be present; one key for each type of the variant, in
    // its order.
    template <class... T, class... Keys>
    void alternatives(std::variant<T...>&, Keys... keys) {
        (alternative<T>(std::move(keys), Presence::alternative), ...);
    }
    // At most one of the keys may be present.
    template <class... T, class... Keys>
    void alternatives(std::optional<std::variant<T...>>&, Keys... keys) {
        (alternative<T>(std::move(keys), Presence::optional_alternative), ...);
    }

    // A word of an enumeration that may stand alone (read by whole()) or carry a map of
    // keys.
    template <Named E, class Body>
    void word_with_map(E&, E word, std::string_view doc, bool, const Body& body) {
        group(key(name_of(word), doc), true, body);
    }

    // A value without a key of its own: it stands in the place of the map.
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

    // A kind that the key has been given before, such as identifier, stays.
    void leaf(Kind kind) {
        if (field_->kind == Kind::group) field_->kind = kind;
    }
    void describe(double&) { leaf(Kind::quantity); }
    void describe(int&) { leaf(Kind::integer); }
    void describe(bool&) { leaf(Kind::boolean); }
    void describe(std::string&) { leaf(Kind::text); }
    void describe(structure::Formula&) { leaf(Kind::formula); }
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

    // An optional member makes its key optional.
    template <class T>
    void describe(std::optional<T>&) {
        if (field_->presence == Presence::required) field_->presence = Presence::optional;
        T value{};
        describe(value);
    }
    // Arrays are vectors of fixed length.
    template <FixedLength Row>
    void describe(Row& value) {
        describe(value[0]);
        field_->layout = Layout::vector;
        field_->length = field_->count_min = field_->count_max = std::tuple_size_v<Row>;
    }
    template <std::size_t M>
    void describe(std::array<Vec3, M>& value) {
        describe(value[0]);
        field_->layout = Layout::rows;
        field_->count_min = field_->count_max = M;
    }
    template <FixedLength Row>
    void describe(std::vector<Row>&) {
        leaf(Kind::quantity);
        field_->layout = Layout::rows;
        field_->length = std::tuple_size_v<Row>;
    }
    // Vectors are lists of scalars, maps by name (types with a member `name`), or lists
    // of maps.
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

// --- the keys of each part, a source file each --------------------------------------

template <class Io>
void keys(Io& io, Scene& scene);  // keys.cpp
template <class Io>
void keys(Io& io, Body& body);  // keys_bodies.cpp
template <class Io>
void keys(Io& io, ConstantField& field);
template <class Io>
void keys(Io& io, Oscillation& motion);
template <class Io>
void keys(Io& io, DisplacementRamp& motion);
template <class Io>
void keys(Io& io, FormulaMotion& motion);
template <class Io>
void keys(Io& io, Platform& platform);
template <class Io>
void keys(Io& io, ContactLaw& contact);
template <class Io>
void keys(Io& io, NamedRegion& region);  // keys_magnetization.cpp
template <class Io>
void keys(Io& io, Magnetization& magnetization);
template <class Io>
void keys(Io& io, Box& mesh);  // keys_mesh.cpp
template <class Io>
void keys(Io& io, ObliquePlate& mesh);
template <class Io>
void keys(Io& io, MeshFile& mesh);
template <class Io>
void keys(Io& io, VoxelMesh& mesh);
template <class Io>
void keys(Io& io, Arc& mesh);
template <class Io>
void keys(Io& io, Helix& mesh);
template <class Io>
void keys(Io& io, BallMesh& mesh);
template <class Io>
void keys(Io& io, CylinderMesh& mesh);
template <class Io>
void keys(Io& io, CapsuleMesh& mesh);
template <class Io>
void keys(Io& io, ConeMesh& mesh);
template <class Io>
void keys(Io& io, WireMesh& mesh);
template <class Io>
void keys(Io& io, MagneticField& field);  // keys_field.cpp
template <class Io>
void keys(Io& io, FieldTerm& term);
template <class Io>
void keys(Io& io, DipoleOptions& dipoles);
template <class Io>
void keys(Io& io, Fluid& fluid);  // keys_fluid.cpp
template <class Io>
void keys(Io& io, Coupling& coupling);  // keys_coupling.cpp

// Instantiates keys(io, Type&) for the three visitors.
#define MAGFSI_KEYS_OF(Type)                   \
    template void keys(Describer& io, Type&);  \
    template void keys(TreeReader& io, Type&); \
    template void keys(JsonWriter& io, Type&);

}  // namespace magfsi::scene
