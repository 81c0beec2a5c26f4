#include "modify.h"

#include "structure/lammps/effects/magnetic_field/fix_magttice_field_source.h"
#include "structure/lammps/effects/magnetic_field/uniform_field.h"
#include "structure/lammps/register_styles.h"
#include "structure/lammps/style_creator.h"

namespace magfsi::structure {

void register_magnetic_field(LAMMPS_NS::LAMMPS& lammps) {
    (*lammps.modify->fix_map)["magttice/field"] =
        &create<FixMagtticeFieldSource, LAMMPS_NS::Fix>;
    register_body_force(
        "field", {3,
                  [](LAMMPS_NS::LAMMPS* made_for, const MagtticeBody& body,
                     char** values) -> std::unique_ptr<BodyForce> {
                      return std::make_unique<UniformField>(made_for, body, values);
                  }});
}

}  // namespace magfsi::structure
