// SPDX-License-Identifier: GPL-2.0-or-later
// Numbers with units are converted through their text: the decimal exponents are added
// before the only rounding.
#include "adapters/scene/quantity.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <numbers>
#include <vector>

#include "adapters/scene/fault.h"
#include "base/words/plain_text.h"

namespace magfsi::scene {

std::string format_si(double value, std::string_view si_unit) {
    const bool takes_prefix = si_unit == "m" || si_unit == "s" || si_unit == "Pa" ||
                              si_unit == "T" || si_unit == "N" || si_unit == "A/m";
    if (!takes_prefix || value == 0)
        return fmt::format("{:.6g}{}{}", value, si_unit.empty() ? "" : " ", si_unit);
    constexpr std::string_view prefix[] = {"n", "u", "m", "", "k", "M", "G"};
    // The small shift makes 0.001 m print as 1 mm, however its logarithm rounds.
    const int thousands = std::floor(std::log10(std::abs(value)) / 3 + 1e-9);
    const int step = std::min(std::max(thousands, -3), 3);
    return fmt::format("{:.6g} {}{}", value / std::pow(10.0, 3 * step), prefix[step + 3],
                       si_unit);
}

namespace {

// A number's text in parts.
struct Number {
    std::string mantissa;  // digits without a leading plus
    int exponent = 0;
    std::string_view rest;  // the unit
};

std::string_view trim(std::string_view text) {
    const std::size_t first = text.find_first_not_of(" \t\r\n");
    if (first == std::string_view::npos) return {};
    return text.substr(first, text.find_last_not_of(" \t\r\n") - first + 1);
}

// Refuses text behind a number that belongs to another way of writing numbers: a decimal
// comma, or digits in groups.
void refuse_other_writing(std::string_view text, std::string_view rest) {
    const auto digit = [&](std::size_t at) {
        return at < rest.size() && rest[at] >= '0' && rest[at] <= '9';
    };
    if (rest.starts_with(',') && (rest.size() == 1 || digit(1) || rest[1] == ' ')) {
        std::string with_point(text);
        words::replace_all(with_point, ",", ".");
        throw Complaint(in_quotes(text), "numbers with a decimal point, without commas",
                        fmt::format("write \"{}\" if the comma is one", with_point));
    }
    // "1 m" is a number and a unit, "1 000 m" a number in two parts; "1/s" is a unit.
    const bool one_over = rest.starts_with('1') && trim(rest.substr(1)).starts_with('/');
    if (digit(0) && !one_over)
        throw Complaint(in_quotes(text), "the digits of a number together, as in 1000");
}

// Splits a text into mantissa, exponent and unit. Returns false if it does not start with
// a decimal number.
bool split(std::string_view text, Number& number) {
    if (text.starts_with('+') && !text.starts_with("+-")) text.remove_prefix(1);
    const std::size_t sign = text.starts_with('-') ? 1 : 0;
    // Words such as inf, which from_chars accepts, are excluded here.
    if (text.find_first_of("0123456789.", sign) != sign) return false;
    double value = 0;
    const char* begin = text.data();
    const char* end = std::from_chars(begin, begin + text.size(), value).ptr;
    if (end == begin) return false;
    const std::string_view written(begin, end);
    const std::size_t e = written.find_first_of("eE");
    number.mantissa = written.substr(0, e);
    number.rest = trim(text.substr(written.size()));
    refuse_other_writing(text, number.rest);
    if (e == std::string_view::npos) return true;
    const char* digits = begin + e + (written[e + 1] == '+' ? 2 : 1);
    return std::from_chars(digits, end, number.exponent).ec == std::errc{};
}

// Converts the number with the unit's decimal exponent added to its own: one rounding in
// all.
template <class Float>
Float rounded(const Number& number, int decimal_exponent, std::string_view text) {
    // The number's exponent is an int and the unit's has a few digits: their sum as a
    // long cannot overflow.
    const long exponent = static_cast<long>(number.exponent) + decimal_exponent;
    const std::string folded = fmt::format("{}e{}", number.mantissa, exponent);
    Float value = 0;
    const auto result =
        std::from_chars(folded.data(), folded.data() + folded.size(), value);
    if (result.ec != std::errc{} || !std::isfinite(value))
        throw Complaint(in_quotes(text), "numbers that a double holds");
    return value;
}

// A unit with a factor (min, h, deg) is applied in long double, before the only rounding
// to double.
SiValue any_quantity(std::string_view text) {
    Number number;
    if (!split(text, number)) throw Complaint(in_quotes(text), "a number", remedy(text));
    const Unit unit = parse_unit(number.rest);
    if (unit.factor == 1)
        return {rounded<double>(number, unit.decimal_exponent, text), unit.dimension};
    const auto value = rounded<long double>(number, unit.decimal_exponent, text);
    return {static_cast<double>(value * unit.factor), unit.dimension};
}

// Sizes beyond any soft robot or its surroundings. A larger value is taken for a slip in
// the prefix: m for M, or none.
struct Most {
    std::string_view si;
    double value;
    char likely = 'm';  // the prefix that was meant most often
};
constexpr Most beyond[] = {
    {"m", 1e3},         // the largest tank there is
    {"s", 5e5},         // six days
    {"T", 50},          // more than any magnet that stands (45 T, Tallahassee)
    {"T/m", 1e5},       // 1 T over ten micrometres
    {"A/m", 1e7, 'k'},  // five times that of iron
    {"A", 1e5},         // turns of a large magnet included
    {"A m2", 1e5},      // a ton of magnets
    {"m/s2", 1e6},      // a fast centrifuge
    {"1/s", 1e9},       // rates of strain beyond any fluid's
    {"m2/s", 1e3},      // a thousand million times water
    {"Pa", 1e13, 'k'}, {"kg/m3", 1e5, 'k'}, {"m/s", 1e4}, {"kg", 1e6}, {"N", 1e6},
};

// Suggestion with the likely prefix in place of the given one or before the unit, if that
// gives a plausible size; else "".
std::string likely_size(std::string_view text, const Dimension& dimension,
                        const Most& most) {
    const auto unit_at = text.find_first_not_of("0123456789.+-eE \t");
    if (unit_at == std::string_view::npos) return {};
    const std::string number(trim(text.substr(0, unit_at)));
    const std::string unit(text.substr(unit_at));
    for (const std::string& other : {most.likely + unit.substr(1), most.likely + unit}) {
        try {
            const std::string likely = fmt::format("{} {}", number, other);
            const SiValue found = any_quantity(likely);
            if (found.dimension == dimension && std::abs(found.value) <= most.value)
                return fmt::format("did you mean \"{}\"?", likely);
        } catch (const Complaint&) {  // no unit
        }
    }
    return {};
}

// Refuses implausible sizes of the dimensions in `beyond`; others have no limit.
void check_size(const SiValue& found, std::string_view text) {
    static const std::vector<Dimension> dimensions = [] {
        std::vector<Dimension> list;
        for (const Most& most : beyond) list.push_back(parse_unit(most.si).dimension);
        return list;
    }();
    const auto at = std::ranges::find(dimensions, found.dimension) - dimensions.begin();
    if (at == std::ssize(dimensions)) return;
    const Most& most = beyond[at];
    if (std::abs(found.value) <= most.value) return;
    throw Complaint(
        fmt::format("{}, which is {:.4g} {}", in_quotes(text), found.value, most.si),
        fmt::format("at most {:g} {}", most.value, most.si),
        likely_size(text, found.dimension, most));
}

}  // namespace

SiValue parse_any_quantity(std::string_view raw) {
    const std::string plain = words::plain(raw);
    const std::string_view text = trim(plain);
    const SiValue found = any_quantity(text);
    check_size(found, text);
    return found;
}

// A bare number where a unit is needed is refused with the SI unit as a suggestion, never
// guessed.
double parse_quantity(std::string_view raw, std::string_view si_unit) {
    const std::string plain = words::plain(raw);
    const std::string_view text = trim(plain);
    const Unit expected = parse_unit(si_unit);
    Number number;
    if (!split(text, number)) {
        const std::string strange = words::strange_character(text);
        throw Complaint(
            in_quotes(text), dimension_expectation(si_unit),
            strange.empty() ? "" : fmt::format("{} is none of a number", strange));
    }
    if (number.rest.empty() && !si_unit.empty())
        throw Complaint(fmt::format("{} without a unit", in_quotes(text)),
                        dimension_expectation(si_unit),
                        fmt::format("\"{} {}\" if SI is meant", text, si_unit));
    const Unit unit = parse_unit(number.rest);
    // Magnets are specified by their remanence Br = mu0 M [T], from which M follows.
    if (si_unit == "A/m" && unit.dimension == parse_unit("T").dimension) {
        const auto remanence = rounded<long double>(number, unit.decimal_exponent, text);
        check_size({static_cast<double>(remanence), unit.dimension}, text);
        const double magnetization =
            remanence / (4e-7L * std::numbers::pi_v<long double>);
        check_size({magnetization, expected.dimension}, text);
        return magnetization;
    }
    if (unit.dimension != expected.dimension)
        throw Complaint(
            fmt::format("{}, {}", in_quotes(text), dimension_name(unit.dimension)),
            dimension_expectation(si_unit));
    const int exponent = unit.decimal_exponent - expected.decimal_exponent;
    // Only min, h and deg have a factor; all other units are exact by their power of ten.
    const double value =
        unit.factor == expected.factor
            ? rounded<double>(number, exponent, text)
            : static_cast<double>(rounded<long double>(number, exponent, text) *
                                  (unit.factor / expected.factor));
    check_size({value, unit.dimension}, text);
    return value == 0 ? 0.0 : value;  // -0 means 0
}

}  // namespace magfsi::scene
