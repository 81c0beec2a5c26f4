// From bodies and loads to a LAMMPS input: data files, lattice files and the script's lines,
// with only the commands that the scene needs.
#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "structure/body.h"

namespace magfsi::structure {

struct ConstantField {
    double magnitude_t = 0;
    double direction_rad = 0;
};
// Linear between rows; repeated with the period time.back() - time.front().
struct FieldTable {
    std::vector<double> time_s, magnitude_t, direction_rad;  // directions: one, or one a row
    bool repeat = false;
};
struct RotatingField {
    double magnitude_t = 0, start_rad = 0, frequency_hz = 0;
};
struct FieldProgram {
    std::array<int, 2> plane{0, 2};  // angles run from the first axis to the second
    std::variant<ConstantField, FieldTable, RotatingField> course;
};

struct Placement {
    std::optional<ConstantField> relaxed;       // shape at rest in this field, no other load
    std::array<int, 2> rotation_plane{0, 2};
    double rotation_rad = 0;                    // about the centre of volume
    std::optional<Vec3> position_m;             // of the centre of volume
};

struct LammpsInput {
    std::vector<Body> bodies;
    std::vector<Placement> placements;  // one a body
    std::optional<FieldProgram> field;
    std::optional<Vec3> gravity_m_s2;
    std::optional<double> drag_rate_1_s;
    double time_step_s = 0;
};

struct LammpsScript {
    std::vector<std::string> setup;  // up to, not including, the run command
    std::vector<int> first_node;     // atom id (from 1) of each body's node 0; then the end
};

// Writes NAME.data and NAME.lattice of each body into folder and returns the script.
LammpsScript write_lammps_input(const LammpsInput& input,
                                const std::filesystem::path& folder);

}  // namespace magfsi::structure
