// SPDX-License-Identifier: GPL-2.0-or-later
// Largest stable step of the velocity-Verlet scheme, at rest and in a deformed state.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "structure/body.h"
#include "structure/lattice/hexahedron.h"

namespace magfsi::structure {

// A stable time step [s] of the undeformed body: 2 / omega, omega an upper bound of the
// highest natural frequency of the mesh, which is the highest of any one element with its
// own lumped mass, K_e p = omega^2 M_e p (K_e the stiffness at rest). Where materials
// meet, each element keeps the mass of its own. A body under large compression is stiffer
// than at rest: run at 0.9 of this step. An element whose nodes are all held along every
// axis does not count; the step of a body of such elements alone is infinite. Throws
// std::invalid_argument on a density that is not positive.
//
// A viscous material (Kelvin-Voigt) needs a shorter step, since the velocity-Verlet
// scheme takes the damping force at the velocity of half a step before: with c the
// largest eigenvalue of the element's damping matrix over its mass, the step h must
// satisfy h^2 omega^2 + 2 h c <= 4, that is h = 2 / omega (sqrt(1 + z^2) - z), z = c / (2
// omega).
double stable_step_s(const Body& body);

// The same with all viscosities set to zero.
double stable_elastic_step_s(Body body);

// The stable step of a body with springs on its surface: the largest [s] with step^2
// (omega^2 + w) + 2 step c <= 4, omega and c the body's own largest frequency and damping
// (stable_step_s), w the largest stiffness * area / mass of a surface node: a bound,
// since the largest eigenvalue of a sum is at most the sum of the largest. Run at 0.9 of
// it. Throws as stable_step_s.
double step_limit_s(const Body& body, double stiffness_pa_m);

// The stable step of a body while it deforms. The springs of an element are linear, and
// so their stiffness is that at rest; what changes is the stiffness of its volume term,
//   d2U/dJ2 / V0 dV dV^T,   d2U/dJ2 = (K (1 - ln J) + G) / J^2.
// This matrix has rank one; over the masses m_a its one eigenvalue is
//   r = d2U/dJ2 / V0 sum_a |dV/dx_a|^2 / m_a.
// r rises where an element is compressed, and where it is flattened at constant volume,
// for then its faces grow. The square of the body's highest frequency rises by no more
// than the largest rise of r in an element. The pressure's own contribution, p d2V, is
// left out; the margin of the step covers it. Elements that are held do not count.
class CurrentStep {
  public:
    // Throws as stable_step_s does. Takes about 300 bytes an element.
    explicit CurrentStep(const Body& body);

    // The largest rise of r over its value at rest in any element [1/s2]; 0 where none
    // has risen, infinite where an element is inverted. nodes_m: the present positions.
    double rise_1_s2(std::span<const Vec3> nodes_m) const;

    // The largest stable step [s] after such a rise, from the one at rest.
    static double step_s(double step_at_rest_s, double rise_1_s2);

  private:
    struct Element {
        Hexahedron nodes{};
        bool exact = false;  // volume of the trilinear hexahedron, else of the mean F
        Positions8 gradient_m2;
        double volume_m3 = 0;
        std::array<double, 8> inverse_mass{};
        double lame_pa = 0, shear_pa = 0;
        double at_rest_1_s2 = 0;
    };
    static double volume_term_1_s2(const Element& element, const Positions8& x_m);

    std::vector<Element> elements_;
};

}  // namespace magfsi::structure
