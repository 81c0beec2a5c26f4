// SPDX-License-Identifier: GPL-2.0-or-later
// Largest stable step of velocity Verlet, in the undeformed and in a deformed state.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "structure/body.h"
#include "structure/lattice/hexahedron.h"

namespace magfsi::structure {

// Stable time step [s] of the undeformed body: 2 / omega, with omega an upper bound of
// the highest natural frequency of the mesh: the highest one of any single element with
// its own lumped mass, K_e p = omega^2 M_e p (K_e the stiffness at rest). Where materials
// meet, each element has the mass of its own. A body under large compression is stiffer
// than at rest: run at 0.9 of this step. An element whose nodes are all held along every
// axis or all belong to one rigid part does not count; the step of a body of such
// elements alone is infinite. Soft elements at a rigid part keep the bound: their nodes
// there only carry more mass and move in fewer ways. Throws
// std::invalid_argument on a density that is not positive or a negative viscosity.
//
// A viscous material (Kelvin-Voigt) needs a shorter step, since velocity Verlet takes the
// damping force at the velocity of half a step before. With c the largest eigenvalue of
// the element's damping matrix over its mass, the step h must satisfy h^2 omega^2 + 2 h c
// <= 4, that is h = 2 / omega (sqrt(1 + z^2) - z) with z = c / (2 omega).
double stable_step_s(const Body& body);

// The stable step with all viscosities set to zero [s].
double stable_elastic_step_s(Body body);

// Stable step [s] of a body with springs on its surface, of a stiffness in pressure over
// displacement: the largest step with step^2 (omega^2 + w) + 2 step c <= 4, where omega
// and c are the body's own largest frequency and damping (stable_step_s) and w is the
// largest stiffness * area / mass of a surface node, or of all springs on a rigid part
// over its mass and inertia. It is a bound, since the largest eigenvalue of a sum is at
// most the sum of the largest. Run at 0.9 of it. Throws as stable_step_s does.
double step_limit_s(const Body& body, double stiffness_pa_m);

// Stable step of a body while it deforms. The springs of an element are linear, so their
// stiffness stays that at rest; the stiffness of the volume term changes:
//   d2U/dJ2 / V0 dV dV^T,   d2U/dJ2 = (K (1 - ln J) + G) / J^2.
// This matrix has rank one; over the masses m_a its one eigenvalue is
//   r = d2U/dJ2 / V0 sum_a |dV/dx_a|^2 / m_a.
// r rises in an element that is compressed, and in one that is flattened at constant
// volume, since its faces grow. The square of the body's highest frequency rises by no
// more than the largest rise of r in an element. The contribution of the pressure, p d2V,
// is left out and is covered by the margin of the step. Held elements do not count.
class CurrentStep {
  public:
    // Computes r at rest. Throws as stable_step_s does. Takes about 300 bytes per
    // element.
    explicit CurrentStep(const Body& body);

    // Largest rise of r over its value at rest in any element [1/s2]; 0 if none has
    // risen, infinite if an element is inverted. nodes_m: present positions.
    double rise_1_s2(std::span<const Vec3> nodes_m) const;

    // Largest stable step [s] after such a rise, from the step at rest.
    static double step_s(double step_at_rest_s, double rise_1_s2);

  private:
    // Constants of an element's volume term.
    struct Element {
        Hexahedron nodes{};
        bool exact = false;  // exact volume (full), else that of the mean F
        Positions8 gradient_m2;
        double volume_m3 = 0;
        std::array<double, 8> inverse_mass{};
        double lame_pa = 0, shear_pa = 0;
        double at_rest_1_s2 = 0;
    };
    // The present r of an element [1/s2]; infinite if J is not positive.
    static double volume_term_1_s2(const Element& element, const Positions8& x_m);

    std::vector<Element> elements_;
};

}  // namespace magfsi::structure
