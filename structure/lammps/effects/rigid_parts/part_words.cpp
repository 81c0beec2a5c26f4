// SPDX-License-Identifier: GPL-2.0-or-later
#include "structure/lammps/effects/rigid_parts/part_words.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <type_traits>

#include "structure/lammps/motion_law.h"
#include "structure/lammps/names.h"

namespace magfsi::structure {

namespace {

std::string words_of(const Hinge& hinge) {
    return fmt::format(" hinge {:.17g} {:.17g}", fmt::join(hinge.about_m, " "),
                       fmt::join(hinge.axis, " "));
}

std::string words_of(const Pivot& pivot) {
    return fmt::format(" pivot {:.17g}", fmt::join(pivot.about_m, " "));
}

std::string words_of(const RigidCourse& moved) {
    std::string out;
    for (const MotionCourse& course : moved.courses()) {
        const std::string words = motion_words(course);
        out += fmt::format(" moved {} {}", 1 + std::ranges::count(words, ' '), words);
    }
    return out;
}

}  // namespace

std::string words_of_part(const PartWords& part) {
    const Eigen::Matrix3d& i = part.inertia.inertia_kg_m2;
    std::string out = fmt::format(
        " part {:.17g} {:.17g} {:.17g} {:.17g} {:.17g} {:.17g} {:.17g} {:.17g}",
        part.inertia.mass_kg, fmt::join(part.inertia.centre_m, " "), i(0, 0), i(1, 1),
        i(2, 2), i(0, 1), i(0, 2), i(1, 2));
    if (part.velocity_m_s != Vec3{} || part.angular_velocity_rad_s != Vec3{})
        out += fmt::format(" velocity {:.17g} {:.17g}", fmt::join(part.velocity_m_s, " "),
                           fmt::join(part.angular_velocity_rad_s, " "));
    if (part.inertia.hold)
        out += std::visit([](const auto& hold) { return words_of(hold); },
                          *part.inertia.hold);
    return out + " nodes " + id_ranges(part.ids);
}

namespace {

// Adds the atom IDs of "N", "N:M" or "N:M:STEP". Throws std::invalid_argument.
void add_ids(std::vector<int>& ids, const std::string& word) {
    std::array<int, 3> number{0, 0, 1};
    std::size_t count = 0;
    const char* at = word.data();
    const char* const end = at + word.size();
    while (count < 3) {
        const auto [next, fault] = std::from_chars(at, end, number[count]);
        if (fault != std::errc{}) break;
        ++count;
        at = next;
        if (at == end || *at != ':') break;
        ++at;
    }
    if (count < 2) number[1] = number[0];
    if (count == 0 || at != end || number[0] < 1 || number[2] < 1)
        refuse("\"{}\" found; allowed is an atom ID, or a range such as 1:26:5", word);
    for (int id = number[0]; id <= number[1]; id += number[2]) ids.push_back(id);
}

// Reads the words after "moved". Throws std::invalid_argument.
void read_course(WordReader& words, RigidCourse& course) {
    std::vector<std::string> own(static_cast<std::size_t>(words.value()));
    for (std::string& word : own) word = words.word();
    std::visit(
        [&]<class Course>(const Course& one) {
            if constexpr (std::is_same_v<Course, HeldDisplacement>)
                refuse("\"{}\" of a rigid part found", own[0]);
            else if constexpr (std::is_same_v<Course, TurningMotion>)
                course.turning = one;
            else
                course.way = one;
        },
        motion_from(own));
}

}  // namespace

PartWords read_part(WordReader& words) {
    PartWords part;
    part.inertia.mass_kg = words.value();
    part.inertia.centre_m = words.vector();
    const Vec3 on = words.vector(), off = words.vector();
    part.inertia.inertia_kg_m2 << on[0], off[0], off[1], off[0], on[1], off[2], off[1],
        off[2], on[2];
    if (words.take("velocity")) {
        part.velocity_m_s = words.vector();
        part.angular_velocity_rad_s = words.vector();
    }
    if (words.take("hinge")) {
        const Vec3 about = words.vector();
        part.inertia.hold = Hinge{words.vector(), about};
    } else if (words.take("pivot")) {
        part.inertia.hold = Pivot{words.vector()};
    } else if (words.next_is("moved")) {
        RigidCourse course;
        while (words.take("moved")) read_course(words, course);
        part.inertia.hold = course;
    }
    if (!words.take("nodes"))
        refuse(
            "\"{}\" found; a part has velocity with six numbers, pivot with three, "
            "hinge with six or moved with a course, then nodes with atom IDs",
            words.word());
    while (!words.done() && !words.next_is("part")) add_ids(part.ids, words.word());
    return part;
}

}  // namespace magfsi::structure
