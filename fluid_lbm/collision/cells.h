// SPDX-License-Identifier: GPL-2.0-or-later
// Input of every collision: the populations of a few cells, one cell per lane, the
// relaxation rates, and the check of the cells' state.
#pragma once

#include <cstddef>

#include "base/isa/simd.h"
#include "fluid_lbm/lattice/d3q19.h"

namespace magfsi::fluid {

// The populations of one vector of cells, in place. A collision reads those that have
// arrived and writes those that leave. They are read through pointers, not copied: 19
// vectors do not fit into the 16 registers of AVX2, and a copy would go to the stack and
// back.
template <class V, class Real>
class LaneCells {
  public:
    using Vector = V;
    // at: the 19 pointers of a row (RowPointers::at); x: its first cell in this vector.
    MAGFSI_INLINE LaneCells(Real* const* at, std::ptrdiff_t x) : at_(at), x_(x) {}

    // Population q minus its weight. Both of a pair of opposites must be read before
    // either is written: write(q) overwrites the slot that the opposite population was
    // read from.
    MAGFSI_INLINE V operator[](int q) const { return load<V>(at_[q] + x_); }
    MAGFSI_INLINE void write(int q, const V& f) const {
        store(at_[d3q19::opposite(q)] + x_, f);
    }

  private:
    Real* const* at_;
    std::ptrdiff_t x_;
};

// Parameters of the collision, the same for all cells of a run; lattice units.
struct CollisionParameters {
    double omega = 1;          // 1 / tau, tau the relaxation time of the viscosity
    double magic = 3.0 / 16;   // Lambda, sets the rate of the odd modes
    double eddy_constant = 0;  // Smagorinsky's constant C
    // Table of 1 / tau by the stress (shear_dependent.h).
    const double* by_stress = nullptr;
    double bulk = 1;  // rate of the trace of the stress, for TraceRate::own
};

// Rate at which the trace of the non-equilibrium stress relaxes: that of the viscosity,
// or one of its own, which sets the bulk viscosity (bulk_viscosity.h).
enum class TraceRate { viscous, own };

// Rate of the odd modes that keeps Ginzburg's magic number
//   Lambda = (1 / even - 1/2) (1 / odd - 1/2),
// that is odd = 1 / (1/2 + Lambda / (1 / even - 1/2)), written without the divisions by
// quantities that vanish at even = 2.
template <class V>
MAGFSI_INLINE V odd_rate(const V& even, const V& magic) {
    const V slack = 2.0 - even;
    return 2.0 * slack / (slack + 4.0 * magic * even);
}

// Rate of the even fourth-order modes: their tau lies ten times as far from 1/2 as the
// viscous one,
//   tau4 - 1/2 = 10 (1 / even - 1/2).
// A plate's impulse then stays within 1 to 2 % over time steps of 1 : 4, and runs stay
// stable where two relaxation times diverge.
template <class V>
MAGFSI_INLINE V fourth_rate(const V& even) {
    const V slack = 10.0 * (2.0 - even);
    return 2.0 * even / (slack + even);
}

// Relaxation rates of each lane (1 / tau). A collision ignores those that it does not
// use.
template <class V>
struct Rates {
    V even, odd, fourth;  // viscous, odd, and even fourth-order modes
    V magic, eddy_constant;
    const double* by_stress;
    V bulk;  // trace of the stress, in collisions with TraceRate::own
};

// The rates of the run's parameters, the same in all lanes.
template <class V>
MAGFSI_INLINE Rates<V> rates(const CollisionParameters& p) {
    // The rates are computed in double: 2 - omega loses digits near tau = 1/2.
    return {V{} + constant<V>(p.omega),
            V{} + constant<V>(odd_rate(p.omega, p.magic)),
            V{} + constant<V>(fourth_rate(p.omega)),
            V{} + constant<V>(p.magic),
            V{} + constant<V>(p.eddy_constant),
            p.by_stress,
            V{} + constant<V>(p.bulk)};
}

// Largest speed that a cell may reach [cells per step]: above it the lattice's equilibria
// become negative and its compressibility error is of order one.
inline constexpr double lattice_speed_limit = 0.4;

// True for a density above 0 and below infinity and a speed within the limit; false for
// NaN.
inline bool is_valid(double density, double speed) {
    return density > 0 && density < __builtin_inf() && speed <= lattice_speed_limit;
}

// The check of is_valid() for all cells that a kernel touches, at the cost of a few
// instructions. A population that is not finite makes the density so; thus a cell that
// passes had 19 finite populations and leaves finite ones.
template <class V>
class CellCheck {
  public:
    // Adds the cells of a vector to the check. ju: j . u = density * speed^2. One
    // comparison covers all limits: a square is never below 1 / density if that is
    // negative or, for an infinite density, 0. (It also rejects density * speed^2 >= 1,
    // which no flow near density 1 has.)
    MAGFSI_INLINE void add(const V& ju, const V& per_density) {
        const V limit = V{} + constant<V>(lattice_speed_limit * lattice_speed_limit);
        const V least = per_density < limit ? per_density : limit;
        valid_ = ju * per_density < least ? valid_ : Mask{};
    }
    // True if all cells so far have passed.
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
