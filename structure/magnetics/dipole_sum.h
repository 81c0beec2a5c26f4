// SPDX-License-Identifier: GPL-2.0-or-later
// Field of many dipoles at one of them, in the instruction set of the machine.
#pragma once

namespace magfsi::structure {

// Dipoles in separate arrays by number: centres [m], moments [A m2], radii [m].
struct DipoleArrays {
    const double* x[3] = {};
    const double* m[3] = {};
    const double* radius = nullptr;
};

// Flux density [T] and its symmetric gradient [T/m] in the order xx, yy, zz, xy, xz, yz.
struct DipoleSum {
    double field_t[3] = {};
    double gradient_t_m[6] = {};
};

// Adds the field of the dipoles from, ..., to - 1 at the centre of dipole `at`; itself
// and others at exactly its place are left out. The law is that of two uniformly
// magnetised spheres (dipoles.h).
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
