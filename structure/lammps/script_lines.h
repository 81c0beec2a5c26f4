// The commands of a script, one function for each concern, in the order in which
// LAMMPS needs them.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "structure/lammps/effect.h"
#include "structure/lammps/script_assembly.h"

namespace magfsi::structure {

using Lines = std::vector<std::string>;

void add_system(Lines& lines, const LammpsInput& input, const Assembly& all,
                const std::string& data_file);
// Writes the lattice files and fills fix_id.
void add_lattices(Lines& lines, LammpsScript& script, const LammpsInput& input,
                  const Assembly& all, const std::filesystem::path& folder);
// Of the effects that are asked for, those of one place in the script.
void add_effects(Lines& lines, const LammpsInput& input,
                 ScriptEffect::Commands ScriptEffect::*place);
void add_integration(Lines& lines, const LammpsInput& input);
void add_settings(Lines& lines, const LammpsInput& input);

}  // namespace magfsi::structure
