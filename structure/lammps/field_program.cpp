#include "structure/lammps/field_program.h"

#include <fmt/format.h>

#include <cmath>
#include <numbers>
#include <stdexcept>

#include "structure/lammps/field_table.h"

namespace magfsi::structure {
namespace {

void check_plane(const std::array<int, 2>& plane) {
    for (int axis : plane) {
        if (axis < 0 || axis > 2 || plane[0] == plane[1]) {
            throw std::invalid_argument(fmt::format(
                "field plane of axes {} and {} found, two different ones of 0, "
                "1, 2 are allowed",
                plane[0], plane[1]));
        }
    }
}

// Magnitude and direction at a time.
ConstantField polar(const ConstantField& course, double) {
    return course;
}
ConstantField polar(const RotatingField& course, double time_s) {
    return {course.magnitude_t,
            course.start_rad + 2 * std::numbers::pi * course.frequency_hz * time_s};
}
ConstantField polar(const FieldTable& course, double time_s) {
    check_table(course);
    const double t = fold_time(course, time_s);
    const double direction = course.direction_rad.size() == 1
                                 ? course.direction_rad[0]
                                 : interpolate(course.time_s, course.direction_rad, t);
    return {interpolate(course.time_s, course.magnitude_t, t), direction};
}

// Formulas of LAMMPS variables for magnitude and direction, and the lines before them.
struct Formulas {
    std::vector<std::string> lines;
    std::string magnitude, direction;
};

Formulas formulas(const ConstantField& course) {
    return {{}, number(course.magnitude_t), number(course.direction_rad)};
}
Formulas formulas(const RotatingField& course) {
    const double rate = 2 * std::numbers::pi * course.frequency_hz;
    return {
        {"variable t equal step*dt", fmt::format("variable theta equal {}+{}*v_t",
                                                 number(course.start_rad), number(rate))},
        number(course.magnitude_t),
        "v_theta"};
}
Formulas formulas(const FieldTable& course) {
    check_table(course);
    Formulas out;
    out.lines.push_back("variable t equal " + fold_formula(course));
    out.lines.push_back("variable B equal " +
                        table_formula(course.time_s, course.magnitude_t));
    out.magnitude = "v_B";
    if (course.direction_rad.size() == 1) {
        out.direction = number(course.direction_rad[0]);
    } else {
        out.lines.push_back("variable theta equal " +
                            table_formula(course.time_s, course.direction_rad));
        out.direction = "v_theta";
    }
    return out;
}

}  // namespace

Vec3 field_vector(const ConstantField& field, const std::array<int, 2>& plane) {
    check_plane(plane);
    Vec3 out{};
    out[plane[0]] = field.magnitude_t * std::cos(field.direction_rad);
    out[plane[1]] = field.magnitude_t * std::sin(field.direction_rad);
    return out;
}

Vec3 field_at(const FieldProgram& program, double time_s) {
    const ConstantField now = std::visit(
        [time_s](const auto& course) { return polar(course, time_s); }, program.course);
    return field_vector(now, program.plane);
}

std::vector<std::string> field_commands(const FieldProgram& program) {
    check_plane(program.plane);
    Formulas made =
        std::visit([](const auto& course) { return formulas(course); }, program.course);
    std::array<std::string, 3> component{"0", "0", "0"};
    // A leading minus would otherwise meet the factor's sign.
    component[program.plane[0]] =
        fmt::format("({})*cos({})", made.magnitude, made.direction);
    component[program.plane[1]] =
        fmt::format("({})*sin({})", made.magnitude, made.direction);
    for (int d = 0; d < 3; ++d) {
        made.lines.push_back(
            fmt::format("variable B{} equal {}", "xyz"[d], component[d]));
    }
    return made.lines;
}

}  // namespace magfsi::structure
