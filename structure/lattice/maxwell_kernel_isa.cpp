// SPDX-License-Identifier: GPL-2.0-or-later
// Kernel for Maxwell branches in Hadamard mode space, `width` elements at a time;
// maxwell_element is the same in plain form, and maxwell.h has the law.
#include "structure/lattice/motion_lanes.h"

namespace magfsi::structure::MAGFSI_ISA {
namespace {

// Symmetric 3x3 matrices, in the order 11, 22, 33, 12, 13, 23.
struct Symmetric {
    Real v[6];
};

MAGFSI_INLINE const Real& at(const Symmetric& s, int i, int j) {
    return s.v[i == j ? i : i + j + 2];
}

MAGFSI_INLINE Real dot(const Symmetric& a, const Symmetric& b) {
    return a.v[0] * b.v[0] + a.v[1] * b.v[1] + a.v[2] * b.v[2] +
           2.0 * (a.v[3] * b.v[3] + a.v[4] * b.v[4] + a.v[5] * b.v[5]);
}

// Inverse of a and its determinant.
MAGFSI_INLINE Symmetric inverse(const Symmetric& a, Real& det) {
    const Real(&m)[6] = a.v;
    Symmetric c{{m[1] * m[2] - m[5] * m[5], m[0] * m[2] - m[4] * m[4],
                 m[0] * m[1] - m[3] * m[3], m[4] * m[5] - m[3] * m[2],
                 m[3] * m[5] - m[4] * m[1], m[3] * m[4] - m[0] * m[5]}};
    det = m[0] * c.v[0] + m[3] * c.v[3] + m[4] * c.v[4];
    const Real over = splat(1.0) / det;
    for (Real& value : c.v) value = over * value;
    return c;
}

// d c d, symmetric.
MAGFSI_INLINE Symmetric between(const Symmetric& d, const Symmetric& c) {
    Real half[3][3];  // c d
    for (int i = 0; i < 3; ++i) {
        for (int j = 0; j < 3; ++j) {
            half[i][j] = at(c, i, 0) * at(d, 0, j) + at(c, i, 1) * at(d, 1, j) +
                         at(c, i, 2) * at(d, 2, j);
        }
    }
    Symmetric out;
    for (int i = 0; i < 3; ++i) {
        for (int j = i; j < 3; ++j) {
            out.v[i == j ? i : i + j + 2] = at(d, i, 0) * half[0][j] +
                                            at(d, i, 1) * half[1][j] +
                                            at(d, i, 2) * half[2][j];
        }
    }
    return out;
}

// The strains of an element, or a branch's elastic part of them: of the mean F (minus the
// inverse of C), of the hourglass vectors, and of the mode xyz.
struct Strains {
    Symmetric mean;
    Planes planes;
    Real last[3];
};

template <class Each>
MAGFSI_INLINE void for_each(Plane& plane, const Each& each) {
    each(plane.first);
    each(plane.second);
    each(plane.shear);
}

// Calls each(value) for the numbers of a in the order in which they are stored.
template <class Each>
MAGFSI_INLINE void for_each(Strains& a, const Each& each) {
    for (Real& value : a.mean.v) each(value);
    for_each(a.planes.x, each);
    for_each(a.planes.y, each);
    for_each(a.planes.z, each);
    for (Real& value : a.last) each(value);
}

MAGFSI_INLINE void load_strains(const double* state, Strains& out) {
    for_each(out, [&](Real& value) {
        value = load(state);
        state += batch_lanes;
    });
}

MAGFSI_INLINE void store_strains(double* state, Strains& in) {
    for_each(in, [&](Real& value) {
        __builtin_memcpy(state, &value, sizeof value);
        state += batch_lanes;
    });
}

// to = decay to + gain (now - before).
MAGFSI_INLINE void follow(Strains& to, const MaxwellFactors& by, Strains& now,
                          Strains& before) {
    Real change[maxwell_numbers];
    int n = 0;
    for_each(now, [&](Real& value) { change[n++] = value; });
    n = 0;
    for_each(before, [&](Real& value) {
        change[n] = change[n] - value;
        ++n;
    });
    n = 0;
    for_each(to, [&](Real& value) { value = by.decay * value + by.gain * change[n++]; });
}

MAGFSI_INLINE void add_scaled(Strains& sum, double factor, Strains& part) {
    Real values[maxwell_numbers];
    int n = 0;
    for_each(part, [&](Real& value) { values[n++] = value; });
    n = 0;
    for_each(sum, [&](Real& value) { value = value + factor * values[n++]; });
}

// Constants of the elements: an eighth of V0, the law of a plate for the modulus 1, and
// the coefficients of the mode xyz.
struct Constants {
    Real eighth;
    HourglassModuli plate;
    const double* metric;
    Real last[3];
};

template <bool brick>
MAGFSI_INLINE Constants constants(const MaxwellBatches& b, const double* data) {
    Constants out;
    const Real v0 = load(data);
    out.eighth = 0.125 * v0;
    out.plate = hourglass_moduli(1, b.plate_lambda, v0);
    out.metric = data + (brick ? 4 : 22) * batch_lanes;
    for (int d = 0; d < 3; ++d) {
        constexpr int entry[3] = {3, 0, 1};
        out.last[d] = load(out.metric + (brick ? d : entry[d]) * batch_lanes);
    }
    Real smallest = out.last[0] < out.last[1] ? out.last[0] : out.last[1];
    smallest = smallest < out.last[2] ? smallest : out.last[2];
    for (Real& p : out.last) p = (1.0 / 3) * out.eighth * smallest * p;
    return out;
}

// Twice the energy of the hourglass vectors of one branch over its modulus, an eighth.
template <bool brick>
MAGFSI_INLINE Real hourglass_square(const Constants& c, const Strains& y) {
    Real out = dot(hourglass_stress<brick>(c.plate, c.metric, y.planes), y.planes);
    for (int d = 0; d < 3; ++d) out += c.last[d] * y.last[d] * y.last[d];
    return out;
}

// One batch: takes positions in x and leaves the forces in x.mode.
template <bool brick, bool want_energy>
MAGFSI_INLINE void element(const MaxwellBatches& b, const double* data, double* state,
                           Motion& x, Real& dissipation, Real& energy) {
    complete<brick>(data, x);
    const Constants c = constants<brick>(b, data);
    Symmetric right;  // C = F^T F
    for (int i = 0; i < 3; ++i) {
        for (int j = i; j < 3; ++j) right.v[i == j ? i : i + j + 2] = dot(x.f[i], x.f[j]);
    }
    Real det;
    const Symmetric inverse_right = inverse(right, det);
    Strains now, before;
    for (int k = 0; k < 6; ++k) now.mean.v[k] = -inverse_right.v[k];
    now.planes = hourglass_strain(x.mode, x.v);
    for (int d = 0; d < 3; ++d) now.last[d] = dot(x.mode[1 << d], x.last[0]);
    load_strains(state, before);
    store_strains(state, now);
    Strains sum;
    for_each(sum, [](Real& value) { value = Real{}; });
    Real lost = {}, stored = {};
    for (int k = 0; k < b.branch_count; ++k) {
        double* own = state + (k + 1) * maxwell_numbers * batch_lanes;
        const MaxwellFactors& by = b.branches[k];
        Strains y;
        load_strains(own, y);
        follow(y, by, now, before);
        store_strains(own, y);
        add_scaled(sum, by.modulus_pa, y);
        Symmetric a;  // A = D + C^-1
        for (int n = 0; n < 6; ++n) a.v[n] = y.mean.v[n] + inverse_right.v[n];
        Real det_a;
        const Symmetric inverse_a = inverse(a, det_a);
        const Real bent = hourglass_square<brick>(c, y);
        lost += (by.modulus_pa * by.rate_1_s) *
                (0.5 * c.eighth * dot(inverse_a, between(y.mean, right)) + bent);
        if constexpr (want_energy) {
            stored +=
                (0.5 * by.modulus_pa) *
                (c.eighth * (dot(y.mean, right) - log_positive(det_a * det)) + bent);
        }
    }
    dissipation = 8.0 * lost;
    energy = 8.0 * stored;
    Vec stress[3];
    for (int j = 0; j < 3; ++j) {
        stress[j] = {Real{}, Real{}, Real{}};
        for (int i = 0; i < 3; ++i) stress[j] = stress[j] + at(sum.mean, i, j) * x.f[i];
        stress[j] = c.eighth * stress[j];
    }
    Vec g[8] = {};
    Vec w[3];
    hourglass_forces(hourglass_stress<brick>(c.plate, c.metric, sum.planes), x.mode, x.v,
                     g, w);
    Vec last[1] = {{Real{}, Real{}, Real{}}};
    for (int d = 0; d < 3; ++d) {
        const int m = 1 << d;
        const Real pull = c.last[d] * sum.last[d];
        g[m] = g[m] + pull * x.last[0];
        last[0] = last[0] + pull * x.mode[m];
    }
    g[3] = w[0];
    g[5] = w[1];
    g[6] = w[2];
    g[7] = last[0];
    const double* gradient = data + batch_lanes;
    if constexpr (brick) {
        for (int d = 0; d < 3; ++d) {
            g[1 << d] = g[1 << d] + load(gradient + d * batch_lanes) * stress[d];
        }
    } else {
        return_linear(data + 31 * batch_lanes, w, stress);
        return_linear(data + 40 * batch_lanes, last, stress);
        add_stress(gradient, stress, g);
    }
    x.mode[0] = {Real{}, Real{}, Real{}};
    for (int m = 1; m < 8; ++m) x.mode[m] = splat(-1.0) * g[m];
    to_nodes(x.mode);
}

// All batches in order. Lanes past the last element add nothing.
template <bool brick, bool want_energy>
MaxwellResult run(const MaxwellBatches& b, const double* x, double* f) {
    MaxwellResult sum;
    const long batches = (b.element_count + batch_lanes - 1) / batch_lanes;
    const long width_of_state = (1 + b.branch_count) * maxwell_numbers * batch_lanes;
    for (long batch = 0; batch < batches; ++batch) {
        const int filled = b.element_count - static_cast<int>(batch) * batch_lanes;
        for (int lane = 0; lane < batch_lanes && lane < filled; lane += width) {
            const int* node = b.node + batch * 8 * batch_lanes + lane;
            const double* data =
                b.data + batch * viscous_entries(brick) * batch_lanes + lane;
            Motion position;
            for (int a = 0; a < 8; ++a)
                position.mode[a] = gather_node(x, node + a * batch_lanes);
            Real dissipation, energy;
            element<brick, want_energy>(b, data, b.state + batch * width_of_state + lane,
                                        position, dissipation, energy);
            const int left = filled - lane;
            const int count = left < width ? left : width;
            for (int a = 0; a < 8; ++a) {
                scatter_node(f, node + a * batch_lanes, position.mode[a], count);
            }
            for (int l = 0; l < count; ++l) {
                sum.dissipation_w += dissipation[l];
                sum.energy_j += energy[l];
            }
        }
    }
    return sum;
}

}  // namespace

MaxwellResult run_maxwell(const MaxwellBatches& b, const double* x, double* f,
                          bool energy) {
    if (b.bricks) return energy ? run<true, true>(b, x, f) : run<true, false>(b, x, f);
    return energy ? run<false, true>(b, x, f) : run<false, false>(b, x, f);
}

}  // namespace magfsi::structure::MAGFSI_ISA
