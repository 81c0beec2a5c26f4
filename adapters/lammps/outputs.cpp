#include "adapters/lammps/structure_run.h"

namespace magfsi::lammps {

#define MAGFSI_EFFECT(name) extern const StructureOutput name##_output;
#include "adapters/lammps/effects.inc"
#undef MAGFSI_EFFECT

const StructureOutput* structure_outputs() {
#define MAGFSI_EFFECT(name) name##_output,
    static const StructureOutput registered[] = {
#include "adapters/lammps/effects.inc"
        {}};
#undef MAGFSI_EFFECT
    return registered;
}

NodalState StructureRun::gather() const {
    NodalState nodes = engine.gather(atoms);
    if (!whole_mass_kg.empty()) nodes.mass_kg = whole_mass_kg;
    return nodes;
}

}  // namespace magfsi::lammps
