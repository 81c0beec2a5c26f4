// SPDX-License-Identifier: GPL-2.0-or-later
#include "structure/lammps/field_program.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "structure/lammps/law_words.h"
#include "structure/refuse.h"
#include "structure/table_rows.h"

namespace magfsi::structure {

template <>
constexpr const char* law_name<ConstantField> = "constant";
template <>
constexpr const char* law_name<RotatingField> = "rotating";
template <>
constexpr const char* law_name<VectorField> = "vector";
template <>
constexpr const char* law_name<OscillatingField> = "oscillating";
template <>
constexpr const char* law_name<PrecessingField> = "precessing";

// Words are rows of time, magnitude and direction.
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

template <>
constexpr const char* law_name<VectorTable> = "vectors";
template <>
struct LawWords<VectorTable> : TableWords<VectorTable, &VectorTable::vector_t> {};
template <>
struct LawWords<FormulaField> : FormulaWords<FormulaField> {};

namespace {

// Laws in the plane: their field at a time, as magnitude and direction.
ConstantField polar(const ConstantField& course, double) {
    return course;
}

ConstantField polar(const RotatingField& course, double time_s) {
    return {course.magnitude_t,
            course.start_rad + 2 * std::numbers::pi * course.frequency_hz * time_s};
}

ConstantField polar(const FieldTable& course, double time_s) {
    const Between at = rows_at(course.time_s, course.repeat, time_s);
    return {at.of(course.magnitude_t), at.of(course.direction_rad)};
}

// Other laws: their field at a time, as a vector in space.
Vec3 vector_of(const VectorField& course, double) {
    return course.vector_t;
}

Vec3 vector_of(const VectorTable& course, double time_s) {
    return rows_at(course.time_s, course.repeat, time_s).of(course.vector_t);
}

Vec3 vector_of(const OscillatingField& course, double time_s) {
    const double turns = course.frequency_hz * time_s;
    const double factor = std::sin(2 * std::numbers::pi * turns + course.phase_rad);
    Vec3 out = course.amplitude_t;
    for (double& component : out) component *= factor;
    return out;
}

Vec3 vector_of(const FormulaField& course, double time_s) {
    return value_at(course.component_t, time_s);
}

// The formula stands at PrecessingField: u is made perpendicular to n by projection, and
// `across` normalises it.
Vec3 vector_of(const PrecessingField& course, double time_s) {
    const Vec3 n = 1 / norm(course.axis) * course.axis;
    std::size_t nearest = 0;
    for (std::size_t d = 1; d < 3; ++d) {
        if (std::abs(n[d]) > std::abs(n[nearest])) nearest = d;
    }
    const std::size_t next = (nearest + 1) % 3;
    Vec3 u{};
    for (std::size_t d = 0; d < 3; ++d) u[d] = (d == next ? 1 : 0) - n[next] * n[d];
    const double across = 1 / norm(u);
    const double p =
        course.start_rad + 2 * std::numbers::pi * course.frequency_hz * time_s;
    double strength = course.magnitude_t;
    if (time_s < course.ramp_s)
        strength *= 0.5 * (1 - std::cos(std::numbers::pi * time_s / course.ramp_s));
    const double along = strength * std::cos(course.cone_rad);
    const double around = strength * std::sin(course.cone_rad) * across;
    return along * n + around * (std::cos(p) * u + std::sin(p) * cross(n, u));
}

// True for laws that polar() knows.
template <class Law>
constexpr bool in_plane = requires(const Law& law) {
    polar(law, 0.0);
};

Vec3 vector_of(const FieldLaw& law, const std::array<int, 2>& plane, double time_s) {
    return std::visit(
        [&]<class Law>(const Law& one) {
            if constexpr (in_plane<Law>)
                return field_vector(polar(one, time_s), plane);
            else
                return vector_of(one, time_s);
        },
        law);
}

template <class Table>
void check_times(const Table& table) {
    const auto falls = std::ranges::is_sorted_until(table.time_s);
    if (falls != table.time_s.end()) {
        refuse("field table with the time {:g} s after {:g} s found; times must not fall",
               *falls, *std::prev(falls));
    }
    if (table.repeat && !(table.time_s.back() > table.time_s.front())) {
        refuse(
            "repeated field table from {:g} s to {:g} s found; it must end later than it "
            "begins",
            table.time_s.front(), table.time_s.back());
    }
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
    check_times(table);
}

void check(const VectorTable& table) {
    if (table.time_s.empty() || table.time_s.size() != table.vector_t.size()) {
        refuse("field table with {} times and {} vectors found; it needs one per time",
               table.time_s.size(), table.vector_t.size());
    }
    check_times(table);
}

void check(const PrecessingField& field) {
    if (!(norm(field.axis) > 0))
        refuse("an axis of length 0 found for a precessing field; any other is allowed");
}

void check_plane(const std::array<int, 2>& plane) {
    const bool axes =
        std::ranges::all_of(plane, [](int axis) { return axis >= 0 && axis <= 2; });
    if (!axes || plane[0] == plane[1]) {
        refuse(
            "field plane of the axes {} and {} found; two different ones of 0, 1, 2 (x, "
            "y, z) are needed",
            plane[0], plane[1]);
    }
}

// Throws if a law has a check and fails it.
void check_law(const FieldLaw& law) {
    std::visit(
        []<class Law>(const Law& one) {
            if constexpr (requires { check(one); }) check(one);
        },
        law);
}

void check_program(const FieldProgram& program) {
    check_plane(program.plane);
    check_law(program.course);
    for (const FieldTerm& term : program.plus) check_law(term.law);
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
    Vec3 sum = vector_of(program.course, program.plane, time_s);
    for (const FieldTerm& term : program.plus)
        sum += vector_of(term.law, program.plane, time_s);
    return sum;
}

FieldProgram held_at(const FieldProgram& program, double time_s) {
    return {program.plane, VectorField{field_at(program, time_s)}};
}

double field_magnitude_at(const FieldProgram& program, double time_s) {
    if (!program.plus.empty()) return norm(field_at(program, time_s));
    return std::visit(
        [time_s]<class Law>(const Law& one) {
            if constexpr (in_plane<Law>)
                return polar(one, time_s).magnitude_t;
            else
                return norm(vector_of(one, time_s));
        },
        program.course);
}

std::string field_arguments(const FieldProgram& program) {
    check_program(program);
    std::string out = fmt::format("{}{} {}", "xyz"[program.plane[0]],
                                  "xyz"[program.plane[1]], law_words(program.course));
    for (const FieldTerm& term : program.plus) out += " plus " + law_words(term.law);
    return out;
}

FieldProgram parse_field_arguments(const std::vector<std::string>& words) {
    if (words.size() < 2 || words[0].size() != 2) {
        refuse(
            "\"{}\" found for a field; a plane such as xz, a course and its numbers are "
            "needed",
            fmt::join(words, " "));
    }
    FieldProgram program;
    program.plane = {words[0][0] - 'x', words[0][1] - 'x'};
    std::vector<FieldTerm> terms;
    std::span<const std::string> rest(words);
    while (!rest.empty()) {
        rest = rest.subspan(1);  // after the plane, or after "plus"
        const auto end = std::ranges::find(rest, "plus") - rest.begin();
        const std::size_t count = end;
        read_law(terms.emplace_back().law, rest.first(count));
        rest = rest.subspan(count);
    }
    program.course = std::move(terms.front().law);
    terms.erase(terms.begin());
    program.plus = std::move(terms);
    check_program(program);
    return program;
}

}  // namespace magfsi::structure
