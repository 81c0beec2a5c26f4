// SPDX-License-Identifier: GPL-2.0-or-later
// Laws, which are the alternatives of a std::variant, as words of a LAMMPS command and
// back. The first word is the law's name.
#pragma once

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <bit>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include "structure/formula.h"
#include "structure/refuse.h"

namespace magfsi::structure {

// Name of a law in commands. A law with the generic LawWords must specialise it.
template <class Law>
constexpr const char* law_name = nullptr;

// Words of one law. The generic form is for structs whose members are all of type double:
// the words are their values in the order of declaration. Other laws specialise it.
template <class Law>
struct LawWords {
    static_assert(law_name<Law> != nullptr, "give the law its word: law_name<Law>");
    using Numbers = std::array<double, sizeof(Law) / sizeof(double)>;

    static std::string words(const Law& law) {  // 17 digits read back exactly
        return fmt::format("{} {:.17g}", law_name<Law>,
                           fmt::join(std::bit_cast<Numbers>(law), " "));
    }
    // Number of values, for error messages.
    static std::string usage() {
        return fmt::format("{} has {}", law_name<Law>, Numbers{}.size());
    }
    // The law, or nothing if the name or the number of values is not that of the law.
    static std::optional<Law> read(const std::string& name,
                                   std::span<const double> values) {
        Numbers numbers{};
        if (name != law_name<Law> || values.size() != numbers.size()) return {};
        std::ranges::copy(values, numbers.begin());
        return std::bit_cast<Law>(numbers);
    }
};

// The word as a formula. Throws std::invalid_argument if it is none.
inline Formula formula_of(const std::string& word) {
    value_or_nan(word, 0);
    return {word, word};
}

// Words of a law that is one array of three formulas: "formula" and the three texts, none
// of which may contain blanks.
template <class Law>
struct FormulaWords {
    static std::string words(const Law& law) {
        const auto& [component] = law;
        return fmt::format("formula {} {} {}", component[0].si, component[1].si,
                           component[2].si);
    }
    static std::string usage() { return "formula has 3 formulas of t"; }
    static std::optional<Law> read_words(std::span<const std::string> words) {
        if (words.size() != 4 || words[0] != "formula") return {};
        return Law{{formula_of(words[1]), formula_of(words[2]), formula_of(words[3])}};
    }
};

// Words of a table: its name, with "repeat_" before it if it starts again after its last
// row, then rows of a time and a value. Values: the member that has the values, numbers
// or vectors.
template <class Table, auto Values>
struct TableWords {
    using Value =
        typename std::remove_cvref_t<decltype(std::declval<Table>().*Values)>::value_type;
    using Numbers = std::array<double, sizeof(Value) / sizeof(double)>;
    static constexpr std::size_t row = 1 + Numbers{}.size();

    static std::string words(const Table& table) {
        std::string out = table.repeat ? "repeat_" : "";
        out += law_name<Table>;
        for (std::size_t i = 0; i < table.time_s.size(); ++i) {
            out +=
                fmt::format(" {:.17g} {:.17g}", table.time_s[i],
                            fmt::join(std::bit_cast<Numbers>((table.*Values)[i]), " "));
        }
        return out;
    }
    static std::string usage() {
        return fmt::format("{0} and repeat_{0} have {1} per row", law_name<Table>, row);
    }
    static std::optional<Table> read(const std::string& name,
                                     std::span<const double> values) {
        const bool repeat = name == std::string("repeat_") + law_name<Table>;
        if ((name != law_name<Table> && !repeat) || values.size() % row != 0) return {};
        Table table;
        table.repeat = repeat;
        for (; !values.empty(); values = values.subspan(row)) {
            Numbers numbers{};
            std::ranges::copy(values.subspan(1, row - 1), numbers.begin());
            table.time_s.push_back(values[0]);
            (table.*Values).push_back(std::bit_cast<Value>(numbers));
        }
        return table;
    }
};

// Words of the law that the variant holds.
template <class... Laws>
std::string law_words(const std::variant<Laws...>& law) {
    return std::visit([]<class Law>(const Law& one) { return LawWords<Law>::words(one); },
                      law);
}

// The words as numbers. Throws std::invalid_argument, with the word, if one is no number.
inline std::vector<double> numbers_of(std::span<const std::string> words) {
    std::vector<double> out;
    for (const std::string& word : words) {
        std::size_t read = 0;
        try {
            out.push_back(std::stod(word, &read));
        } catch (const std::exception&) {
            read = 0;
        }
        if (read == 0 || read != word.size()) {
            refuse("\"{}\" found, a number is needed", word);
        }
    }
    return out;
}

// The law from words of which not all are numbers, or from a name and numbers; nothing if
// this law has no such form.
template <class Law>
std::optional<Law> law_of_words(std::span<const std::string> words) {
    if constexpr (requires { LawWords<Law>::read_words(words); })
        return LawWords<Law>::read_words(words);
    else
        return {};
}
template <class Law>
std::optional<Law> law_of_numbers(const std::string& name,
                                  std::span<const double> values) {
    if constexpr (requires { LawWords<Law>::read(name, values); })
        return LawWords<Law>::read(name, values);
    else
        return {};
}

// Sets the variant to the law that the words give. Throws std::invalid_argument, with the
// laws that there are, if there is no such law.
template <class... Laws>
void read_law(std::variant<Laws...>& out, std::span<const std::string> words) {
    if (words.empty())
        refuse("no word found for a law; its name is needed, and its numbers");
    const auto take = [&]<class Law>(std::optional<Law> law) {
        if (law) out = *std::move(law);
        return law.has_value();
    };
    // Laws that are not made of numbers alone come first.
    if ((take(law_of_words<Laws>(words)) || ...)) return;
    const auto values = numbers_of(words.subspan(1));
    if ((take(law_of_numbers<Laws>(words[0], values)) || ...)) return;
    const std::array<std::string, sizeof...(Laws)> known{LawWords<Laws>::usage()...};
    refuse("\"{}\" with {} numbers found; {}", words[0], values.size(),
           fmt::join(known, ", "));
}

}  // namespace magfsi::structure
