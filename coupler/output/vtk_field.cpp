#include "coupler/output/vtk_field.h"

#include <fmt/format.h>

#include <stdexcept>

namespace magfsi::output {

std::string_view vtk_type(const Values& values) {
    return std::holds_alternative<std::span<const float>>(values) ? "Float32" : "Float64";
}

std::size_t count(const Values& values) {
    return std::visit([](auto span) { return span.size(); }, values);
}

std::span<const std::byte> bytes(const Values& values) {
    return std::visit(
        [](auto span) -> std::span<const std::byte> { return std::as_bytes(span); },
        values);
}

void check_size(const Field& field, std::size_t tuples, std::string_view what) {
    if (field.name.empty()) throw std::invalid_argument("a VTK field must have a name");
    if (field.components < 1)
        throw std::invalid_argument(
            fmt::format("VTK field '{}' has {} components; at least 1", field.name,
                        field.components));
    const std::size_t wanted = tuples * static_cast<std::size_t>(field.components);
    if (count(field.values) != wanted)
        throw std::invalid_argument(fmt::format(
            "VTK field '{}' has {} values; {} {} of {} components need {}", field.name,
            count(field.values), tuples, what, field.components, wanted));
}

std::string xml_escaped(std::string_view text) {
    std::string out;
    for (const char c : text) {
        if (c == '&')
            out += "&amp;";
        else if (c == '<')
            out += "&lt;";
        else if (c == '>')
            out += "&gt;";
        else if (c == '"')
            out += "&quot;";
        else
            out += c;
    }
    return out;
}

}  // namespace magfsi::output
