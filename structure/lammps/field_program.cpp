#include "structure/lammps/field_program.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "structure/lammps/law_words.h"
#include "structure/refuse.h"

namespace magfsi::structure {

template <>
constexpr const char* law_name<ConstantField> = "constant";
template <>
constexpr const char* law_name<RotatingField> = "rotating";

// Rows of time, magnitude and direction.
template <>
struct LawWords<FieldTable> {
    static std::string words(const FieldTable& table) {
        std::string out = table.repeat ? "repeat" : "table";
        for (std::size_t i = 0; i < table.time_s.size(); ++i) {
            const auto& directions = table.direction_rad;
            out += fmt::format(" {:.17g} {:.17g} {:.17g}", table.time_s[i],
                               table.magnitude_t[i],
                               directions[directions.size() == 1 ? 0 : i]);
        }
        return out;
    }
    static std::string usage() { return "table and repeat have 3 per row"; }
    static std::optional<FieldTable> read(const std::string& name,
                                          std::span<const double> values) {
        if ((name != "table" && name != "repeat") || values.size() % 3 != 0) return {};
        FieldTable table;
        table.repeat = name == "repeat";
        for (std::size_t i = 0; i < values.size(); i += 3) {
            table.time_s.push_back(values[i]);
            table.magnitude_t.push_back(values[i + 1]);
            table.direction_rad.push_back(values[i + 2]);
        }
        return table;
    }
};

namespace {

// The field of each course at a time, as magnitude and direction.
ConstantField polar(const ConstantField& course, double) {
    return course;
}

ConstantField polar(const RotatingField& course, double time_s) {
    return {course.magnitude_t,
            course.start_rad + 2 * std::numbers::pi * course.frequency_hz * time_s};
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

ConstantField polar(const FieldTable& course, double time_s) {
    const double t = fold_time(course, time_s);
    return {interpolate(course.time_s, course.magnitude_t, t),
            interpolate(course.time_s, course.direction_rad, t)};
}

void check(const FieldTable& table) {
    const std::size_t rows = table.time_s.size();
    const std::size_t directions = table.direction_rad.size();
    if (rows == 0 || table.magnitude_t.size() != rows ||
        (directions != 1 && directions != rows)) {
        refuse(
            "field table with {} times, {} magnitudes and {} directions found; it needs "
            "one magnitude per time and one direction, or one per time",
            rows, table.magnitude_t.size(), directions);
    }
    if (!std::ranges::is_sorted(table.time_s)) {
        refuse("the times of a field table must not fall");
    }
    if (table.repeat && !(table.time_s.back() > table.time_s.front())) {
        refuse("a repeated field table needs a period above zero");
    }
}

void check_plane(const std::array<int, 2>& plane) {
    const bool axes =
        std::ranges::all_of(plane, [](int axis) { return axis >= 0 && axis <= 2; });
    if (!axes || plane[0] == plane[1]) {
        refuse("a field plane is two different ones of x, y, z");
    }
}

void check_program(const FieldProgram& program) {
    check_plane(program.plane);
    if (const auto* table = std::get_if<FieldTable>(&program.course)) check(*table);
}

}  // namespace

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

std::string field_arguments(const FieldProgram& program) {
    check_program(program);
    return fmt::format("{}{} {}", "xyz"[program.plane[0]], "xyz"[program.plane[1]],
                       law_words(program.course));
}

FieldProgram parse_field_arguments(const std::vector<std::string>& words) {
    if (words.size() < 2 || words[0].size() != 2) {
        refuse("a plane such as xz, a course and its numbers are needed");
    }
    FieldProgram program;
    program.plane = {words[0][0] - 'x', words[0][1] - 'x'};
    read_law(program.course, std::span(words).subspan(1));
    check_program(program);
    return program;
}

}  // namespace magfsi::structure
