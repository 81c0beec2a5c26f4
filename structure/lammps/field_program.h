// The uniform magnetic field over time (eqs. 7 to 9), as a value and as LAMMPS variables.
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
    std::vector<double> time_s, magnitude_t,
        direction_rad;  // directions: one, or one a row
    bool repeat = false;
};
struct RotatingField {
    double magnitude_t = 0, start_rad = 0, frequency_hz = 0;
};
struct FieldProgram {
    std::array<int, 2> plane{0, 2};  // angles run from the first axis to the second
    std::variant<ConstantField, FieldTable, RotatingField> course;
};

// Field vector [T]. Throws std::invalid_argument on a table that is empty, whose times
// fall, or whose columns differ in length, and on a plane that is not two different axes.
Vec3 field_at(const FieldProgram& program, double time_s);

Vec3 field_vector(const ConstantField& field, const std::array<int, 2>& plane);

// LAMMPS commands that define the equal-style variables Bx, By and Bz [T] of step * dt,
// and those that they need: t [s], B [T], theta [rad]. Throws as field_at does.
std::vector<std::string> field_commands(const FieldProgram& program);

}  // namespace magfsi::structure
