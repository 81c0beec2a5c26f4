// SPDX-License-Identifier: GPL-2.0-or-later
#include "structure/lammps/source_words.h"

#include <initializer_list>
#include <iterator>
#include <ranges>
#include <sstream>
#include <string_view>

#include "base/words/path_word.h"
#include "structure/lammps/motion_words.h"

namespace magfsi::structure {

using Words = std::span<const std::string>;

template <>
constexpr const char* law_name<DipoleSource> = "dipole";
template <>
constexpr const char* law_name<CuboidMagnet> = "cuboid";
template <>
constexpr const char* law_name<CylinderMagnet> = "cylinder";
template <>
constexpr const char* law_name<CircularCoil> = "coil";
template <>
constexpr const char* law_name<StrengthOscillation> = "oscillation";
template <>
constexpr const char* law_name<StrengthRamp> = "ramp";
template <>
constexpr const char* law_name<StrengthTable> = "table";
template <>
struct LawWords<StrengthTable> : TableWords<StrengthTable, &StrengthTable::factor> {};
template <>
constexpr const char* law_name<SourcePath> = "path";
template <>
struct LawWords<SourcePath> : TableWords<SourcePath, &SourcePath::displacement_m> {};

template <>
struct LawWords<Formula> {
    static std::string words(const Formula& formula) { return "formula " + formula.si; }
    static std::string usage() { return "formula has one formula of t"; }
    static std::optional<Formula> read_words(Words words) {
        if (words.size() != 2 || words[0] != "formula") return {};
        return formula_of(words[1]);
    }
};

template <>
struct LawWords<CoilPair> {
    using Coil = LawWords<CircularCoil>::Numbers;

    static std::string words(const CoilPair& pair) {
        const auto coil = std::bit_cast<Coil>(static_cast<const CircularCoil&>(pair));
        return fmt::format("{} {:.17g} {:.17g}", pair.opposed ? "opposed_pair" : "pair",
                           fmt::join(coil, " "), pair.distance_m);
    }
    static std::string usage() { return "pair and opposed_pair have 7"; }
    static std::optional<CoilPair> read(const std::string& name,
                                        std::span<const double> values) {
        const bool opposed = name == "opposed_pair";
        Coil coil{};
        if ((name != "pair" && !opposed) || values.size() != coil.size() + 1) return {};
        std::ranges::copy(values.first(coil.size()), coil.begin());
        return CoilPair{std::bit_cast<CircularCoil>(coil), values.back(), opposed};
    }
};

template <>
struct LawWords<GridField> {
    static std::string words(const GridField& grid) {
        return "grid " + words::path_word(grid.file);
    }
    static std::string usage() { return "grid has one file"; }
    static std::optional<GridField> read_words(Words words) {
        if (words.size() != 2 || words[0] != "grid") return {};
        return GridField{words::path_of_word(words[1])};
    }
};

namespace {

// Cuts the words before each keyword. The first part, of `first` words at least, begins
// with none.
std::vector<Words> parts_of(Words words, std::size_t first,
                            std::initializer_list<std::string_view> keywords) {
    std::vector<Words> parts;
    std::size_t begin = 0;
    for (std::size_t i = std::min(first, words.size()); i <= words.size(); ++i) {
        if (i < words.size() && std::ranges::find(keywords, words[i]) == keywords.end())
            continue;
        parts.push_back(words.subspan(begin, i - begin));
        begin = i;
    }
    return parts;
}

// Numbers after the keyword of a part. Throws unless they are so many.
std::vector<double> numbers_after(Words part, std::size_t count) {
    std::vector<double> numbers = numbers_of(part.subspan(1));
    if (numbers.size() != count)
        refuse("\"{}\" with {} numbers found, it has {}", part[0], numbers.size(), count);
    return numbers;
}

Vec3 vector_at(std::span<const double> numbers, std::size_t i) {
    return {numbers[i], numbers[i + 1], numbers[i + 2]};
}

SystemCoil coil_of(std::span<const double> n) {
    constexpr std::size_t shape = 8;  // numbers before the currents
    if (n.size() < shape)
        refuse(
            "a member of a coil system with {} numbers found, it has {} and its "
            "currents",
            n.size(), shape);
    return {vector_at(n, 0), n[3], vector_at(n, 4), n[7], {n.begin() + shape, n.end()}};
}

}  // namespace

template <>
struct LawWords<CoilSystem> {
    static std::string words(const CoilSystem& system) {
        std::string out = "system";
        if (!system.time_s.empty())
            out += fmt::format(" {} {:.17g}", system.repeat ? "repeat_times" : "times",
                               fmt::join(system.time_s, " "));
        for (const SystemCoil& coil : system.coils) {
            out += fmt::format(" member {:.17g} {:.17g} {:.17g} {:.17g}",
                               fmt::join(coil.position_m, " "), coil.diameter_m,
                               fmt::join(coil.axis, " "), coil.turns);
            for (const double current_a : coil.current_a)
                out += fmt::format(" {:.17g}", current_a);
            if (coil.current) out += " current " + coil.current->si;
        }
        return out;
    }
    static std::string usage() { return "system has members"; }
    static std::optional<CoilSystem> read_words(Words words) {
        const auto parts =
            parts_of(words, 1, {"times", "repeat_times", "member", "current"});
        if (words[0] != "system" || parts[0].size() != 1) return {};
        CoilSystem system;
        for (const Words part : parts | std::views::drop(1)) {
            if (part[0] == "member") {
                system.coils.push_back(coil_of(numbers_of(part.subspan(1))));
            } else if (part[0] == "current") {
                if (part.size() != 2 || system.coils.empty())
                    refuse("\"current\" found, it is one formula of t after a member");
                system.coils.back().current = formula_of(part[1]);
            } else {
                system.time_s = numbers_of(part.subspan(1));
                system.repeat = part[0] == "repeat_times";
            }
        }
        return system;
    }
};

namespace {

std::string words_of_turning(const SourceTurning& turning) {
    const auto* formula = std::get_if<Formula>(&turning.turns);
    std::string out = fmt::format(" {} {:.17g} ", formula ? "angle" : "turning",
                                  fmt::join(turning.axis, " "));
    out +=
        formula ? formula->si : fmt::format("{:.17g}", std::get<double>(turning.turns));
    if (turning.about_m) out += fmt::format(" {:.17g}", fmt::join(*turning.about_m, " "));
    return out;
}

std::string text_of(const FieldSource& source) {
    std::string out = fmt::format("{} at {:.17g}", law_words(source.shape),
                                  fmt::join(source.position_m, " "));
    if (const auto& turn = source.rotation)
        out += fmt::format(" rotated {:.17g} {:.17g}", fmt::join(turn->axis, " "),
                           turn->angle_rad);
    if (source.strength) out += " strength " + law_words(*source.strength);
    if (source.motion) out += " motion " + law_words(*source.motion);
    if (source.turning) out += words_of_turning(*source.turning);
    return out;
}

// Reads "turning AX AY AZ FREQUENCY [X Y Z]", or "angle" with a formula as fourth word.
SourceTurning turning_of(Words part) {
    std::vector<std::string> rest(part.begin() + 1, part.end());
    SourceTurning turning;
    if (part[0] == "angle" && rest.size() > 3) {
        turning.turns = formula_of(rest[3]);
        rest[3] = "0";
    }
    const auto n = numbers_of(rest);
    if (n.size() != 4 && n.size() != 7)
        refuse("\"{}\" with {} values found, it has 4, or 7 with a point", part[0],
               n.size());
    turning.axis = vector_at(n, 0);
    if (part[0] == "turning") turning.turns = n[3];
    if (n.size() == 7) turning.about_m = vector_at(n, 4);
    return turning;
}

FieldSource source_of(Words words) {
    // A file of a grid may have the name of a keyword.
    const auto parts =
        parts_of(words, 2, {"at", "rotated", "strength", "motion", "turning", "angle"});
    FieldSource source;
    read_law(source.shape, parts[0]);
    for (const Words part : parts | std::views::drop(1)) {
        if (part[0] == "at") {
            source.position_m = vector_at(numbers_after(part, 3), 0);
        } else if (part[0] == "rotated") {
            const auto n = numbers_after(part, 4);
            source.rotation = AxisRotation{vector_at(n, 0), n[3]};
        } else if (part[0] == "strength") {
            read_law(source.strength.emplace(), part.subspan(1));
        } else if (part[0] == "motion") {
            read_law(source.motion.emplace(), part.subspan(1));
        } else {
            source.turning = turning_of(part);
        }
    }
    return source;
}

}  // namespace

std::string source_words(const std::vector<FieldSource>& sources) {
    std::string out;
    for (const FieldSource& source : sources)
        out += (out.empty() ? "" : " ; ") + text_of(source);
    return out;
}

std::vector<FieldSource> parse_source_words(const std::string& text) {
    std::vector<FieldSource> out;
    std::istringstream stream(text);
    for (std::string part; std::getline(stream, part, ';');) {
        std::istringstream in(part);
        const std::vector<std::string> words{std::istream_iterator<std::string>(in), {}};
        out.push_back(source_of(words));
    }
    if (out.empty()) refuse("no source of the field found, one is needed");
    return out;
}

}  // namespace magfsi::structure
