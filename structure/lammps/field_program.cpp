#include "structure/lammps/field_program.h"

#include <fmt/format.h>

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

}  // namespace magfsi::structure
