#include <fmt/format.h>
#include <fmt/ranges.h>

#include <stdexcept>

#include "structure/lammps/field_program.h"

namespace magfsi::structure {
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
