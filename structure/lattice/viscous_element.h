// Kelvin-Voigt damping of one element in its plainest form: what the fast kernel is held
// to.
#pragma once

#include "structure/lattice/element_energy.h"

namespace magfsi::structure {

// Second Piola-Kirchhoff stress 2 eta Edot of the mean deformation gradient F, with
// Green's rate Edot = sym(F^T Fdot), and the like for the strains that the hourglass
// vectors make (hourglass.h): G replaced by eta and lambda' by 2 eta (K / (K + 2 G))^2,
// the rate at which a plate of this material gets thinner. The mode xyz damps with V0 / 3
// eta min_k(p_k) sum_i p_i d(u_i . v_xyz)/dt^2, p the inverse squares of the half edges.
// All rates are of scalar products, so that rigid motions have none; forces are the
// adjoint, so that their power is minus the dissipation. eta is the material's viscosity.
struct ViscousState {
    double dissipation_w = 0;  // minus the power of the forces; never negative
    Positions8 force_n;
};

ViscousState viscous_element(const ElementReference& reference, const Material& material,
                             const Positions8& x_m, const Positions8& v_m_s);

// lambda' of the viscous plate [Pa s].
double viscous_plate_lambda_pa_s(const Material& material);

// C of the forces -C v at rest [N s/m].
Matrix24 viscous_damping_at_rest(const ElementReference& reference,
                                 const Material& material, const Positions8& nodes_m);

}  // namespace magfsi::structure
