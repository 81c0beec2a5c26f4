// Largest stable step of the velocity-Verlet scheme, at rest and in a deformed state.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "structure/body.h"
#include "structure/lattice/hexahedron.h"

namespace magfsi::structure {

// Bound [s] from the elements: omega_max^2 <= max over elements of the largest eigenvalue
// of K_e p = omega^2 M_e p, with K_e the tangent stiffness at rest and M_e the element's
// own lumped masses, each of its own material (the body's masses are their sum, also
// where materials meet); step = 2 / omega_max. Large compression stiffens the material:
// run at 0.9 of it. Throws std::invalid_argument on a density that is not positive.
//
// With Kelvin-Voigt damping, whose forces a velocity-Verlet step takes at
// the velocity of the half step before, the bound is the largest step with step^2 omega^2
// + 2 step c <= 4: step = 2 / omega (sqrt(1 + z^2) - z), z = c / (2 omega), with omega^2
// and c the largest eigenvalues of stiffness and damping over mass.
double stable_step_s(const Body& body);

// As if no material were viscous.
double stable_elastic_step_s(Body body);

// The springs of an element are linear; what changes is its volume term, of rank one,
//   d2U/dJ2 / V0 dV dV^T,   d2U/dJ2 = (K (1 - ln J) + G) / J^2,
// whose eigenvalue over the masses is r = d2U/dJ2 / V0 sum_a |dV/dx_a|^2 / m_a. It rises
// where an element is compressed, and where it is squeezed flat at its volume: its faces
// grow. The frequencies of the body rise by no more than the largest rise of r beside
// what the pressure adds, p d2V, which is left to the margin of the step.
class CurrentStep {
  public:
    // As stable_step_s; about 300 bytes an element.
    explicit CurrentStep(const Body& body);

    // Largest r - r(rest) over the elements [1/s2], not below 0. nodes_m: where the
    // body's nodes are. Infinite where an element is inverted.
    double rise_1_s2(std::span<const Vec3> nodes_m) const;

    // The largest stable step [s] then, from that at rest.
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
