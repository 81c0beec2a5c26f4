// SPDX-License-Identifier: GPL-2.0-or-later
// Names and atom IDs in the commands of a script.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "structure/body.h"
#include "structure/lammps/script.h"

namespace magfsi::structure {

// One name per body that is fit for groups, fixes and file names: the letters, digits and
// underscores of the body's name, with underscores for other characters; a repeated or
// reserved name gets a number. Throws std::invalid_argument if there are more bodies and
// motions than LAMMPS has groups for.
std::vector<std::string> lammps_names(const std::vector<Body>& bodies,
                                      std::size_t motions = 0);

// Group of the nodes that rollers hold along an axis, 0 to 2.
std::string held_group(std::size_t axis);
// Group of the nodes of a prescribed motion, counted from 0.
std::string moved_group(std::size_t motion);
// Group of the nodes of all rigid parts in prescribed motion.
constexpr const char* moved_parts_group = "moved_parts";

// A path as one word of a script, to be read by our styles: in quotes or, if LAMMPS would
// change it, encoded by words::path_word.
std::string path_in_script(const std::string& path);
// A path as one word of a script, to be read by LAMMPS itself on the calling rank. If
// quotes are not enough, the file is opened here and named by its descriptor, which stays
// open as long as the process lives. Throws std::runtime_error if it cannot be opened.
std::string data_in_script(const std::string& path);

// Ascending IDs in LAMMPS's notation first:last:stride, such as "1:91:10 3".
std::string id_ranges(const std::vector<int>& ids);

// Atom ID of a body's node 0. Atoms are numbered from 1 on, one body after the other.
int first_id(const LammpsInput& input, std::size_t body);

// IDs of the nodes whose held axes satisfy a condition, ascending.
std::vector<int> ids_where(const LammpsInput& input,
                           const std::function<bool(const HeldAxes&)>& condition);

}  // namespace magfsi::structure
