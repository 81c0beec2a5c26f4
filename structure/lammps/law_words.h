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
        return Law{{Formula{words[1], words[1]}, Formula{words[2], words[2]},
                    Formula{words[3], words[3]}}};
    }
    static std::optional<Law> read(const std::string&, std::span<const double>) {
        return {};
    }
};

// Throws std::invalid_argument if one of the texts is no formula.
inline void check_formulas(std::span<const Formula> formulas) {
    for (const Formula& one : formulas) value_or_nan(one.si, 0);
}

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

// Sets the variant to the law that the words give. Throws std::invalid_argument, with the
// laws that there are, if there is no such law.
template <class... Laws>
void read_law(std::variant<Laws...>& out, std::span<const std::string> words) {
    if (words.empty())
        refuse("no word found for a law; its name is needed, and its numbers");
    // Laws that are not made of numbers alone come first.
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
