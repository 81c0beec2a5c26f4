// SPDX-License-Identifier: GPL-2.0-or-later
// Kernel for the elements of eqs. (1) to (4) in Hadamard mode space, `width` elements at
// a time. See ElementModes for the coefficients and element.h for the energy. u are the
// modes of the positions, g is minus the force on them.
#include "structure/lattice/element_lanes.h"
#include "structure/lattice/hourglass_lanes.h"

namespace magfsi::structure::MAGFSI_ISA {
namespace {

// Spring forces g[m] = sum_n spring[mn] u[n]. spring: the diagonal for bricks, else the
// upper triangle row by row.
template <bool brick>
MAGFSI_INLINE void spring_modes(const double* spring, const Vec (&u)[8], Vec (&g)[8]) {
    if constexpr (brick) {
        for (int m = 1; m < 8; ++m) g[m] = load(spring + (m - 1) * batch_lanes) * u[m];
    } else {
        for (int m = 1; m < 8; ++m) g[m] = {Real{}, Real{}, Real{}};
        for (int m = 1; m < 8; ++m) {
            const Real diagonal = load(spring);
            spring += batch_lanes;
            g[m] = g[m] + diagonal * u[m];
            for (int n = m + 1; n < 8; ++n) {
                const Real c = load(spring);
                spring += batch_lanes;
                g[m] = g[m] + c * u[n];
                g[n] = g[n] + c * u[m];
            }
        }
    }
}

// Strain stiffening of an element: its energy over G V0 / 2, and (I1 - 3) over its limit.
struct Stiffened {
    Real integral, share;
};

// Factor of springs and hourglass energy by the law, and the terms of Stiffened.
// quarter_j: a quarter of their neo-Hookean energy.
MAGFSI_INLINE Real stiffening_factor(const ElementBatches& b, const Real& v0,
                                     const Real& quarter_j, Stiffened& out) {
    const StiffeningLaw& law = *b.stiffening;
    const Real s = quarter_j * (8.0 / b.shear_modulus_pa) / v0 - 3.0;
    const Real end = splat(law.straight_from);
    const Real inside = s < end ? s : end;
    const Real over = s - inside;
    const Real room = splat(1.0) / (splat(law.limit) - inside);
    Real value = {}, slope = {}, integral = {};
    for (int k = stiffening_coefficients - 1; k >= 0; --k) {
        slope = slope * inside + value;
        value = value * inside + splat(law.coefficient[k]);
        integral = integral * inside + splat(law.coefficient[k] / (k + 1));
    }
    value += law.pole * room;
    slope += law.pole * room * room;
    const Real share = s * (1 / law.limit);
    out.share = share;
    out.integral = integral * inside -
                   law.pole * log_positive(1.0 - inside * (1 / law.limit)) +
                   over * (value + 0.5 * slope * over);
    return value + slope * over;
}

// Volume term U = V0 (K/2 ln^2 J - G ln J) of an element: J, ln J and the slope.
struct VolumeTerm {
    Real j, log_j, slope;  // slope = dU/dJ / V0 [Pa]
};

MAGFSI_INLINE VolumeTerm volume_term(const ElementBatches& b, const Real& j) {
    const Real log_j = log_positive(j);
    return {j, log_j, (b.lame_lambda_pa * log_j - b.shear_modulus_pa) / j};
}

// Adds the forces of the exact volume. d[m] = 1/8 dV/du_m has the terms of exact_volume
// in element.cpp.
MAGFSI_INLINE VolumeTerm exact_volume(const ElementBatches& b, const Real& v0,
                                      const Vec (&u)[8], Vec (&g)[8]) {
    const Real third = splat(1.0 / 3);
    const Vec &r1 = u[1], &r2 = u[2], &r3 = u[4], &s12 = u[3], &s23 = u[6], &s31 = u[5];
    const Vec a = third * cross(s12, s31);
    const Vec c = third * cross(s23, s12);
    const Vec e = third * cross(s31, s23);
    const Vec d1 = cross(r2, r3) + a;
    const Real v = 8.0 * (dot(r1, d1) + dot(r2, c) + dot(r3, e));
    const VolumeTerm term = volume_term(b, v / v0);
    g[1] = g[1] + term.slope * d1;
    g[2] = g[2] + term.slope * (cross(r3, r1) + c);
    g[4] = g[4] + term.slope * (cross(r1, r2) + e);
    const Real slope3 = term.slope * third;
    g[3] = g[3] + slope3 * (cross(s31, r1) + cross(r2, s23));
    g[6] = g[6] + slope3 * (cross(s12, r2) + cross(r3, s31));
    g[5] = g[5] + slope3 * (cross(r1, s12) + cross(s23, r3));
    return term;
}

// Adds the forces of the volume by the mean F, which in a brick depends on the three
// linear modes only.
MAGFSI_INLINE VolumeTerm mean_volume_of_brick(const ElementBatches& b, const Real& v0,
                                              const Vec (&u)[8], Vec (&g)[8]) {
    const Vec d1 = cross(u[2], u[4]);
    const VolumeTerm term = volume_term(b, 8.0 * dot(u[1], d1) / v0);
    g[1] = g[1] + term.slope * d1;
    g[2] = g[2] + term.slope * cross(u[4], u[1]);
    g[4] = g[4] + term.slope * cross(u[1], u[2]);
    return term;
}

// Adds V0/8 slope cof(F), an eighth of the volume term's stress on F, to `stress`.
MAGFSI_INLINE VolumeTerm mean_volume(const ElementBatches& b, const Real& v0,
                                     const Vec (&f)[3], Vec (&stress)[3]) {
    const Vec cofactor[3] = {cross(f[1], f[2]), cross(f[2], f[0]), cross(f[0], f[1])};
    const VolumeTerm term = volume_term(b, dot(f[0], cofactor[0]));
    const Real scale = 0.125 * v0 * term.slope;
    for (int d = 0; d < 3; ++d) stress[d] = stress[d] + scale * cofactor[d];
    return term;
}

// Scales the forces of springs and hourglass vectors in g by the law.
MAGFSI_INLINE Real stiffen(const ElementBatches& b, const Real& v0, const Real& springs,
                           Vec (&g)[8], Stiffened& law) {
    const Real factor = stiffening_factor(b, v0, springs, law);
    for (int m = 1; m < 8; ++m) g[m] = factor * g[m];
    return factor;
}

// Volume term and hourglass energy of a brick. Adds a quarter of the hourglass energy to
// `springs`.
template <bool stiffened>
MAGFSI_INLINE VolumeTerm assumed_strain_of_brick(const ElementBatches& b,
                                                 const double* data, const Real& v0,
                                                 const Vec (&u)[8], Vec (&g)[8],
                                                 Real& springs, Stiffened& law) {
    const Vec v[3] = {u[3], u[5], u[6]};
    Vec w[3];
    springs += hourglass<true>(b, data, v0, u, v, g, w);
    g[3] = g[3] + w[0];
    g[5] = g[5] + w[1];
    g[6] = g[6] + w[2];
    if constexpr (stiffened) stiffen(b, v0, springs, g, law);
    return mean_volume_of_brick(b, v0, u, g);
}

// The same for a general element, where the part of a homogeneous deformation is taken
// off the hourglass vectors first: v_j = u_j - F X_j.
template <bool stiffened>
MAGFSI_INLINE VolumeTerm assumed_strain(const ElementBatches& b, const double* gradient,
                                        const double* data, const Real& v0,
                                        const Vec (&u)[8], Vec (&g)[8], Real& springs,
                                        Stiffened& law) {
    Vec f[3];
    mean_gradient(gradient, u, f);
    const double* offset = data + 9 * batch_lanes;
    Vec v[3] = {u[3], u[5], u[6]};
    take_off_linear(offset, f, v);
    Vec w[3];
    springs += hourglass<false>(b, data, v0, u, v, g, w);
    g[3] = g[3] + w[0];
    g[5] = g[5] + w[1];
    g[6] = g[6] + w[2];
    Vec stress[3] = {};
    return_linear(offset, w, stress);
    if constexpr (stiffened) {
        const Real factor = stiffen(b, v0, springs, g, law);
        for (Vec& column : stress) column = factor * column;
    }
    const VolumeTerm term = mean_volume(b, v0, f, stress);
    add_stress(gradient, stress, g);
    return term;
}

// Smallest J of each lane and the batch, as a double, in which it was found. The largest
// share of a limit is kept with its sign reversed.
struct Smallest {
    Real j, batch;
};

// NaN counts as minus infinity, so that it is reported.
MAGFSI_INLINE void note_smallest(Smallest& smallest, const Real& j, double batch) {
    const Real seen = j == j ? j : splat(-__builtin_inf());
    const auto less = seen < smallest.j;
    smallest.j = less ? seen : smallest.j;
    smallest.batch = less ? splat(batch) : smallest.batch;
}

// Energy of the elements. springs: a quarter of the energy of springs and hourglass
// vectors.
template <bool stiffened>
MAGFSI_INLINE Real energy_of(const ElementBatches& b, const Real& v0, const Real& springs,
                             const VolumeTerm& term, const Stiffened& law) {
    if constexpr (stiffened) {
        return v0 *
               (0.5 * b.shear_modulus_pa * law.integral +
                term.log_j * (0.5 * b.lame_lambda_pa * term.log_j - b.shear_modulus_pa));
    }
    return 4.0 * springs - 1.5 * b.shear_modulus_pa * v0 +
           v0 * term.log_j * (0.5 * b.lame_lambda_pa * term.log_j - b.shear_modulus_pa);
}

// Adds the forces of the volume term and, for assumed_strain, those of the hourglass
// energy, a quarter of which is added to `springs`.
template <KernelKind kind, bool stiffened>
MAGFSI_INLINE VolumeTerm beyond_springs(const ElementBatches& b, long batch, int lane,
                                        const Real& v0, const Vec (&u)[8], Vec (&g)[8],
                                        Real& springs, Stiffened& law) {
    const auto of_batch = [batch, lane](const double* data, int entries) {
        return data + batch * entries * batch_lanes + lane;
    };
    if constexpr (kind == KernelKind::brick_full || kind == KernelKind::general_full) {
        if constexpr (stiffened) stiffen(b, v0, springs, g, law);
        return exact_volume(b, v0, u, g);
    } else {
        const double* data = of_batch(b.hourglass, hourglass_entries(kind));
        if constexpr (is_brick(kind)) {
            return assumed_strain_of_brick<stiffened>(b, data, v0, u, g, springs, law);
        } else {
            return assumed_strain<stiffened>(b,
                                             of_batch(b.gradient, gradient_entries(kind)),
                                             data, v0, u, g, springs, law);
        }
    }
}

// One batch: takes the positions of the nodes in u and leaves the forces there; returns
// J.
template <KernelKind kind, bool want_energy, bool stiffened>
MAGFSI_INLINE Real element(const ElementBatches& b, long batch, int lane, Vec (&u)[8],
                           Real& energy, Stiffened& law) {
    constexpr bool brick = is_brick(kind);
    constexpr int entries = brick ? 7 : 28;
    const double* spring = b.spring + batch * entries * batch_lanes + lane;
    const Real v0 = load(b.volume + batch * batch_lanes + lane);
    to_modes(u);
    for (int m = 1; m < 8; ++m) u[m] = splat(0.125) * u[m];
    Vec g[8];
    spring_modes<brick>(spring, u, g);
    Real springs = {};
    if constexpr (want_energy || stiffened) {
        for (int m = 1; m < 8; ++m) springs += dot(g[m], u[m]);
    }
    const VolumeTerm term =
        beyond_springs<kind, stiffened>(b, batch, lane, v0, u, g, springs, law);
    if constexpr (want_energy) energy = energy_of<stiffened>(b, v0, springs, term, law);
    u[0] = {Real{}, Real{}, Real{}};
    for (int m = 1; m < 8; ++m) u[m] = splat(-1.0) * g[m];
    to_nodes(u);
    return term.j;
}

// The smallest J of all lanes; of equal ones that of the first lane.
KernelResult first_smallest(const Smallest (&smallest)[batch_lanes / width]) {
    KernelResult out;
    out.smallest_j = __builtin_inf();
    for (int lane = 0; lane < batch_lanes; ++lane) {
        const double j = smallest[lane / width].j[lane % width];
        if (j < out.smallest_j) {
            out.smallest_j = j;
            const double batch = smallest[lane / width].batch[lane % width];
            out.element = static_cast<int>(batch) * batch_lanes + lane;
        }
    }
    return out;
}

// All batches in order. Lanes past the last element repeat it and add nothing.
template <KernelKind kind, bool want_energy, bool stiffened>
KernelResult run(const ElementBatches& b, const double* x, double* f) {
    Smallest smallest[batch_lanes / width], tightest[batch_lanes / width];
    for (Smallest& s : smallest) s = {splat(__builtin_inf()), Real{}};
    if constexpr (stiffened)
        for (Smallest& s : tightest) s = {Real{}, splat(-1)};
    double energy_sum = 0;
    const long batches = (b.element_count + batch_lanes - 1) / batch_lanes;
    for (long batch = 0; batch < batches; ++batch) {
        const int filled = b.element_count - static_cast<int>(batch) * batch_lanes;
        for (int part = 0; part < batch_lanes / width; ++part) {
            const int lane = part * width;
            const int* node = b.node + batch * 8 * batch_lanes + lane;
            Vec u[8];
            for (int a = 0; a < 8; ++a) u[a] = gather_node(x, node + a * batch_lanes);
            Real energy = {};
            Stiffened law;
            const Real j =
                element<kind, want_energy, stiffened>(b, batch, lane, u, energy, law);
            note_smallest(smallest[part], j, static_cast<double>(batch));
            if constexpr (stiffened)
                note_smallest(tightest[part], -law.share, static_cast<double>(batch));
            const int left = filled - lane;
            if (left >= width) {
                for (int a = 0; a < 8; ++a) {
                    scatter_node(f, node + a * batch_lanes, u[a], width);
                }
            } else {
                for (int a = 0; a < 8; ++a) {
                    scatter_node(f, node + a * batch_lanes, u[a], left);
                }
            }
            if constexpr (want_energy) {
                for (int l = 0; l < width && l < left; ++l) energy_sum += energy[l];
            }
        }
    }
    KernelResult out = first_smallest(smallest);
    if (out.element >= b.element_count) out.element = b.element_count - 1;
    out.energy_j = energy_sum;
    if constexpr (stiffened) {
        const KernelResult tight = first_smallest(tightest);
        out.largest_share = -tight.smallest_j;
        out.tight_element =
            tight.element < b.element_count ? tight.element : b.element_count - 1;
        if (!(out.largest_share > 0)) out.tight_element = -1;
    }
    return out;
}

template <KernelKind kind>
KernelResult run(const ElementBatches& b, const double* x, double* f, bool energy) {
    if (b.stiffening)
        return energy ? run<kind, true, true>(b, x, f) : run<kind, false, true>(b, x, f);
    return energy ? run<kind, true, false>(b, x, f) : run<kind, false, false>(b, x, f);
}

}  // namespace

KernelResult run_elements(const ElementBatches& b, const double* x, double* f,
                          bool energy) {
    switch (b.kind) {
        case KernelKind::brick_full:
            return run<KernelKind::brick_full>(b, x, f, energy);
        case KernelKind::brick_assumed_strain:
            return run<KernelKind::brick_assumed_strain>(b, x, f, energy);
        case KernelKind::general_full:
            return run<KernelKind::general_full>(b, x, f, energy);
        case KernelKind::general_assumed_strain:
            return run<KernelKind::general_assumed_strain>(b, x, f, energy);
    }
    return {};
}

}  // namespace magfsi::structure::MAGFSI_ISA
