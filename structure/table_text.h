// SPDX-License-Identifier: GPL-2.0-or-later
// Words and separators in the lines of a table (table_file.cpp).
#pragma once

#include <algorithm>
#include <cctype>
#include <string>
#include <string_view>

namespace magfsi::structure::table_text {

inline constexpr char blanks = ' ';  // as the separator: any number of blanks and tabs

inline std::string_view trimmed(std::string_view text) {
    const auto first = text.find_first_not_of(" \t");
    if (first == std::string_view::npos) return {};
    return text.substr(first, text.find_last_not_of(" \t") - first + 1);
}

inline std::string lower(std::string_view text) {
    std::string out;
    for (const char c : text)
        out += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    return out;
}

// "B_x" and "BX" are Bx, "Time" is t.
inline std::string simple(std::string_view name) {
    std::string out = lower(name);
    std::erase(out, '_');
    return out == "time" ? "t" : out;
}

inline bool is_name(std::string_view text) {
    return !text.empty() && std::isdigit(static_cast<unsigned char>(text[0])) == 0 &&
           std::ranges::all_of(text, [](char c) {
               return c == '_' || c == '.' ||
                      std::isalnum(static_cast<unsigned char>(c)) != 0;
           });
}

// What separates the values of a line: what it has of these outside of quotes.
inline char separator_of(std::string_view line) {
    bool quoted = false;
    std::string outside;
    for (const char c : line) {
        if (c == '"') quoted = !quoted;
        if (!quoted) outside += c;
    }
    for (const char c : {';', '\t', ','}) {
        if (outside.find(c) != std::string::npos) return c;
    }
    return blanks;
}

}  // namespace magfsi::structure::table_text
