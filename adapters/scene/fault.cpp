#include "adapters/scene/fault.h"

#include <fmt/format.h>

namespace magfsi::scene {

namespace {

std::string compose(std::string_view found, std::string_view allowed,
                    std::string_view suggestion) {
    std::string text = fmt::format("found {}", found);
    if (!allowed.empty()) text += fmt::format("; allowed {}", allowed);
    if (!suggestion.empty()) text += fmt::format("; {}", suggestion);
    for (char& c : text) {
        if (static_cast<unsigned char>(c) < ' ') c = ' ';
    }
    return text;
}

}  // namespace

std::string to_string(const Origin& origin) {
    if (origin.line == 0) return origin.source;
    return fmt::format("{}:{}:{}", origin.source, origin.line, origin.column);
}

Complaint::Complaint(std::string_view found, std::string_view allowed,
                     std::string_view suggestion)
    : std::runtime_error(compose(found, allowed, suggestion)) {}

void refuse(const Origin& where, const Complaint& complaint) {
    throw SceneError(fmt::format("{}: {}", to_string(where), complaint.what()));
}

std::string in_quotes(std::string_view text) {
    constexpr std::size_t longest = 48;
    if (text.size() <= longest) return fmt::format("\"{}\"", text);
    std::size_t cut = longest;
    // Never through the middle of a UTF-8 sequence.
    while (cut > 0 && (static_cast<unsigned char>(text[cut]) & 0xC0) == 0x80) --cut;
    return fmt::format("\"{}...\"", text.substr(0, cut));
}

}  // namespace magfsi::scene
