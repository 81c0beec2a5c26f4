// SPDX-License-Identifier: GPL-2.0-or-later
// The field of many dipoles at one of them, in the instruction set of the machine.
#pragma once

namespace magfsi::structure {

// By number, in separate arrays: centres [m], moments [A m2], radii [m].
struct DipoleArrays {
    const double* x[3] = {};
    const double* m[3] = {};
    const double* radius = nullptr;
};

// Flux density [T] and its gradient [T/m], which is symmetric: xx, yy, zz, xy, xz, yz.
struct DipoleSum {
    double field_t[3] = {};
    double gradient_t_m[6] = {};
};

// Adds the field at the centre of dipole `at` of those from `from` to before `to`, itself
// and others at its very place left out. As two spheres that are evenly magnetised act on
// each other (dipoles.h).
using DipoleSumFunction = void (*)(const DipoleArrays& dipoles, int at, int from, int to,
                                   DipoleSum& sum);

#define MAGFSI_DIPOLES_OF(isa)                                        \
    namespace isa {                                                   \
    void add_dipoles(const DipoleArrays&, int, int, int, DipoleSum&); \
    }
MAGFSI_DIPOLES_OF(sse2)
MAGFSI_DIPOLES_OF(avx2)
MAGFSI_DIPOLES_OF(avx512)
#undef MAGFSI_DIPOLES_OF

}  // namespace magfsi::structure
