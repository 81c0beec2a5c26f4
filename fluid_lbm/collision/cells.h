// SPDX-License-Identifier: GPL-2.0-or-later
// What every collision is given: the populations of a few cells, one cell per lane, the
// relaxation rates, and the check of the cells' state.
#pragma once

#include <cstddef>

#include "fluid_lbm/lattice/d3q19.h"
#include "isa/simd.h"

namespace magfsi::fluid {

// The populations where they lie in memory: a collision reads those that have arrived and
// writes those that leave. Read through, not copied: 19 vectors do not fit into the 16
// registers of AVX2, and a copy would go to the stack and back.
template <class V, class Real>
class LaneCells {
  public:
    using Vector = V;
    MAGFSI_INLINE LaneCells(Real* const* at, std::ptrdiff_t x) : at_(at), x_(x) {}

    // Population minus weight. Of a pair of opposites read both before either is written:
    // each goes to where the other one came from.
    MAGFSI_INLINE V operator[](int q) const { return load<V>(at_[q] + x_); }
    MAGFSI_INLINE void write(int q, const V& f) const {
        store(at_[d3q19::opposite(q)] + x_, f);
    }

  private:
    Real* const* at_;
    std::ptrdiff_t x_;
};

// What a run gives to its kernels; lattice units.
struct CollisionParameters {
    double omega = 1;          // 1 / tau, tau the relaxation time of the viscosity
    double magic = 3.0 / 16;   // Lambda: how odd modes relax
    double eddy_constant = 0;  // Smagorinsky's
    const double* by_stress = nullptr;  // omega by the stress: shear_dependent.h
};

// Odd moments relax so that Ginzburg's magic number stays,
//   Lambda = (1 / even - 1/2) (1 / odd - 1/2),
// that is odd = 1 / (1/2 + Lambda / (1 / even - 1/2)), here without the divisions that
// vanish at even = 2.
template <class V>
MAGFSI_INLINE V odd_rate(const V& even, const V& magic) {
    const V slack = 2.0 - even;
    return 2.0 * slack / (slack + 4.0 * magic * even);
}

// Even modes of fourth order relax ten times as far from 1/2 as the viscous ones,
//   tau4 - 1/2 = 10 (1 / even - 1/2):
// a plate's impulse then keeps within 1 to 2 % over time steps of 1 : 4, and stays stable
// where two relaxation times diverge.
template <class V>
MAGFSI_INLINE V fourth_rate(const V& even) {
    const V slack = 10.0 * (2.0 - even);
    return 2.0 * even / (slack + even);
}

// Rates of each lane; a collision ignores those that it has no use for.
template <class V>
struct Rates {
    V even, odd, fourth;
    V magic, eddy_constant;
    const double* by_stress;
};

template <class V>
MAGFSI_INLINE Rates<V> rates(const CollisionParameters& p) {
    // In double: 2 - omega loses digits near tau = 1/2.
    return {V{} + constant<V>(p.omega),
            V{} + constant<V>(odd_rate(p.omega, p.magic)),
            V{} + constant<V>(fourth_rate(p.omega)),
            V{} + constant<V>(p.magic),
            V{} + constant<V>(p.eddy_constant),
            p.by_stress};
}

// Cells a step that no cell may reach: above it the lattice's equilibria go negative and
// its compressibility error is of order one.
inline constexpr double lattice_speed_limit = 0.4;

// A density above 0 and below infinity and a speed within the limit; NaN fails.
inline bool is_valid(double density, double speed) {
    return density > 0 && density < __builtin_inf() && speed <= lattice_speed_limit;
}

// The same check in passing for all cells that a kernel touches. A population that is not
// finite makes the density so; thus a cell that passes had 19 finite populations and
// leaves finite ones.
template <class V>
class CellCheck {
  public:
    // ju: j . u = density * speed^2. One comparison for all limits: a square is never
    // below 1 / density if that is negative or, the density being infinite, 0. (It also
    // finds density * speed^2 >= 1, which no flow near density 1 has.)
    MAGFSI_INLINE void add(const V& ju, const V& per_density) {
        const V limit = V{} + constant<V>(lattice_speed_limit * lattice_speed_limit);
        const V least = per_density < limit ? per_density : limit;
        valid_ = ju * per_density < least ? valid_ : Mask{};
    }
    MAGFSI_INLINE bool all_valid() const {
        bool valid = true;
        for (int i = 0; i < lanes<V>; ++i) valid = valid && valid_[i] != 0;
        return valid;
    }

  private:
    using Mask = decltype(V{} <= V{});
    Mask valid_ = V{} <= V{};
};

}  // namespace magfsi::fluid
