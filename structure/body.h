// One magttice body before it goes to LAMMPS. SI throughout.
#pragma once

#include <string>
#include <vector>

#include "structure/mesh/mesh.h"

namespace magfsi::structure {

struct Material {
    double shear_modulus_pa = 0;
    double lame_lambda_pa = 0;  // K of eq. (1)
    // Inertia; in a fluid this is rho_solid - rho_fluid (enclosed fluid counted once).
    double density_kg_m3 = 0;
    double viscosity_pa_s = 0;  // Kelvin-Voigt (lattice/viscous_element.h)
};

// full: the paper's element (exact volume, full spring matrix).
// mean_f: J from the mean deformation gradient and hourglass coefficients 3
// min(l_i,l_j)^2: accurate in bending with few layers.
// assumed_strain: all of the energy from the mean deformation gradient, and a hourglass
// energy that is exact for linear bending and twist (lattice/hourglass.h): accurate in
// every mode with one layer, for edges of any ratio.
enum class ElementVariant { full, mean_f, assumed_strain };

// A face whose nodes keep their coordinate along one axis of space (0 x, 1 y, 2 z) and
// are free along the others: a plane of symmetry, or plane strain with both faces held.
struct Roller {
    std::string face;
    int axis = 2;
};

struct Body {
    std::string name;
    Mesh mesh;
    Material material;
    // Of a body of several materials: element e is of `material` where
    // element_material[e] is 0, else of other_materials[element_material[e] - 1]. Both
    // empty: all is `material`.
    std::vector<Material> other_materials;
    std::vector<int> element_material;
    ElementVariant element = ElementVariant::full;
    std::vector<Vec3> magnetization_a_m;  // one an element; empty: not magnetic
    std::vector<std::string> clamps;      // faces held still
    std::vector<Roller> rollers;
};

}  // namespace magfsi::structure
