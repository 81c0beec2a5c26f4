// Recursive regularised collision (Malaspinas 2015; Jacob, Malaspinas, Sagaut 2018): the
// populations are rebuilt from density, momentum, the second-order moment and the
// third-order moments that follow from it,
//   a_xxy = rho ux ux uy + (1 - omega) (2 ux n_xy + uy n_xx),
// n the non-equilibrium stress. All that the lattice carries beyond (ghost modes) is
// dropped, which is why it stays stable close to tau = 1/2.
//
// Of the third-order Hermite polynomials D3Q19 supports the six sums and differences
//   H_xxy +- H_yzz, H_xzz +- H_xyy, H_yyz +- H_xxz.
#pragma once

#include "fluid_lbm/collision/cells.h"
#include "fluid_lbm/collision/moments.h"
#include "fluid_lbm/options.h"

namespace magfsi::fluid {

struct RecursiveRegularized {
    static constexpr Collision kind = Collision::recursive_regularized;

    // force: read only if Forced.
    template <bool Forced, class V, class Real>
    MAGFSI_INLINE static void collide(const LaneCells<V, Real>& f, const V (&force)[3],
                                      const Rates<V>& rates, CellCheck<V>& check);
};

// The third-order moments as sums and differences: [0] a_xzz, a_xyy; [1] a_xxy, a_yzz;
// [2] a_yyz, a_xxz. n is already multiplied by 1 - omega.
template <class V>
struct ThirdOrder {
    V sum[3], difference[3];
};

template <class V>
MAGFSI_INLINE ThirdOrder<V> third_order(const V (&u)[3], const Symmetric<V>& ruu,
                                        const Symmetric<V>& n) {
    const V xzz = ruu.zz * u[0] + 2.0 * u[2] * n.xz + u[0] * n.zz;
    const V xyy = ruu.yy * u[0] + 2.0 * u[1] * n.xy + u[0] * n.yy;
    const V xxy = ruu.xx * u[1] + 2.0 * u[0] * n.xy + u[1] * n.xx;
    const V yzz = ruu.zz * u[1] + 2.0 * u[2] * n.yz + u[1] * n.zz;
    const V yyz = ruu.yy * u[2] + 2.0 * u[1] * n.yz + u[2] * n.yy;
    const V xxz = ruu.xx * u[2] + 2.0 * u[0] * n.xz + u[2] * n.xx;
    return {{xzz + xyy, xxy + yzz, yyz + xxz}, {xzz - xyy, xxy - yzz, yyz - xxz}};
}

template <int Q, class V, class Real>
MAGFSI_INLINE void rebuild_pair(const LaneCells<V, Real>& f, const V& even,
                                const V& odd) {
    constexpr Lane<V> w = constant<V>(d3q19::weight(Q));
    f.write(Q, w * (even + odd));
    f.write(Q + 1, w * (even - odd));
}

// f = w {excess + 3 c.j + 4.5 (c c - I/3) : a + 4.5 [3 (H + H')(a + a') + (H - H')
// (a - a') + ...]}, with the Hermite polynomials evaluated for each direction.
template <class V, class Real>
MAGFSI_INLINE void rebuild(const LaneCells<V, Real>& f, const V& excess, const V (&j)[3],
                           const Symmetric<V>& a, const ThirdOrder<V>& t) {
    const V base = excess - 1.5 * (a.xx + a.yy + a.zz);
    const V x = 3.0 * j[0], y = 3.0 * j[1], z = 3.0 * j[2];
    f.write(0, constant<V>(d3q19::weight_rest) * base);
    rebuild_pair<1>(f, base + 4.5 * a.xx, x - 9.0 * t.sum[0]);
    rebuild_pair<3>(f, base + 4.5 * a.yy, y - 9.0 * t.sum[1]);
    rebuild_pair<5>(f, base + 4.5 * a.zz, z - 9.0 * t.sum[2]);
    V plus[3], minus[3];
    for (int i = 0; i < 3; ++i) {
        plus[i] = 4.5 * (t.sum[i] + t.difference[i]);
        minus[i] = 4.5 * (t.sum[i] - t.difference[i]);
    }
    const V xy = base + 4.5 * (a.xx + a.yy), x_y = minus[0], y_x = plus[1];
    rebuild_pair<7>(f, xy + 9.0 * a.xy, (x + y) + (x_y + y_x));
    rebuild_pair<9>(f, xy - 9.0 * a.xy, (x - y) + (x_y - y_x));
    const V xz = base + 4.5 * (a.xx + a.zz), x_z = plus[0], z_x = minus[2];
    rebuild_pair<11>(f, xz + 9.0 * a.xz, (x + z) + (x_z + z_x));
    rebuild_pair<13>(f, xz - 9.0 * a.xz, (x - z) + (x_z - z_x));
    const V yz = base + 4.5 * (a.yy + a.zz), y_z = minus[1], z_y = plus[2];
    rebuild_pair<15>(f, yz + 9.0 * a.yz, (y + z) + (y_z + z_y));
    rebuild_pair<17>(f, yz - 9.0 * a.yz, (y - z) + (y_z - z_y));
}

template <bool Forced, class V, class Real>
MAGFSI_INLINE void RecursiveRegularized::collide(const LaneCells<V, Real>& f,
                                                 const V (&force)[3],
                                                 const Rates<V>& rates,
                                                 CellCheck<V>& check) {
    MomentsToSecond<V> all = moments_to_second(f);
    Moments<V>& m = all.low;
    if constexpr (Forced) shift_momentum(m, force);
    const V per_density = 1.0 / (1.0 + m.excess);
    const V u[3] = {m.j[0] * per_density, m.j[1] * per_density, m.j[2] * per_density};
    const V keep = 1.0 - rates.even;
    const Symmetric<V> ruu = outer(m.j, u);
    check.add(ruu.xx + ruu.yy + ruu.zz, per_density);
    Symmetric<V> n = nonequilibrium(all, ruu);
    if constexpr (Forced) {
        // Guo: the second moment becomes eq + (1 - omega) n + (1 - omega/2)(uF + Fu) with
        // the raw n. Adding half of uF + Fu to n first makes n the viscous stress itself,
        // which is what the recursion wants, and leaves another half to add.
        const Symmetric<V> g = half_force_stress(u, force);
        n = scaled(keep, add(n, g));
        const ThirdOrder<V> t = third_order(u, ruu, n);
        shift_momentum(m, force);  // sum c f + F
        rebuild(f, m.excess, m.j, add(add(ruu, n), g), t);
    } else {
        n = scaled(keep, n);
        rebuild(f, m.excess, m.j, add(ruu, n), third_order(u, ruu, n));
    }
}

}  // namespace magfsi::fluid
