#include "structure/lammps/field_program.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

namespace magfsi::structure {
namespace {

void check_plane(const std::array<int, 2>& plane) {
    const bool axes =
        std::ranges::all_of(plane, [](int axis) { return axis >= 0 && axis <= 2; });
    if (!axes || plane[0] == plane[1]) {
        throw std::invalid_argument(
            fmt::format("field plane of axes {} and {} found, two different ones of 0, "
                        "1, 2 are allowed",
                        plane[0], plane[1]));
    }
}

void check_table(const FieldTable& table) {
    const std::size_t rows = table.time_s.size();
    const std::size_t directions = table.direction_rad.size();
    if (rows == 0 || table.magnitude_t.size() != rows ||
        (directions != 1 && directions != rows)) {
        throw std::invalid_argument(
            fmt::format("field table with {} times, {} magnitudes and {} directions "
                        "found; it needs one "
                        "magnitude a time and one direction, or one a time",
                        rows, table.magnitude_t.size(), directions));
    }
    if (!std::ranges::is_sorted(table.time_s)) {
        throw std::invalid_argument("the times of a field table must not fall");
    }
    if (table.repeat && !(table.time_s.back() > table.time_s.front())) {
        throw std::invalid_argument("a repeated field table needs a period above zero");
    }
}

double fold_time(const FieldTable& table, double time_s) {
    if (!table.repeat) return time_s;
    const double start = table.time_s.front();
    const double period = table.time_s.back() - start;
    return time_s - period * std::floor((time_s - start) / period);
}

double interpolate(const std::vector<double>& time_s, const std::vector<double>& value,
                   double t) {
    if (value.size() == 1) return value.front();
    const auto after = std::ranges::upper_bound(time_s, t) - time_s.begin();
    if (after == 0) return value.front();
    const auto i = static_cast<std::size_t>(after - 1);
    if (i + 1 == time_s.size()) return value.back();
    const double s = (t - time_s[i]) / (time_s[i + 1] - time_s[i]);
    return value[i] + s * (value[i + 1] - value[i]);
}

ConstantField polar(const ConstantField& course, double) {
    return course;
}
ConstantField polar(const RotatingField& course, double time_s) {
    return {course.magnitude_t,
            course.start_rad + 2 * std::numbers::pi * course.frequency_hz * time_s};
}
ConstantField polar(const FieldTable& course, double time_s) {
    const double t = fold_time(course, time_s);
    return {interpolate(course.time_s, course.magnitude_t, t),
            interpolate(course.time_s, course.direction_rad, t)};
}

}  // namespace

void check_field_program(const FieldProgram& program) {
    check_plane(program.plane);
    if (const auto* table = std::get_if<FieldTable>(&program.course)) check_table(*table);
}

Vec3 field_vector(const ConstantField& field, const std::array<int, 2>& plane) {
    check_plane(plane);
    Vec3 out{};
    out[plane[0]] = field.magnitude_t * std::cos(field.direction_rad);
    out[plane[1]] = field.magnitude_t * std::sin(field.direction_rad);
    return out;
}

ConstantField polar_field_at(const FieldProgram& program, double time_s) {
    return std::visit([time_s](const auto& course) { return polar(course, time_s); },
                      program.course);
}

Vec3 field_at(const FieldProgram& program, double time_s) {
    return field_vector(polar_field_at(program, time_s), program.plane);
}

namespace {

std::string words_of(const ConstantField& course) {
    return fmt::format("constant {:.17g} {:.17g}", course.magnitude_t,
                       course.direction_rad);
}
std::string words_of(const RotatingField& course) {
    return fmt::format("rotating {:.17g} {:.17g} {:.17g}", course.magnitude_t,
                       course.start_rad, course.frequency_hz);
}
std::string words_of(const FieldTable& course) {
    std::string out = course.repeat ? "repeat" : "table";
    for (std::size_t i = 0; i < course.time_s.size(); ++i) {
        const double direction = course.direction_rad.size() == 1
                                     ? course.direction_rad[0]
                                     : course.direction_rad[i];
        out += fmt::format(" {:.17g} {:.17g} {:.17g}", course.time_s[i],
                           course.magnitude_t[i], direction);
    }
    return out;
}

int axis(char letter) {
    if (letter < 'x' || letter > 'z') {
        throw std::invalid_argument(fmt::format(
            "field plane with axis {} found, two of x, y, z are allowed", letter));
    }
    return letter - 'x';
}

std::vector<double> numbers(const std::vector<std::string>& words) {
    std::vector<double> out;
    for (std::size_t i = 2; i < words.size(); ++i) {
        std::size_t read = 0;
        try {
            out.push_back(std::stod(words[i], &read));
        } catch (const std::exception&) {
            read = 0;
        }
        if (read == 0 || read != words[i].size()) {
            throw std::invalid_argument(
                fmt::format("\"{}\" found in a field, a number is needed", words[i]));
        }
    }
    return out;
}

FieldTable table_of(const std::vector<double>& values, bool repeat) {
    FieldTable table;
    table.repeat = repeat;
    for (std::size_t i = 0; i + 2 < values.size(); i += 3) {
        table.time_s.push_back(values[i]);
        table.magnitude_t.push_back(values[i + 1]);
        table.direction_rad.push_back(values[i + 2]);
    }
    return table;
}

}  // namespace

std::string field_arguments(const FieldProgram& program) {
    check_field_program(program);
    const std::string course =
        std::visit([](const auto& made) { return words_of(made); }, program.course);
    return fmt::format("{}{} {}", "xyz"[program.plane[0]], "xyz"[program.plane[1]],
                       course);
}

FieldProgram parse_field_arguments(const std::vector<std::string>& words) {
    FieldProgram program;
    if (words.size() < 3 || words[0].size() != 2) {
        throw std::invalid_argument(fmt::format(
            "field \"{}\" found; a plane such as xz, a course (constant, rotating, "
            "table, repeat) and its numbers are needed",
            fmt::join(words, " ")));
    }
    program.plane = {axis(words[0][0]), axis(words[0][1])};
    const std::vector<double> values = numbers(words);
    const std::string& course = words[1];
    if (course == "constant" && values.size() == 2) {
        program.course = ConstantField{values[0], values[1]};
    } else if (course == "rotating" && values.size() == 3) {
        program.course = RotatingField{values[0], values[1], values[2]};
    } else if ((course == "table" || course == "repeat") && values.size() % 3 == 0) {
        program.course = table_of(values, course == "repeat");
    } else {
        throw std::invalid_argument(
            fmt::format("field course {} with {} numbers found; constant has 2, rotating "
                        "3, table and "
                        "repeat 3 a row",
                        course, values.size()));
    }
    check_field_program(program);
    return program;
}

}  // namespace magfsi::structure
