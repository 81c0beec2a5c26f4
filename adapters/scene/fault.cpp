// SPDX-License-Identifier: GPL-2.0-or-later
// Text of faults, safe for logs and terminals, and suggestions by edit distance.
#include "adapters/scene/fault.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>

#include "adapters/scene/document.h"

namespace magfsi::scene {

namespace {

// Joins the parts of a fault to one line; control characters become blanks.
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

// Long values, such as a whole file pasted in place of a value, would hide the rest of
// the message.
std::string in_quotes(std::string_view text) {
    constexpr std::size_t longest = 48;
    if (text.size() <= longest) return fmt::format("\"{}\"", text);
    std::size_t cut = longest;
    // Continuation bytes of UTF-8 have the form 10xxxxxx; the cut must not precede one.
    while (cut > 0 && (static_cast<unsigned char>(text[cut]) & 0xC0) == 0x80) --cut;
    return fmt::format("\"{}...\"", text.substr(0, cut));
}

// Line breaks stay, for messages may have several lines.
std::string printable(std::string_view text) {
    std::string out(text);
    for (std::size_t at = 0; (at = first_fault_in_utf8(out)) != std::string::npos;)
        out[at] = '?';
    for (std::size_t i = 0; i < out.size(); ++i) {
        const auto byte = static_cast<unsigned char>(out[i]);
        // The control characters beyond ASCII are encoded as C2 80 to C2 9F.
        const bool second = byte == 0xC2 && static_cast<unsigned char>(out[i + 1]) < 0xA0;
        if (second) out[i + 1] = '?';
        if (second || byte < ' ' || byte == 0x7F) out[i] = byte == '\n' ? '\n' : '?';
    }
    return out;
}

namespace {

char lower(char c) {
    return static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
}

// Twice the optimal string alignment distance, so that half an edit is an integer. d(i,
// j) is the distance of the first i letters of a to the first j of b.
int doubled_distance(std::string_view a, std::string_view b) {
    const std::size_t width = b.size() + 1;
    std::vector<int> d((a.size() + 1) * width);
    const auto at = [&](std::size_t i, std::size_t j) -> int& {
        return d[i * width + j];
    };
    for (std::size_t i = 0; i <= a.size(); ++i) at(i, 0) = 2 * static_cast<int>(i);
    for (std::size_t j = 0; j <= b.size(); ++j) at(0, j) = 2 * static_cast<int>(j);
    for (std::size_t i = 1; i <= a.size(); ++i) {
        for (std::size_t j = 1; j <= b.size(); ++j) {
            const char x = a[i - 1], y = b[j - 1];
            const int change = x == y ? 0 : lower(x) == lower(y) ? 1 : 2;
            at(i, j) =
                std::min({at(i - 1, j) + 2, at(i, j - 1) + 2, at(i - 1, j - 1) + change});
            if (i > 1 && j > 1 && x == b[j - 2] && a[i - 2] == y)
                at(i, j) = std::min(at(i, j), at(i - 2, j - 2) + 2);
        }
    }
    return d.back();
}

}  // namespace

// Ties go to the first candidate. A candidate that would have to be replaced as a whole
// is never taken.
std::string nearest(std::string_view word, const std::vector<std::string>& candidates) {
    std::string best;
    // A candidate may differ by one edit in short words, by about one in three letters in
    // long ones.
    int allowed = 2 * std::max<int>(1, static_cast<int>(word.size()) / 3);
    for (const std::string& candidate : candidates) {
        const int distance = doubled_distance(word, candidate);
        if (distance <= allowed && distance < 2 * static_cast<int>(candidate.size())) {
            if (best.empty() || distance < allowed) best = candidate;
            allowed = distance;
        }
    }
    return best;
}

std::string did_you_mean(std::string_view word,
                         const std::vector<std::string>& candidates) {
    const std::string near = nearest(word, candidates);
    return near.empty() ? "" : fmt::format("did you mean \"{}\"?", near);
}

}  // namespace magfsi::scene
