// Named values for a VTK file. Nothing is copied: the values must live until written.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <variant>

namespace magfsi::output {

// Written as they come: float as Float32, double as Float64.
using Values = std::variant<std::span<const float>, std::span<const double>>;

// components values a point (or cell), tuples one after the other.
struct Field {
    std::string name;
    int components = 1;
    Values values;
};

std::string_view vtk_type(const Values& values);  // "Float32", "Float64"
std::size_t count(const Values& values);
std::span<const std::byte> bytes(const Values& values);

// Throws std::invalid_argument when the field has no name, no components, or not
// components * tuples values; `what` says in the message what a tuple belongs to
// ("cells").
void check_size(const Field& field, std::size_t tuples, std::string_view what);

std::string xml_escaped(std::string_view text);

}  // namespace magfsi::output
