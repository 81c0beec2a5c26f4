// SPDX-License-Identifier: GPL-2.0-or-later
// Table of unit symbols, prefixes and named dimensions, and the parser of units.
#include "adapters/scene/units.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <utility>
#include <vector>

#include "adapters/scene/fault.h"
#include "base/words/plain_text.h"

namespace magfsi::scene {

namespace {

// Symbol of a unit. `prefixed` is true if it takes SI prefixes.
struct Symbol {
    std::string_view text;
    Unit unit;
    bool prefixed = true;
};

constexpr long double degree = std::numbers::pi_v<long double> / 180;

// All symbols, with exponents of kg, m, s, A, rad, a decimal exponent and a factor. The
// gram has the exponent -3, since the unit of mass in SI is the kilogram.
const std::vector<Symbol>& symbols() {
    static const std::vector<Symbol> list = {
        {"m", {{0, 1, 0, 0, 0}, 0, 1}},
        {"g", {{1, 0, 0, 0, 0}, -3, 1}},
        {"s", {{0, 0, 1, 0, 0}, 0, 1}},
        {"A", {{0, 0, 0, 1, 0}, 0, 1}},
        {"rad", {{0, 0, 0, 0, 1}, 0, 1}},
        {"deg", {{0, 0, 0, 0, 1}, 0, degree}, false},
        {"\u00b0", {{0, 0, 0, 0, 1}, 0, degree}, false},
        {"%", {{0, 0, 0, 0, 0}, -2, 1}, false},
        {"min", {{0, 0, 1, 0, 0}, 0, 60}, false},
        {"h", {{0, 0, 1, 0, 0}, 0, 3600}, false},
        {"Hz", {{0, 0, -1, 0, 0}, 0, 1}},
        {"N", {{1, 1, -2, 0, 0}, 0, 1}},
        {"Pa", {{1, -1, -2, 0, 0}, 0, 1}},
        {"J", {{1, 2, -2, 0, 0}, 0, 1}},
        {"W", {{1, 2, -3, 0, 0}, 0, 1}},
        {"T", {{1, 0, -2, -1, 0}, 0, 1}},
        {"G", {{1, 0, -2, -1, 0}, -4, 1}},  // gauss
        {"bar", {{1, -1, -2, 0, 0}, 5, 1}},
        {"L", {{0, 3, 0, 0, 0}, -3, 1}},
        {"l", {{0, 3, 0, 0, 0}, -3, 1}},
    };
    return list;
}

// SI prefixes with their decimal exponents.
constexpr std::pair<std::string_view, int> prefixes[] = {
    {"p", -12}, {"n", -9}, {"u", -6}, {"m", -3}, {"c", -2}, {"d", -1},
    {"h", 2},   {"k", 3},  {"M", 6},  {"G", 9},  {"T", 12},
};

// Words that people write in place of symbols, too different from them for an edit
// distance.
constexpr std::pair<std::string_view, std::string_view> spelled_out[] = {
    {"sec", "s"},       {"second", "s"},   {"seconds", "s"}, {"meter", "m"},
    {"metre", "m"},     {"micron", "um"},  {"tesla", "T"},   {"degree", "deg"},
    {"degrees", "deg"}, {"pascal", "Pa"},  {"hertz", "Hz"},  {"newton", "N"},
    {"gauss", "G"},     {"minute", "min"}, {"hour", "h"},
};

// Finds a whole symbol, else an SI prefix with a symbol that takes prefixes.
std::optional<Unit> find_symbol(std::string_view text) {
    for (const Symbol& symbol : symbols()) {
        if (symbol.text == text) return symbol.unit;
    }
    for (const auto& [prefix, exponent] : prefixes) {
        if (!text.starts_with(prefix)) continue;
        for (const Symbol& symbol : symbols()) {
            if (!symbol.prefixed || symbol.text != text.substr(prefix.size())) continue;
            Unit unit = symbol.unit;
            unit.decimal_exponent += exponent;
            return unit;
        }
    }
    return std::nullopt;
}

// Suggestion of a symbol for a misspelt one, with all prefixes considered.
std::string near_symbol(std::string_view text) {
    for (const auto& [word, symbol] : spelled_out) {
        if (word == text) return fmt::format("did you mean \"{}\"?", symbol);
    }
    std::vector<std::string> known;
    for (const Symbol& symbol : symbols()) known.emplace_back(symbol.text);
    for (const auto& [prefix, exponent] : prefixes) {
        for (const Symbol& symbol : symbols()) {
            if (symbol.prefixed)
                known.push_back(fmt::format("{}{}", prefix, symbol.text));
        }
    }
    return did_you_mean(text, known);
}

}  // namespace

// A character beyond ASCII is named in the advice; otherwise a similar symbol is
// suggested.
std::string remedy(std::string_view text) {
    const std::string strange = words::strange_character(text);
    return strange.empty() ? near_symbol(text)
                           : fmt::format("{} is none of a unit or a number", strange);
}

namespace {

// Reads a symbol with its power, such as "mm2", "s^-1" or "m^2".
Unit parse_factor(std::string_view text) {
    const std::size_t end = text.find_first_of("^-0123456789");
    const std::string_view symbol = text.substr(0, end);
    const std::optional<Unit> base = find_symbol(symbol);
    if (!base)
        throw Complaint(
            fmt::format("the unknown unit {}", in_quotes(symbol)),
            "m, g, s, A, T, G, N, Pa, J, W, Hz, rad, deg, min, h, bar, L with SI "
            "prefixes",
            remedy(symbol));
    int power = 1;
    if (end != std::string_view::npos) {
        std::string_view digits = text.substr(end);
        if (digits.starts_with('^')) digits.remove_prefix(1);
        const bool negative = digits.starts_with('-');
        if (negative) digits.remove_prefix(1);
        if (digits.size() != 1 || digits[0] < '1' || digits[0] > '9')
            throw Complaint(fmt::format("the unit {}", in_quotes(text)),
                            "powers from -9 to 9 such as m2, m^2 or s^-1");
        power = (digits[0] - '0') * (negative ? -1 : 1);
    }
    Unit unit;
    for (std::size_t i = 0; i < unit.dimension.size(); ++i)
        unit.dimension[i] = power * base->dimension[i];
    unit.decimal_exponent = power * base->decimal_exponent;
    unit.factor = std::pow(base->factor, static_cast<long double>(power));
    return unit;
}

// Multiplies a unit by another (sign 1) or divides it (sign -1).
void multiply(Unit& unit, const Unit& other, int sign) {
    for (std::size_t i = 0; i < unit.dimension.size(); ++i)
        unit.dimension[i] += sign * other.dimension[i];
    unit.decimal_exponent += sign * other.decimal_exponent;
    unit.factor = sign > 0 ? unit.factor * other.factor : unit.factor / other.factor;
}

}  // namespace

// Formulas use it to tell the unit in 5 mT/s from the time in 5 mT/t.
bool is_unit_symbol(std::string_view text) {
    return find_symbol(words::plain(text)).has_value();
}

// A leading "1" stands for a plain number, as in "1/s". After the first "/" only further
// divisions are allowed, for the reading of "N/m s" would be ambiguous.
Unit parse_unit(std::string_view text) {
    std::string plain = words::plain(text);
    words::replace_all(plain, "**", "^");
    Unit unit;
    int sign = 1;
    bool divided = false, expects_factor = false;
    for (std::size_t at = 0; at < plain.size();) {
        const char c = plain[at];
        if (c == ' ' || c == '\t') {
            ++at;
        } else if (c == '*' || c == '/') {
            const bool doubled = expects_factor || (c == '*' && at == 0);
            expects_factor = true;
            if (doubled) break;
            sign = c == '/' ? -1 : 1;
            ++at;
        } else {
            const std::size_t end =
                std::min(plain.find_first_of(" \t*/", at), plain.size());
            const std::string_view factor = std::string_view(plain).substr(at, end - at);
            if (divided && sign > 0)
                throw Complaint(fmt::format("the unit {}", in_quotes(text)),
                                "a product before the first \"/\" only",
                                "write N/m/s for N/(m s)");
            if (factor != "1" || at != 0) multiply(unit, parse_factor(factor), sign);
            divided = divided || sign < 0;
            sign = 1;
            expects_factor = false;
            at = end;
        }
    }
    if (expects_factor)
        throw Complaint(fmt::format("the incomplete unit {}", in_quotes(text)),
                        "units such as m/s2 or N m");
    return unit;
}

namespace {

// Name of a dimension with its SI unit and an example.
struct NamedDimension {
    std::string_view si;
    std::string_view name;
    std::string_view example;
};

// Dimensions used in scenes. Errors and the reference page take their words from here.
constexpr NamedDimension named[] = {
    {"", "a plain number", "0.5"},
    {"m", "a length", "0.2 mm"},
    {"s", "a time", "20 us"},
    {"kg", "a mass", "3 mg"},
    {"A", "an electric current", "1 A"},
    {"rad", "an angle", "45 deg"},
    {"m2", "an area", "1 mm2"},
    {"m3", "a volume", "1 mm3"},
    {"1/s", "a rate", "5 Hz"},
    {"rad/s", "an angular speed", "90 deg/s"},
    {"m/s", "a speed", "0.5 m/s"},
    {"m/s2", "an acceleration", "9.81 m/s2"},
    {"m2/s", "a kinematic viscosity", "1 mm2/s"},
    {"Pa s", "a dynamic viscosity", "1 mPa s"},
    {"kg/m3", "a density", "1000 kg/m3"},
    {"Pa", "a pressure", "33 kPa"},
    {"N", "a force", "1 mN"},
    {"N/m3", "a force density or pressure by length", "10 N/m3"},
    {"J", "an energy", "1 uJ"},
    {"W", "a power", "1 mW"},
    {"T", "a magnetic flux density", "17 mT"},
    {"T/m", "a field gradient", "0.5 T/m"},
    {"A m2", "a magnetic moment", "0.1 A m2"},
    {"A/m", "a magnetization", "62 kA/m (or a remanence such as 78 mT)"},
};

// Entry of a dimension by its exponents; units such as Hz and 1/s share one.
const NamedDimension* find(const Dimension& dimension) {
    static const std::vector<Dimension> dimensions = [] {
        std::vector<Dimension> list;
        for (const NamedDimension& entry : named)
            list.push_back(parse_unit(entry.si).dimension);
        return list;
    }();
    for (std::size_t i = 0; i < dimensions.size(); ++i) {
        if (dimensions[i] == dimension) return &named[i];
    }
    return nullptr;
}

}  // namespace

// Products read like "a quantity in kg^1 m^2".
std::string dimension_name(const Dimension& dimension) {
    if (const NamedDimension* entry = find(dimension)) return std::string(entry->name);
    constexpr std::string_view base[] = {"kg", "m", "s", "A", "rad"};
    std::string product;
    for (std::size_t i = 0; i < dimension.size(); ++i) {
        if (dimension[i] != 0) product += fmt::format(" {}^{}", base[i], dimension[i]);
    }
    return "a quantity in" + product;
}

// "%" is a plain number to parse_unit and gets words of its own.
std::string dimension_expectation(std::string_view si_unit) {
    if (si_unit == "%") return "a share such as 3 %";
    const Dimension dimension = parse_unit(si_unit).dimension;
    const NamedDimension* entry = find(dimension);
    return fmt::format("{} such as {}", dimension_name(dimension),
                       entry ? entry->example : "");
}

}  // namespace magfsi::scene
