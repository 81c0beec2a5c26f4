// Whether an array holds numbers only, at the price of reading it.
#pragma once

#include <bit>
#include <cstdint>
#include <span>

namespace magfsi::lammps {

// Infinities and what is not a number have all bits of their exponent set: one more there
// carries into the sign, which is else clear once the number's own is masked. Bits can be
// put together in any order, unlike sums, so that the compiler takes many at once.
inline bool all_finite(std::span<const double> values) {
    constexpr std::uint64_t exponent = 0x7ff0000000000000, one = 0x0010000000000000;
    std::uint64_t carried = 0;
    for (const double value : values)
        carried |= (std::bit_cast<std::uint64_t>(value) & exponent) + one;
    return (carried >> 63) == 0;
}

}  // namespace magfsi::lammps
