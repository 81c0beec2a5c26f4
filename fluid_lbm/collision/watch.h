// Whether every cell that a kernel touched is still sound: a density above 0 and below
// infinity and a speed within the lattice's limit. NaN fails the comparison.
//
// A population that is not finite makes the density so; thus a cell that passes had 19
// finite populations and leaves finite ones.
#pragma once

#include "fluid_lbm/collision/simd.h"

namespace magfsi::fluid {

// Cells a step that no cell may reach: above it the lattice's equilibria go negative and
// its compressibility error is of order one.
inline constexpr double lattice_speed_limit = 0.4;

// The same for one cell outside the kernels.
inline bool is_sound(double density, double speed) {
    return density > 0 && density < __builtin_inf() && speed <= lattice_speed_limit;
}

template <class V>
class Watch {
  public:
    // ju: j . u = density * speed^2. One comparison for all limits: a square is never
    // below 1 / density if that is negative or, the density being infinite, 0. (It also
    // finds density * speed^2 >= 1, which no flow near density 1 has.)
    MAGFSI_INLINE void see(const V& ju, const V& per_density) {
        const V limit = V{} + constant<V>(lattice_speed_limit * lattice_speed_limit);
        const V least = per_density < limit ? per_density : limit;
        sound_ = ju * per_density < least ? sound_ : Mask{};
    }
    MAGFSI_INLINE bool all_sound() const {
        bool sound = true;
        for (int i = 0; i < lanes<V>; ++i) sound = sound && sound_[i] != 0;
        return sound;
    }

  private:
    using Mask = decltype(V{} <= V{});
    Mask sound_ = V{} <= V{};
};

}  // namespace magfsi::fluid
