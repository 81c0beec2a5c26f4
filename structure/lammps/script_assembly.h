// The bodies of a script put together: nodes numbered one body after the other.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "structure/lammps/data_file.h"
#include "structure/lammps/script.h"

namespace magfsi::structure {

struct Assembly {
    std::vector<DataAtom> atoms;
    Vec3 low{}, high{};  // bounds of the bodies before relaxing
    std::vector<int> first_node;
    std::vector<std::string> name;  // fit for LAMMPS IDs and file names
    double longest_diagonal_m = 0;  // of an element, where it starts
};

// Throws std::invalid_argument on input that write_lammps_input does not take.
void check_input(const LammpsInput& input);

Assembly assemble(const LammpsInput& input);

}  // namespace magfsi::structure
