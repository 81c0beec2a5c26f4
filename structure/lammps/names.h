// SPDX-License-Identifier: GPL-2.0-or-later
// Names and atom IDs in the commands of a script.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "structure/body.h"
#include "structure/lammps/script.h"

namespace magfsi::structure {

// One ID per body, fit for groups, fixes and file names: letters, digits and underscores
// of its name, other characters as underscores; a repeated or reserved one gets a number.
// Throws std::invalid_argument on more bodies and motions than LAMMPS has groups for.
std::vector<std::string> lammps_names(const std::vector<Body>& bodies,
                                      std::size_t motions = 0);

// Of the nodes that slide on rollers: held along this axis, 0 to 2.
std::string held_group(std::size_t axis);
// Of the nodes of a prescribed motion.
std::string moved_group(std::size_t motion);

// A path as a word of a script, for our styles: in quotes, or where LAMMPS would change
// it, as words::path_word.
std::string path_in_script(const std::string& path);
// For LAMMPS itself, on the rank that reads it: such a file is opened here, and named by
// its descriptor as long as the process lives.
std::string data_in_script(const std::string& path);

// Rising IDs as LAMMPS ranges first:last:stride, "1:91:10 3".
std::string id_ranges(const std::vector<int>& ids);

// Atom ID of a body's node 0. Atoms are numbered from 1, one body after the other.
int first_id(const LammpsInput& input, std::size_t body);

// IDs of the nodes whose held axes satisfy the condition, ascending.
std::vector<int> ids_where(const LammpsInput& input,
                           const std::function<bool(const HeldAxes&)>& condition);

}  // namespace magfsi::structure
