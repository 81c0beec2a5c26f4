// magfsi-lammps lattice NAME ...: the files of a block for a plain input script.
#pragma once

namespace magfsi::structure {

// Writes NAME.lattice (for fix magttice) and NAME.data (for read_data) and prints the
// stable step; argv[0] is the word "lattice". Returns the exit code: 0, or 2 on wrong
// arguments, which are named on stderr.
int lattice_command(int argc, char** argv);

}  // namespace magfsi::structure
