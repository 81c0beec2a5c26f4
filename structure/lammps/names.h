// Words of a LAMMPS command line.
#pragma once

#include <string>
#include <vector>

#include "structure/body.h"

namespace magfsi::structure {

// One ID a body, fit for groups, fixes and file names: letters, digits and underscores of
// its name, other characters as underscores; a repeated or reserved one gets a number.
// Throws std::invalid_argument on more bodies and motions than LAMMPS has groups for.
std::vector<std::string> lammps_names(const std::vector<Body>& bodies,
                                      std::size_t motions = 0);

// Of the nodes that slide on rollers: held along this axis, 0 to 2.
std::string held_group(std::size_t axis);
// Of the nodes of a prescribed motion.
std::string moved_group(std::size_t motion);

// In double quotes. Throws std::invalid_argument on a quote or a dollar sign, which
// LAMMPS would read as its own.
std::string quoted(const std::string& path);

// Rising IDs as LAMMPS ranges first:last:stride, "1:91:10 3".
std::string id_ranges(const std::vector<int>& ids);

}  // namespace magfsi::structure
