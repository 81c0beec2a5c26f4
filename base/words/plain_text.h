// SPDX-License-Identifier: GPL-2.0-or-later
// Conversion of text as people paste it from papers, spreadsheets and editors into the
// characters that our readers know. This is the only place that lists which characters
// mean the same.
#pragma once

#include <array>
#include <cstdio>
#include <string>
#include <string_view>
#include <utility>

namespace magfsi::words {

// Replaces every occurrence of `from` by `to`.
inline void replace_all(std::string& text, std::string_view from, std::string_view to) {
    for (auto at = text.find(from); at != std::string::npos;
         at = text.find(from, at + to.size()))
        text.replace(at, from.size(), to);
}

namespace detail {

// Superscripts: in a row of several only the first one also brings a "^".
inline constexpr std::array<std::pair<std::string_view, char>, 12> superscripts{
    {{"\u207b", '-'},
     {"\u207a", '+'},
     {"\u2070", '0'},
     {"\u00b9", '1'},
     {"\u00b2", '2'},
     {"\u00b3", '3'},
     {"\u2074", '4'},
     {"\u2075", '5'},
     {"\u2076", '6'},
     {"\u2077", '7'},
     {"\u2078", '8'},
     {"\u2079", '9'}}};

inline constexpr std::pair<std::string_view, std::string_view> same[] =
    {
        {"\u00b5", "u"}, {"\u03bc", "u"},  // micro, mu
        {"\u2212", "-"}, {"\u2010", "-"},
        {"\u2011", "-"}, {"\u2013", "-"},  // minus, dashes
        {"\u00b7", "*"}, {"\u22c5", "*"},
        {"\u2219", "*"},  // dots of products
        {"\u00a0", " "}, {"\u2000", " "},
        {"\u2001", " "}, {"\u2002", " "},  // hard and thin
        {"\u2003", " "}, {"\u2004", " "},
        {"\u2005", " "}, {"\u2006", " "},  // blanks
        {"\u2007", " "}, {"\u2008", " "},
        {"\u2009", " "}, {"\u200a", " "},
        {"\u202f", " "}, {"\u205f", " "},
        {"\u3000", " "}, {"\u200b", ""},
        {"\ufeff", ""},  // zero-width space; byte order mark
};

// The text with superscripts as "^" and ASCII digits or signs.
inline std::string raised(std::string text) {
    std::size_t last = std::string::npos;  // end of the previous superscript
    for (std::size_t at = 0; at < text.size(); ++at) {
        for (const auto& [from, to] : superscripts) {
            if (!std::string_view(text).substr(at).starts_with(from)) continue;
            const std::string ascii = at == last ? std::string{to} : std::string{'^', to};
            text.replace(at, from.size(), ascii);
            last = at + ascii.size();
            at = last - 1;
            break;
        }
    }
    return text;
}

}  // namespace detail

// True if the text has ASCII characters only.
inline bool is_ascii(std::string_view text) {
    for (const char c : text) {
        if ((c & 0x80) != 0) return false;
    }
    return true;
}

// The text with known characters beyond ASCII replaced. A micro sign or a hard blank in
// Latin-1 is recognised as a byte that begins no character of UTF-8.
inline std::string plain(std::string_view text) {
    std::string out(text);
    if (is_ascii(text)) return out;
    for (const auto& [from, to] : detail::same) replace_all(out, from, to);
    for (std::size_t i = 0; i < out.size(); ++i) {
        const bool alone = i == 0 || (out[i - 1] & 0x80) == 0;
        if (alone && out[i] == '\xb5') out[i] = 'u';
        if (alone && out[i] == '\xa0') out[i] = ' ';
    }
    return detail::raised(std::move(out));
}

// The first character that is not ASCII, for an error message: "the character U+00D7", or
// "the byte 0x..., no UTF-8"; "" if all are ASCII.
inline std::string strange_character(std::string_view text) {
    std::size_t at = 0;
    while (at < text.size() && (text[at] & 0x80) == 0) ++at;
    if (at == text.size()) return {};
    const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
    const unsigned first = byte(at);
    const std::size_t more = first >= 0xf0   ? 3
                             : first >= 0xe0 ? 2
                             : first >= 0xc0 ? 1
                                             : 0;
    unsigned point = first & (0x7fU >> (more + 1));
    std::array<char, 40> out{};
    std::size_t read = 0;
    for (; more > 0 && read < more && at + read + 1 < text.size(); ++read) {
        if ((byte(at + read + 1) & 0xc0U) != 0x80) break;
        point = point << 6 | (byte(at + read + 1) & 0x3fU);
    }
    if (more == 0 || read < more)
        std::snprintf(out.data(), out.size(), "the byte 0x%02X, no UTF-8", first);
    else
        std::snprintf(out.data(), out.size(), "the character U+%04X", point);
    return out.data();
}

}  // namespace magfsi::words
