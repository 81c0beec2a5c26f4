// SPDX-License-Identifier: GPL-2.0-or-later
// What a wall at rest returns along a lattice link that it cuts. Populations as
// deviations from rest. With F what a cell has sent, i towards the wall and o away from
// it, A the fluid cell at the wall and B the one behind it, d the wall's distance from A
// over the link:
//
// straight (Bouzidi et al. 2001)
//     2 d F_i(A) + (1 - 2 d) F_i(B)               for d < 1/2,
//     F_i(A) / (2 d) + (1 - 1 / (2 d)) F_o(A)     else.
//
// curved, the same for d <= 1/2, else
//     F_i(A) - J(1/2).
//   What crosses a link both ways in one step differs by
//     J(x) = 6 w (e(x) + (2/3 Lambda - 1/8) e''),   e = c_i . j,
//   x being its middle (half-way walls: J = 0); with a magic number of 3/16 it is e
//   itself. J(-1/2) = F_i(B) - F_o(A) behind, e(0) of all populations of A and the wall,
//   e(d) = 0, make a parabola. The slope e'(0) of A's viscous stress, too, makes a cubic:
//   it adds (1 - 1 / (2 d)) (J(-1/2) + 6 w e'(0) - J(1/2) of the parabola), what is in
//   brackets being 0 on parabolas. No population is read that the straight one, or the
//   collision of A, does not read.
#pragma once

#include "fluid_lbm/lattice/d3q19.h"

namespace magfsi::fluid {

// Of the populations that a cell has sent: the excess of density and the momentum.
struct SentMoments {
    double excess = 0, j[3] = {};
};

// d, F_i(A), and what is read besides: F_i(B) for d < 1/2, else F_o(A).
inline double straight_return(double distance, double sent, double other) {
    if (distance < 0.5) return 2 * distance * sent + (1 - 2 * distance) * other;
    return sent / (2 * distance) + (1 - 1 / (2 * distance)) * other;
}

struct WallLink {
    double distance;   // d
    double sent;       // F_i(A)
    double sent_back;  // F_o(A)
    double arrived;    // F_i(B)
};

// For d > 1/2; q: the direction towards the wall. What is left of the stress after the
// collision is 1 - tau of 6 w e', which tau = 1 hides.
inline double curved_return(const WallLink& link, int q, const SentMoments& cell,
                            double relaxation_time) {
    const double d = link.distance, w = d3q19::weight(q);
    double along = 0, square = 0;
    for (int a = 0; a < 3; ++a) {
        along += d3q19::c[q][a] * cell.j[a];
        square += cell.j[a] * cell.j[a];
    }
    const double equilibrium =
        cell.excess + 4.5 / (1 + cell.excess) * (along * along - square * d3q19::cs2);
    const double slope =
        (link.sent + link.sent_back - 2 * w * equilibrium) / (1 - relaxation_time);
    const double behind = link.arrived - link.sent_back;
    const double parabola = (2 * d - 1) * (6 * w * along / d - behind / (2 * d + 1));
    const double bracket = behind + slope - parabola;
    return link.sent - parabola - (1 - 1 / (2 * d)) * bracket;
}

}  // namespace magfsi::fluid
