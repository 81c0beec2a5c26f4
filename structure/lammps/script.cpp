#include "structure/lammps/script.h"

#include "structure/lammps/data_file.h"
#include "structure/lammps/script_assembly.h"
#include "structure/lammps/script_lines.h"

namespace magfsi::structure {

LammpsScript write_lammps_input(const LammpsInput& input,
                                const std::filesystem::path& folder) {
    check_input(input);
    check_effects(input);
    const Assembly all = assemble(input);
    const std::string data_file = (folder / "bodies.data").string();
    write_data_file(all.atoms, data_file);
    LammpsScript script;
    script.first_node = all.first_node;
    add_system(script.setup, input, all, data_file);
    add_effects(script.setup, input, &ScriptEffect::before_bodies);
    add_lattices(script.setup, script, input, all, folder);
    add_effects(script.setup, input, &ScriptEffect::commands);
    add_integration(script.setup, input);
    add_effects(script.setup, input, &ScriptEffect::after_integration);
    add_settings(script.setup, input);
    return script;
}

}  // namespace magfsi::structure
