// SPDX-License-Identifier: GPL-2.0-or-later
// Fields, words and separators in the lines of a table (table_file.cpp).
#pragma once

#include <algorithm>
#include <cctype>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

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

// The separator of a line's values: the first of these that it has outside of quotes.
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

// The fields of a line, without quotes. Empty ones at the end that are more than
// `wanted`, as sheets leave them, are left out.
inline std::vector<std::string> fields_of(std::string_view line, char separator,
                                          std::size_t wanted = 0) {
    std::vector<std::string> out(1);
    bool quoted = false;
    for (std::size_t i = 0; i < line.size(); ++i) {
        const char c = line[i];
        const bool blank = c == ' ' || c == '\t';
        if (c == '"' && quoted && line.substr(i + 1).starts_with('"')) {
            out.back() += line[i++];
        } else if (c == '"') {
            quoted = !quoted;
        } else if (!quoted && separator == blanks && blank) {
            // "t [s]" is one field.
            const std::size_t next = line.find_first_not_of(" \t", i);
            const bool unit = next != std::string_view::npos &&
                              (line[next] == '[' || line[next] == '(');
            if (!unit && !out.back().empty()) out.emplace_back();
        } else if (!quoted && c == separator) {
            out.emplace_back();
        } else {
            out.back() += c;
        }
    }
    for (std::string& field : out) field = trimmed(field);
    while (out.size() > 1 && out.size() > wanted && out.back().empty()) out.pop_back();
    return out;
}

// The parts of a field of a header: its name, and its unit as it is written.
struct Written {
    std::string name;
    std::optional<std::string> unit;
};
inline Written in_parts(std::string_view field) {
    const auto at = field.find_first_of("([/");
    if (at == std::string_view::npos) return {std::string(field), {}};
    std::string_view unit = field.substr(at);
    const char closes = unit[0] == '(' ? ')' : ']';
    if (unit[0] == '/')  // t/s
        unit.remove_prefix(1);
    else if (unit.back() == closes)
        unit = unit.substr(1, unit.size() - 2);
    else
        return {std::string(field), {}};  // an expression
    return {std::string(trimmed(field.substr(0, at))), std::string(trimmed(unit))};
}

}  // namespace magfsi::structure::table_text
