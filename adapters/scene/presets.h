// SPDX-License-Identifier: GPL-2.0-or-later
// Materials that were measured, by name, each with its source.
#pragma once

#include <array>
#include <string_view>

#include "structure/options.h"

namespace magfsi::scene {

// zhao_2019: printed silicone with NdFeB powder of the beams of Zhao, Kim, Cai, Wang, J.
//   Mech. Phys. Solids 124 (2019) 244.
// tan_2022: elastomer of the bistable arch of Tan, Chen, Yang, Deng, Int. J. Mech. Sci.
//   (2022) 107523.
// Both with the constants that Stewart and Anand took for them in their finite elements
//   (J. Mech. Phys. Solids 179 (2023)): github.com/ericstewart36/hardmagnetics_fenicsx at
//   5751849, HM01_beam_bending and HM06_bfield_constant. The density of zhao_2019 is the
//   one set there; the beams are computed without inertia.
// vhb_4910: acrylic elastomer (3M); constants of Wang et al., J. Mech. Phys. Solids
//   (2016), as Stewart and Anand give them (Int. J. Solids Struct. 303 (2024) 113023):
//   github.com/ericstewart36/finite_viscoelasticity at be678d6, FV02. Arruda and Boyce's
//   15.36 kPa and locking stretch of 5.85 are 15.63 kPa at rest; three branches.
// No source has the bulk modulus (the finite elements are nearly incompressible):
// lame_lambda is 20 G, the value of the model's paper.
enum class MaterialPreset { zhao_2019, tan_2022, vhb_4910 };
constexpr auto words_of(MaterialPreset) {
    return std::to_array<std::string_view>({"zhao_2019", "tan_2022", "vhb_4910"});
}

inline structure::Material material_of(MaterialPreset preset) {
    structure::Material out;
    switch (preset) {
        case MaterialPreset::zhao_2019:
            out = {.shear_modulus_pa = 303e3, .density_kg_m3 = 2000};
            break;
        case MaterialPreset::tan_2022:
            out = {.shear_modulus_pa = 1400e3,
                   .density_kg_m3 = 2000,
                   .branches = {{500e3, 10e-3}}};
            break;
        case MaterialPreset::vhb_4910:
            out = {.shear_modulus_pa = 15.63e3,
                   .density_kg_m3 = 1000,
                   .stiffening = structure::ArrudaBoyce{5.85},
                   .branches = {{26.06e3, 0.6074}, {26.53e3, 6.56}, {10.83e3, 61.25}}};
            break;
    }
    out.lame_lambda_pa = 20 * out.shear_modulus_pa;
    return out;
}

}  // namespace magfsi::scene
