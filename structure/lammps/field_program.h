// The uniform magnetic field over time (eqs. 7 to 9).
#pragma once

#include <array>
#include <string>
#include <variant>
#include <vector>

#include "structure/mesh/mesh.h"

namespace magfsi::structure {

struct ConstantField {
    double magnitude_t = 0;
    double direction_rad = 0;
};
// Linear between rows; repeated with the period time.back() - time.front(). Outside the
// rows the end values hold. Two rows of one time are a jump: from that time on the later
// one.
struct FieldTable {
    std::vector<double> time_s, magnitude_t;
    std::vector<double> direction_rad;  // one, or one a row
    bool repeat = false;
};
struct RotatingField {
    double magnitude_t = 0, start_rad = 0, frequency_hz = 0;
};
struct FieldProgram {
    std::array<int, 2> plane{0, 2};  // angles run from the first axis to the second
    std::variant<ConstantField, FieldTable, RotatingField> course;
};

// Throws std::invalid_argument on a table that is empty, whose times fall, or whose
// columns differ in length, and on a plane that is not two different axes.
void check_field_program(const FieldProgram& program);

// Field vector [T] of a checked program.
Vec3 field_at(const FieldProgram& program, double time_s);

// The same as signed magnitude and direction in the program's plane.
ConstantField polar_field_at(const FieldProgram& program, double time_s);

Vec3 field_vector(const ConstantField& field, const std::array<int, 2>& plane);

// The arguments of fix magttice/field, and back:
//   xz constant MAGNITUDE DIRECTION
//   xz rotating MAGNITUDE START FREQUENCY
//   xz table|repeat  TIME MAGNITUDE DIRECTION  TIME MAGNITUDE DIRECTION ...
// The words are the two axes of the plane and the course. Numbers read back exactly. Both
// throw std::invalid_argument on what is not such a program.
std::string field_arguments(const FieldProgram& program);
FieldProgram parse_field_arguments(const std::vector<std::string>& words);

}  // namespace magfsi::structure
