// SPDX-License-Identifier: GPL-2.0-or-later
#include "structure/lammps/source_words.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>
#include <span>
#include <sstream>

#include "structure/lammps/law_words.h"
#include "structure/refuse.h"
#include "words/path_word.h"

namespace magfsi::structure {
namespace {

// --- writing

std::string words(const char* word,
                  std::initializer_list<std::span<const double>> parts) {
    std::string out = word;
    for (const auto part : parts)
        for (const double number : part) out += fmt::format(" {:.17g}", number);
    return out;
}
std::span<const double> one(const double& number) {
    return {&number, 1};
}

std::string rows(const char* word, const std::vector<double>& time_s,
                 const std::vector<double>& value) {
    std::string out = word;
    for (std::size_t i = 0; i < time_s.size(); ++i)
        out += fmt::format(" {:.17g} {:.17g}", time_s[i], value[i]);
    return out;
}

// Words of each shape, strength and motion, for std::visit.
struct Writer {
    std::string operator()(const DipoleSource& s) const {
        return words("dipole", {s.moment_a_m2});
    }
    std::string operator()(const CuboidMagnet& s) const {
        return words("cuboid", {s.size_m, s.remanence_t});
    }
    std::string operator()(const CylinderMagnet& s) const {
        return words("cylinder",
                     {one(s.diameter_m), one(s.height_m), s.axis, s.remanence_t});
    }
    std::string operator()(const CircularCoil& s) const {
        return words("coil", {one(s.diameter_m), s.axis, one(s.current_a), one(s.turns)});
    }
    std::string operator()(const CoilPair& s) const {
        return words(s.opposed ? "opposed_pair" : "pair",
                     {one(s.diameter_m), s.axis, one(s.current_a), one(s.turns),
                      one(s.distance_m)});
    }
    std::string operator()(const CoilSystem& s) const {
        std::string out = "system";
        if (!s.time_s.empty())
            out += words(s.repeat ? " repeat_times" : " times", {s.time_s});
        for (const SystemCoil& coil : s.coils) {
            out += words(" member", {coil.position_m, one(coil.diameter_m), coil.axis,
                                     one(coil.turns), coil.current_a});
            if (coil.current) out += " current " + coil.current->si;
        }
        return out;
    }
    std::string operator()(const GridField& s) const {
        return "grid " + words::path_word(s.file);
    }

    std::string operator()(const StrengthOscillation& s) const {
        return words("oscillating", {one(s.frequency_hz), one(s.phase_rad)});
    }
    std::string operator()(const StrengthTable& s) const {
        return rows(s.repeat ? "repeat_factors" : "factors", s.time_s, s.factor);
    }
    std::string operator()(const StrengthRamp& s) const {
        return words("rising", {one(s.duration_s)});
    }
    std::string operator()(const Formula& s) const { return "factor " + s.si; }
    std::string operator()(const Oscillation& s) const {
        return words("swinging", {s.amplitude_m, one(s.frequency_hz), one(s.phase_rad)});
    }
    std::string operator()(const DisplacementRamp& s) const {
        return words("shifting", {s.displacement_m, one(s.duration_s)});
    }
    std::string operator()(const FormulaMotion& s) const {
        std::string out = "shift";
        for (const Formula& component : s.component_m) out += " " + component.si;
        return out;
    }
    std::string operator()(const SourcePath& s) const {
        std::string out = s.repeat ? "repeat_path" : "path";
        for (std::size_t i = 0; i < s.time_s.size(); ++i)
            out += words("", {one(s.time_s[i]), s.displacement_m[i]});
        return out;
    }
};

std::string text_of(const FieldSource& source) {
    std::string out = std::visit(Writer{}, source.shape);
    const auto add = [&](const std::string& text) { (out += ' ') += text; };
    out += words(" at", {source.position_m});
    if (source.rotation)
        out +=
            words(" rotated", {source.rotation->axis, one(source.rotation->angle_rad)});
    if (source.strength) add(std::visit(Writer{}, *source.strength));
    if (source.motion) add(std::visit(Writer{}, *source.motion));
    if (source.turning) {
        const SourceTurning& turning = *source.turning;
        const auto* formula = std::get_if<Formula>(&turning.turns);
        if (formula)
            out += " angle " + formula->si + words(" about", {turning.axis});
        else
            out +=
                words(" turning", {turning.axis, one(std::get<double>(turning.turns))});
        if (turning.about_m) out += words("", {*turning.about_m});
    }
    return out;
}

// --- reading

// A keyword, the texts after it that are no numbers (file or formulas), and the numbers
// after these, which take() hands out in order.
struct Group {
    std::string word;
    std::vector<std::string> texts;
    std::vector<double> numbers{};
    std::size_t taken = 0;

    double take() {
        if (taken == numbers.size())
            refuse(
                "\"{}\" with {} numbers found for a source of the field, more are needed",
                word, numbers.size());
        return numbers[taken++];
    }
    Vec3 take3() {
        const double x = take(), y = take(), z = take();
        return {x, y, z};
    }
    std::size_t left() const { return numbers.size() - taken; }
    Formula formula(std::size_t i = 0) const {
        if (i >= texts.size())
            refuse(
                "\"{}\" with {} formulas found for a source of the field, more are "
                "needed",
                word, texts.size());
        value_or_nan(texts[i], 0);  // refuses what is none
        return {texts[i], texts[i]};
    }
};

// Number of texts, a file or formulas, that follow a keyword.
std::size_t texts_after(const std::string& word) {
    if (word == "shift") return 3;
    const bool has_one =
        word == "grid" || word == "current" || word == "factor" || word == "angle";
    return has_one ? 1 : 0;
}

bool is_word(const std::string& text) {
    return std::isalpha(static_cast<unsigned char>(text.front())) != 0;
}

// Splits a source's text at its keywords. Throws on a number or formula in the wrong
// place.
std::vector<Group> groups_of(const std::string& text) {
    std::vector<Group> out;
    std::istringstream stream(text);
    for (std::string word; stream >> word;) {
        if (!out.empty() && out.back().texts.size() < texts_after(out.back().word)) {
            out.back().texts.push_back(word);
        } else if (is_word(word)) {
            out.push_back({word, {}});
        } else if (out.empty()) {
            refuse("\"{}\" found, a source of the field begins with its kind", word);
        } else {
            out.back().numbers.push_back(numbers_of({&word, 1}).front());
        }
    }
    return out;
}

// The read_ functions interpret one group. They return false if its keyword is not
// theirs.
bool read_coil(Group& g, CircularCoil& coil) {
    coil.diameter_m = g.take();
    coil.axis = g.take3();
    coil.current_a = g.take();
    coil.turns = g.take();
    return true;
}

bool read_shape(Group& g, SourceShape& out) {
    if (g.word == "dipole") {
        out = DipoleSource{g.take3()};
    } else if (g.word == "cuboid") {
        const Vec3 size_m = g.take3();
        out = CuboidMagnet{size_m, g.take3()};
    } else if (g.word == "cylinder") {
        const double diameter_m = g.take(), height_m = g.take();
        const Vec3 axis = g.take3();
        out = CylinderMagnet{diameter_m, height_m, axis, g.take3()};
    } else if (g.word == "coil") {
        CircularCoil coil;
        read_coil(g, coil);
        out = coil;
    } else if (g.word == "pair" || g.word == "opposed_pair") {
        CoilPair pair;
        read_coil(g, pair);
        pair.distance_m = g.take();
        pair.opposed = g.word == "opposed_pair";
        out = pair;
    } else if (g.word == "system") {
        out = CoilSystem{};
    } else if (g.word == "grid") {
        if (g.texts.size() != 1)
            refuse("\"grid\" with {} files found, one is needed", g.texts.size());
        out = GridField{words::path_of_word(g.texts.front())};
    } else {
        return false;
    }
    return true;
}

bool read_member(Group& g, SourceShape& shape) {
    auto* system = std::get_if<CoilSystem>(&shape);
    if (!system) return false;
    if (g.word == "times" || g.word == "repeat_times") {
        system->repeat = g.word == "repeat_times";
        while (g.left() > 0) system->time_s.push_back(g.take());
        return true;
    }
    if (g.word == "current" && !system->coils.empty()) {
        system->coils.back().current = g.formula();
        return true;
    }
    if (g.word != "member") return false;
    SystemCoil coil;
    coil.position_m = g.take3();
    coil.diameter_m = g.take();
    coil.axis = g.take3();
    coil.turns = g.take();
    while (g.left() > 0) coil.current_a.push_back(g.take());
    system->coils.push_back(coil);
    return true;
}

bool read_strength(Group& g, FieldSource& out) {
    if (g.word == "oscillating") {
        const double frequency_hz = g.take();
        out.strength = StrengthOscillation{frequency_hz, g.take()};
    } else if (g.word == "rising") {
        out.strength = StrengthRamp{g.take()};
    } else if (g.word == "factor") {
        out.strength = g.formula();
    } else if (g.word == "factors" || g.word == "repeat_factors") {
        StrengthTable table;
        table.repeat = g.word == "repeat_factors";
        while (g.left() > 0) {
            table.time_s.push_back(g.take());
            table.factor.push_back(g.take());
        }
        out.strength = table;
    } else {
        return false;
    }
    return true;
}

bool read_motion(Group& g, FieldSource& out) {
    if (g.word == "swinging") {
        const Vec3 amplitude_m = g.take3();
        const double frequency_hz = g.take();
        out.motion = Oscillation{amplitude_m, frequency_hz, g.take()};
    } else if (g.word == "shifting") {
        const Vec3 way_m = g.take3();
        out.motion = DisplacementRamp{way_m, g.take()};
    } else if (g.word == "path" || g.word == "repeat_path") {
        SourcePath path;
        path.repeat = g.word == "repeat_path";
        while (g.left() > 0) {
            path.time_s.push_back(g.take());
            path.displacement_m.push_back(g.take3());
        }
        out.motion = path;
    } else if (g.word == "shift") {
        out.motion = FormulaMotion{{g.formula(0), g.formula(1), g.formula(2)}};
    } else if (g.word == "turning") {
        SourceTurning turning;
        turning.axis = g.take3();
        turning.turns = g.take();
        if (g.left() > 0) turning.about_m = g.take3();
        out.turning = turning;
    } else if (g.word == "angle") {
        out.turning = SourceTurning{{}, g.formula(), {}};
    } else if (g.word == "about" && out.turning) {
        out.turning->axis = g.take3();
        if (g.left() > 0) out.turning->about_m = g.take3();
    } else {
        return false;
    }
    return true;
}

bool read_place(Group& g, FieldSource& out) {
    if (g.word == "at") {
        out.position_m = g.take3();
        return true;
    }
    if (g.word != "rotated") return false;
    const Vec3 axis = g.take3();
    out.rotation = AxisRotation{axis, g.take()};
    return true;
}

FieldSource source_from(const std::string& text) {
    std::vector<Group> groups = groups_of(text);
    FieldSource source;
    if (groups.empty() || !read_shape(groups.front(), source.shape)) {
        refuse(
            "\"{}\" found; a source of the field is dipole, cuboid, cylinder, coil, "
            "pair, opposed_pair, system or grid",
            groups.empty() ? "" : groups.front().word);
    }
    for (Group& g : groups) {
        const bool known = &g == &groups.front() || read_member(g, source.shape) ||
                           read_place(g, source) || read_strength(g, source) ||
                           read_motion(g, source);
        if (!known)
            refuse(
                "\"{}\" found in a source of the field of the kind {}, which has no such "
                "word",
                g.word, groups.front().word);
        if (g.left() > 0)
            refuse(
                "\"{}\" with {} numbers found for a source of the field, {} are allowed",
                g.word, g.numbers.size(), g.taken);
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
    for (std::string part; std::getline(stream, part, ';');)
        out.push_back(source_from(part));
    if (out.empty()) refuse("no source of the field found, one is needed");
    return out;
}

}  // namespace magfsi::structure
