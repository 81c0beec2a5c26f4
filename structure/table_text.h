// SPDX-License-Identifier: GPL-2.0-or-later
// Text functions for the lines of a table (table_file.cpp): separators, fields, units.
#pragma once

#include <algorithm>
#include <cctype>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace magfsi::structure::table_text {

// Separator that stands for any number of blanks and tabs
inline constexpr char blanks = ' ';

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

// True for the name of a unit such as "millimetres", "Tesla" or "inches". The whole word
// must be one: "parameter" is none.
inline bool names_a_unit(std::string_view word) {
    constexpr std::string_view prefixes[] = {"",      "nano", "micro", "milli",
                                             "centi", "deci", "kilo",  "mega"};
    constexpr std::string_view names[] = {"metre",  "meter",  "tesla", "gauss", "ampere",
                                          "pascal", "newton", "inch",  "foot",  "feet"};
    const std::string text = lower(word);
    return std::ranges::any_of(prefixes, [&](std::string_view prefix) {
        return text.starts_with(prefix) &&
               std::ranges::any_of(names, [&](std::string_view name) {
                   const auto rest = std::string_view(text).substr(prefix.size());
                   return rest.starts_with(name) && (rest.size() == name.size() ||
                                                     rest.substr(name.size()) == "s" ||
                                                     rest.substr(name.size()) == "es");
               });
    });
}

// Name of a column for comparison, without case and underscores: "B_x" and "BX" are the
// same as "Bx", "Time" the same as "t".
inline std::string simple(std::string_view name) {
    std::string out = lower(name);
    std::erase(out, '_');
    return out == "time" ? "t" : out;
}

// True for letters, digits, underscores and points that do not begin with a digit.
inline bool is_name(std::string_view text) {
    return !text.empty() && std::isdigit(static_cast<unsigned char>(text[0])) == 0 &&
           std::ranges::all_of(text, [](char c) {
               return c == '_' || c == '.' ||
                      std::isalnum(static_cast<unsigned char>(c)) != 0;
           });
}

// The separator of a line: the first of semicolon, tab and comma that occurs outside of
// quotes; else blanks.
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

// The fields of a line, trimmed and without quotes; a doubled quote is a quote. Empty
// fields at the end, as spreadsheets leave them, are dropped beyond the number `wanted`.
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
            // A blank before a bracket does not separate: "t [s]" is one field.
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

// A header field split into name and unit. The unit is as written: "x[mm]", "x (mm)" and
// "x/mm" all give mm; without any of these it is absent.
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
