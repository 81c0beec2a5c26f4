// SPDX-License-Identifier: GPL-2.0-or-later
// Laws, the alternatives of a variant, as words of a LAMMPS command and back: a name and
// numbers.
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
#include <variant>
#include <vector>

#include "structure/formula.h"
#include "structure/refuse.h"

namespace magfsi::structure {

template <class Law>
constexpr const char* law_name = nullptr;

// Of a law whose members are all numbers: these in their order. Other laws specialise it.
template <class Law>
struct LawWords {
    static_assert(law_name<Law> != nullptr, "give the law its word: law_name<Law>");
    using Numbers = std::array<double, sizeof(Law) / sizeof(double)>;

    static std::string words(const Law& law) {  // 17 digits read back exactly
        return fmt::format("{} {:.17g}", law_name<Law>,
                           fmt::join(std::bit_cast<Numbers>(law), " "));
    }
    static std::string usage() {
        return fmt::format("{} has {}", law_name<Law>, Numbers{}.size());
    }
    // Nothing where name or number of values are not those of the law.
    static std::optional<Law> read(const std::string& name,
                                   std::span<const double> values) {
        Numbers numbers{};
        if (name != law_name<Law> || values.size() != numbers.size()) return {};
        std::ranges::copy(values, numbers.begin());
        return std::bit_cast<Law>(numbers);
    }
};

// Of a law of three formulas: these, words without spaces.
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
        return Law{{Formula{words[1], words[1]}, Formula{words[2], words[2]},
                    Formula{words[3], words[3]}}};
    }
    static std::optional<Law> read(const std::string&, std::span<const double>) {
        return {};
    }
};

// Throws std::invalid_argument where one is no formula.
inline void check_formulas(std::span<const Formula> formulas) {
    for (const Formula& one : formulas) value_or_nan(one.si, 0);
}

template <class... Laws>
std::string law_words(const std::variant<Laws...>& law) {
    return std::visit([]<class Law>(const Law& one) { return LawWords<Law>::words(one); },
                      law);
}

// The words as numbers. Throws std::invalid_argument.
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

// The law that the words name. Throws std::invalid_argument, naming the laws there are.
template <class... Laws>
void read_law(std::variant<Laws...>& out, std::span<const std::string> words) {
    if (words.empty()) refuse("a name is needed");
    // Laws that are not of numbers alone.
    const auto read_words = [&]<class Law>(std::type_identity<Law>) {
        if constexpr (requires { LawWords<Law>::read_words(words); }) {
            if (std::optional<Law> law = LawWords<Law>::read_words(words)) {
                out = *std::move(law);
                return true;
            }
        }
        return false;
    };
    if ((read_words(std::type_identity<Laws>{}) || ...)) return;
    const auto values = numbers_of(words.subspan(1));
    const auto read = [&]<class Law>(std::optional<Law> law) {
        if (law) out = *law;
        return law.has_value();
    };
    if ((read(LawWords<Laws>::read(words[0], values)) || ...)) return;
    const std::array<std::string, sizeof...(Laws)> known{LawWords<Laws>::usage()...};
    refuse("\"{}\" with {} numbers found; {}", words[0], values.size(),
           fmt::join(known, ", "));
}

}  // namespace magfsi::structure
