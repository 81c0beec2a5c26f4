// One element in its plainest form: the readable reference that the fast kernel is held
// to.
#pragma once

#include "structure/body.h"
#include "structure/lattice/hexahedron.h"
#include "structure/lattice/hourglass.h"
#include "structure/lattice/volume.h"

namespace magfsi::structure {

// What eqs. (2) to (6) need of an element's reference state.
struct ElementReference {
    ElementVariant variant = ElementVariant::full;
    Matrix8 spring_matrix;  // [m]
    Positions8 gradient;    // b_a [m2]
    double volume = 0;      // V0 [m3]
    std::array<double, 8> node_volume{};
    HourglassReference hourglass;  // energy of assumed_strain, viscosity of all
};

// Throws std::invalid_argument on an inverted element.
ElementReference element_reference(const Positions8& nodes_m, ElementVariant variant,
                                   int element_number);

// The J V0 of the variant: exact volume for full, that of the mean F for the others.
VolumeAndGradient element_volume(const ElementReference& reference,
                                 const Positions8& x_m);

struct ElementState {
    double energy_j = 0;      // zero at rest
    double volume_ratio = 0;  // J
    Positions8 force_n;       // -dE/dx_a
};

// W = G/2 (sum_ab L_ab x_a . x_b - 3 V0) + V0 (K/2 ln^2 J - G ln J), eq. (1) summed over
// the element: for a homogeneous state the first term is G/2 V0 (I1 - 3).
// assumed_strain adds hourglass_energy.
ElementState element_energy(const ElementReference& reference, const Material& material,
                            const Positions8& x_m);

}  // namespace magfsi::structure
