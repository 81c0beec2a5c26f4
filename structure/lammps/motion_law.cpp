// SPDX-License-Identifier: GPL-2.0-or-later
#include "structure/lammps/motion_law.h"

#include "structure/lammps/motion_words.h"
#include "structure/refuse.h"

namespace magfsi::structure {

// "turning", the axis, its point, then the angle's law: "oscillation" with three numbers,
// or "angle" with a formula.
template <>
struct LawWords<TurningMotion> {
    static std::string words(const TurningMotion& turning) {
        std::string out =
            fmt::format("turning {:.17g} {:.17g} ", fmt::join(turning.axis, " "),
                        fmt::join(turning.about_m, " "));
        if (const auto* o = std::get_if<AngleOscillation>(&turning.angle))
            return out + fmt::format("oscillation {:.17g} {:.17g} {:.17g}",
                                     o->amplitude_rad, o->frequency_hz, o->phase_rad);
        return out + "angle " + std::get<Formula>(turning.angle).si;
    }
    static std::string usage() {
        return "turning has 6 numbers, then oscillation and 3 or angle and a formula";
    }
    static std::optional<TurningMotion> read_words(std::span<const std::string> words) {
        if (words.size() < 9 || words[0] != "turning") return {};
        const auto place = numbers_of(words.subspan(1, 6));
        TurningMotion out{vector_at(place.data()), vector_at(place.data() + 3), {}};
        const auto angle = words.subspan(8);
        if (words[7] == "angle" && angle.size() == 1) {
            out.angle = formula_of(angle[0]);
        } else if (words[7] == "oscillation" && angle.size() == 3) {
            const auto numbers = numbers_of(angle);
            out.angle = AngleOscillation{numbers[0], numbers[1], numbers[2]};
        } else {
            return {};
        }
        return out;
    }
};

template <>
constexpr const char* law_name<HeldDisplacement> = "held";

namespace {

void check(const Oscillation& o) {
    if (!(o.frequency_hz > 0)) refuse("an oscillation needs a frequency above zero");
}

void check(const DisplacementRamp& r) {
    if (!(r.duration_s > 0)) refuse("a ramp needs a duration above zero");
}

void check(const HeldDisplacement&) {}

// A formula is checked as it is read.
void check(const FormulaMotion&) {}

void check(const TurningMotion& turning) {
    if (!(norm(turning.axis) > 0)) refuse("a turn needs an axis with a direction");
    if (const auto* o = std::get_if<AngleOscillation>(&turning.angle);
        o && !(o->frequency_hz > 0))
        refuse("an oscillation needs a frequency above zero");
}

}  // namespace

std::string motion_words(const MotionCourse& course) {
    return law_words(course);
}

MotionCourse motion_from(const std::vector<std::string>& words) {
    MotionCourse course;
    read_law(course, words);
    std::visit([](const auto& c) { check(c); }, course);
    return course;
}

}  // namespace magfsi::structure
