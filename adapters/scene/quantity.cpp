#include "adapters/scene/quantity.h"

#include <fmt/format.h>

#include <charconv>
#include <cmath>

#include "adapters/scene/fault.h"
#include "adapters/scene/unit.h"

namespace magfsi::scene {

namespace {

struct Number {
    std::string mantissa;  // without a leading plus
    int exponent = 0;
    std::string_view rest;  // the unit
};

bool is_digit(char c) {
    return c >= '0' && c <= '9';
}

std::string_view trim(std::string_view text) {
    const std::size_t first = text.find_first_not_of(" \t\r\n");
    if (first == std::string_view::npos) return {};
    return text.substr(first, text.find_last_not_of(" \t\r\n") - first + 1);
}

// False when the text does not start with a decimal number.
bool split(std::string_view text, Number& number) {
    std::size_t at = 0;
    if (at < text.size() && (text[at] == '+' || text[at] == '-')) {
        if (text[at] == '-') number.mantissa = '-';
        ++at;
    }
    bool digits = false;
    for (bool point = false; at < text.size(); ++at) {
        if (text[at] == '.' && !point) {
            point = true;
        } else if (is_digit(text[at])) {
            digits = true;
        } else {
            break;
        }
        number.mantissa += text[at];
    }
    if (!digits) return false;
    if (at + 1 < text.size() && (text[at] == 'e' || text[at] == 'E')) {
        const char* begin = text.data() + at + 1 + (text[at + 1] == '+' ? 1 : 0);
        const auto [end, error] =
            std::from_chars(begin, text.data() + text.size(), number.exponent);
        if (error == std::errc::result_out_of_range) return false;
        if (error == std::errc{}) at = static_cast<std::size_t>(end - text.data());
    }
    number.rest = trim(text.substr(at));
    return true;
}

template <class Float>
Float rounded(const Number& number, int decimal_exponent, std::string_view text) {
    // The exponent is an int of a few digits plus a unit's: wide arithmetic cannot wrap.
    const long exponent = static_cast<long>(number.exponent) + decimal_exponent;
    const std::string folded = fmt::format("{}e{}", number.mantissa, exponent);
    Float value = 0;
    const auto result =
        std::from_chars(folded.data(), folded.data() + folded.size(), value);
    if (result.ec != std::errc{} || !std::isfinite(value))
        throw Complaint(in_quotes(text), "numbers that a double holds");
    return value;
}

}  // namespace

std::string dimension_expectation(std::string_view si_unit) {
    if (si_unit == "%") return "a share such as 3 %";
    const Dimension dimension = parse_unit(si_unit).dimension;
    return fmt::format("{} such as {}", dimension_name(dimension),
                       dimension_example(dimension));
}

double parse_quantity(std::string_view raw, std::string_view si_unit) {
    const std::string_view text = trim(raw);
    const Unit expected = parse_unit(si_unit);
    Number number;
    if (!split(text, number))
        throw Complaint(in_quotes(text), dimension_expectation(si_unit));
    if (number.rest.empty() && !si_unit.empty())
        throw Complaint(fmt::format("{} without a unit", in_quotes(text)),
                        dimension_expectation(si_unit),
                        fmt::format("\"{} {}\" if SI is meant", text, si_unit));
    const Unit unit = parse_unit(number.rest);
    if (unit.dimension != expected.dimension)
        throw Complaint(
            fmt::format("{}, {}", in_quotes(text), dimension_name(unit.dimension)),
            dimension_expectation(si_unit));
    const int exponent = unit.decimal_exponent - expected.decimal_exponent;
    // Only min, h and deg carry a factor; all else is exact by its power of ten.
    const double value =
        unit.factor == expected.factor
            ? rounded<double>(number, exponent, text)
            : static_cast<double>(rounded<long double>(number, exponent, text) *
                                  (unit.factor / expected.factor));
    return value == 0 ? 0.0 : value;  // -0 means 0
}

}  // namespace magfsi::scene
