// SPDX-License-Identifier: GPL-2.0-or-later
// Formulas are converted as text, number by number, and checked by evaluation in several
// systems of units; no syntax tree is needed.
#include "adapters/scene/formula_units.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cmath>
#include <optional>

#include "adapters/scene/fault.h"
#include "adapters/scene/quantity.h"
#include "base/words/plain_text.h"
#include "structure/formula.h"

namespace magfsi::scene {

namespace {

// Sizes of the SI units of mass, length, time and current, expressed in another system of
// units.
using Scales = std::array<double, 4>;

// Factor that converts an SI value of this dimension to the other system.
double scale_of(const Dimension& dimension, const Scales& scales) {
    double factor = 1;
    for (std::size_t i = 0; i < scales.size(); ++i)
        factor *= std::pow(scales[i], dimension[i]);
    return factor;
}

bool is_letter(char c) {
    return std::isalpha(static_cast<unsigned char>(c)) || c == '_' || (c & 0x80);
}
bool is_digit(char c) {
    return std::isdigit(static_cast<unsigned char>(c));
}
bool is_space(char c) {
    return std::isspace(static_cast<unsigned char>(c));
}

// Index of the first character at or after `at` that is not of the kind.
std::size_t after(std::string_view text, std::size_t at, bool (*kind)(char)) {
    while (at < text.size() && kind(text[at])) ++at;
    return at;
}

// End of a unit symbol with its power ("mm2", "s^-1") that begins at `at`; `at` itself if
// there is none, as at the name of a function.
std::size_t after_unit_factor(std::string_view text, std::size_t at) {
    if (text.substr(at, 1) == "%") return at + 1;
    const std::size_t name = after(text, at, is_letter);
    const std::size_t next = after(text, name, is_space);
    if (name == at || text.substr(next, 1) == "(") return at;
    std::size_t power = name;
    if (text.substr(power, 1) == "^") power = power + 1;
    if (text.substr(power, 1) == "-" && power > name) ++power;
    const std::size_t digits = after(text, power, is_digit);
    return digits > power ? digits : name;
}

// End of the unit that begins at `at`. A "/" belongs to it if the symbol of a unit
// follows, as in 5 mT/s, but not before the time or a function, as in 5 mT/t.
std::size_t after_unit(std::string_view text, std::size_t at) {
    std::size_t end = after_unit_factor(text, at);
    while (end > at && text.substr(end, 1) == "/") {
        const std::size_t next = after_unit_factor(text, end + 1);
        if (!is_unit_symbol(
                text.substr(end + 1, after(text, end + 1, is_letter) - end - 1)) ||
            next == end + 1)
            break;
        end = next;
    }
    return end;
}

// Rewrites a formula for another system of units: each number with its unit becomes a
// plain number of that system; everything else is kept, without spaces.
std::string in_units(std::string_view text, const Scales& scales) {
    std::string out;
    for (std::size_t at = 0; at < text.size();) {
        if (is_space(text[at])) {
            // The space is dropped, and muParser would read "3 4" as 34 and "a b" as ab.
            const std::size_t next = after(text, at, is_space);
            const auto joins = [](char c) {
                return is_letter(c) || is_digit(c) || c == '.';
            };
            if (!out.empty() && next < text.size() && joins(out.back()) &&
                joins(text[next]))
                throw Complaint(fmt::format("{} after {}", in_quotes(text.substr(next)),
                                            in_quotes(text.substr(0, at))),
                                "an operator such as * between two values");
            at = next;
        } else if (is_letter(text[at])) {
            const std::size_t end =
                after(text, at, [](char c) { return is_letter(c) || is_digit(c); });
            out += text.substr(at, end - at);
            at = end;
        } else if (is_digit(text[at]) || text[at] == '.') {
            double value = 0;
            const char* const begin = text.data() + at;
            const char* const stop =
                std::from_chars(begin, text.data() + text.size(), value).ptr;
            const auto number = at + static_cast<std::size_t>(stop - begin);
            const std::size_t unit = after(text, number, is_space);
            std::size_t end = after_unit(text, unit);
            const std::string_view name = text.substr(unit, end - unit);
            if (end == unit || name == "t" || name == "pi")  // left to muParser
                end = std::max(number, at + 1);              // steps over a lone "."
            const SiValue found = parse_any_quantity(text.substr(at, end - at));
            // The format prints the shortest digits that read back to the same double.
            out += fmt::format("{}", found.value * scale_of(found.dimension, scales));
            at = end;
        } else {
            out += text[at++];
        }
    }
    return out;
}

// Result of a dimensional analysis. `scales` is false if the formula is dimensionally
// wrong; `dimension` is empty if the value is zero at all times, which is compatible with
// any dimension.
struct Found {
    bool scales = true;
    std::optional<Dimension> dimension;
};

constexpr double other_unit = 4096;  // 2^12: square, cube and fourth roots are exact

// Finds the dimension of a formula. A formula is dimensionally right exactly if its value
// in any other system of units is the converted SI value (P. W. Bridgman, Dimensional
// Analysis, 1922, ch. 2). It is evaluated in SI and in four systems that differ from SI
// in one unit each, by a power of two, for which all operations except powers scale
// exactly. Sampling times over many orders of magnitude reaches all branches of
// comparisons such as t < 20 ms.
Found analyse(std::string_view text) {
    constexpr double tolerance = 1e-9;  // admits the rounding of powers
    const std::string si = in_units(text, {1, 1, 1, 1});
    Found found{.scales = true, .dimension = Dimension{}};
    bool zero = true;
    for (std::size_t unit = 0; unit < 4; ++unit) {
        Scales scales{1, 1, 1, 1};
        scales[unit] = other_unit;
        const std::string other = in_units(text, scales);
        std::optional<double> power;
        for (int sample = 0; sample < 60; ++sample) {
            const double t = 1.37e-7 * std::pow(1.61803, sample);  // 0.1 us to 3e5 s
            const double here = structure::value_or_nan(si, t);
            const double there =
                structure::value_or_nan(other, t * (unit == 2 ? other_unit : 1));
            if (!std::isfinite(here) || !std::isfinite(there) ||
                (here == 0 && there == 0))
                continue;
            zero = false;
            const double ratio = there / here;
            const double now = std::round(std::log2(ratio) / 12);
            if (!power) power = now;
            if (!(ratio > 0) || now != *power ||
                std::abs(ratio / std::pow(other_unit, now) - 1) > tolerance)
                return {.scales = false, .dimension = {}};
        }
        (*found.dimension)[unit] = power.value_or(0);
    }
    if (zero) found.dimension.reset();
    return found;
}

// Explains the first call such as "sin(25*t)" of a function of plain numbers whose
// argument has a dimension; "" if there is none.
std::string argument_with_a_unit(std::string_view text) {
    constexpr std::string_view functions[] = {"sin",  "cos",  "tan",  "asin", "acos",
                                              "atan", "sinh", "cosh", "tanh", "exp",
                                              "ln",   "log",  "log2", "log10"};
    for (std::size_t at = 0; at < text.size(); ++at) {
        if (!is_letter(text[at]) || (at > 0 && is_letter(text[at - 1]))) continue;
        const std::size_t name =
            after(text, at, [](char c) { return is_letter(c) || is_digit(c); });
        const std::size_t open = after(text, name, is_space);
        if (std::ranges::find(functions, text.substr(at, name - at)) ==
                std::end(functions) ||
            text.substr(open, 1) != "(")
            continue;
        int depth = 1;
        std::size_t close = open + 1;
        for (; close < text.size() && depth > 0; ++close)
            depth += text[close] == '(' ? 1 : text[close] == ')' ? -1 : 0;
        const std::string_view inner = text.substr(open + 1, close - open - 2);
        const Found found = analyse(inner);
        if (found.scales && found.dimension.value_or(Dimension{}) != Dimension{})
            return fmt::format("the argument of {} is {}, {} must be a plain number",
                               text.substr(at, name - at),
                               dimension_name(*found.dimension), in_quotes(inner));
    }
    return "";
}

}  // namespace

// Text of a formula in SI after the dimensional check. Errors of the syntax are found by
// evaluation and reported with the text as written.
std::string formula_in_si(const std::string& written, std::string_view si_unit) {
    const std::string text = words::plain(written);
    const std::string allowed = formula_expectation(si_unit);
    std::string si;
    Found found;
    try {
        si = in_units(text, {1, 1, 1, 1});
        found = analyse(text);
    } catch (const std::invalid_argument& fault) {
        throw Complaint(fmt::format("{}: {}", in_quotes(text), fault.what()), allowed);
    }
    if (!found.scales) {
        const std::string argument = argument_with_a_unit(text);
        throw Complaint(fmt::format("{}, which mixes quantities that are not of one kind",
                                    in_quotes(text)),
                        allowed,
                        argument.empty()
                            ? "what is added or compared has one dimension, and what a "
                              "function such as sin takes has none: sin(2*pi*25 Hz*t)"
                            : argument);
    }
    Dimension wanted = parse_unit(si_unit).dimension;
    wanted[4] = 0;  // angles count as plain numbers
    if (found.dimension && *found.dimension != wanted)
        throw Complaint(
            fmt::format("{}, {}", in_quotes(text), dimension_name(*found.dimension)),
            allowed);
    return si;
}

// The example's factor has the dimension asked for.
std::string formula_expectation(std::string_view si_unit) {
    constexpr std::array<std::array<std::string_view, 2>, 4> sizes{
        {{"T", "12 mT*"}, {"m", "3 mm*"}, {"A", "2 A*"}, {"rad", "90 deg*"}}};
    const auto* size = std::ranges::find(sizes, si_unit, [](auto& s) { return s[0]; });
    return fmt::format("{}, as a formula of the time t such as {}sin(2*pi*25 Hz*t)",
                       dimension_expectation(si_unit),
                       size == sizes.end() ? "" : (*size)[1]);
}

}  // namespace magfsi::scene
