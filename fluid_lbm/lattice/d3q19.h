// SPDX-License-Identifier: GPL-2.0-or-later
// The D3Q19 lattice (Qian, d'Humieres, Lallemand 1992): velocities, weights, speed of
// sound. Plain arrays, because kernels that include this file must not instantiate the
// standard library (see cmake/IsaVariants.cmake).
#pragma once

namespace magfsi::fluid::d3q19 {

inline constexpr int directions = 19;

// Velocities c_q in cells per step. Opposite directions are neighbours, (1,2), (3,4),
// ...; the first of each pair has its first non-zero component positive.
inline constexpr int c[directions][3] = {
    {0, 0, 0},                                        // rest
    {1, 0, 0}, {-1, 0, 0},  {0, 1, 0},  {0, -1, 0},   //
    {0, 0, 1}, {0, 0, -1},                            // six faces
    {1, 1, 0}, {-1, -1, 0}, {1, -1, 0}, {-1, 1, 0},   //
    {1, 0, 1}, {-1, 0, -1}, {1, 0, -1}, {-1, 0, 1},   //
    {0, 1, 1}, {0, -1, -1}, {0, 1, -1}, {0, -1, 1}};  // twelve edges

// Weights w_q of the populations at rest, towards the six faces and towards the twelve
// edges of a cell; their sum is 1.
inline constexpr double weight_rest = 1.0 / 3;
inline constexpr double weight_face = 1.0 / 18;
inline constexpr double weight_edge = 1.0 / 36;

// Speed of sound squared, in (cells per step)^2.
inline constexpr double cs2 = 1.0 / 3;

constexpr double weight(int q) {
    return q == 0 ? weight_rest : q < 7 ? weight_face : weight_edge;
}

constexpr int opposite(int q) {
    return q == 0 ? 0 : q % 2 == 1 ? q + 1 : q - 1;
}

// The direction with these components, -1 if the lattice has none.
constexpr int direction(int cx, int cy, int cz) {
    for (int q = 0; q < directions; ++q) {
        if (c[q][0] == cx && c[q][1] == cy && c[q][2] == cz) {
            return q;
        }
    }
    return -1;
}

}  // namespace magfsi::fluid::d3q19
