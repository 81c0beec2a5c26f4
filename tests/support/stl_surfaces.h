// SPDX-License-Identifier: GPL-2.0-or-later
// Closed surfaces of triangles for tests: bricks and balls, written as ASCII STL.
#pragma once

#include <array>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>
#include <numbers>
#include <vector>

#include "base/vector/vec3.h"

namespace magfsi::test {

using Corner = Vec3;
using Triangles = std::vector<std::array<Corner, 3>>;

// The surface of a cube of n x n x n cells, each square cut in two; place gives the point
// of a corner of cells. Seen from outside triangles run counter-clockwise.
template <class Place>
Triangles cube_surface(int n, const Place& place) {
    Triangles out;
    for (std::size_t d = 0; d < 3; ++d) {
        for (int side = 0; side < 2; ++side) {
            for (int cell = 0; cell < n * n; ++cell) {
                std::array<Corner, 4> quad;
                for (int q = 0; q < 4; ++q) {
                    const int corner = side == 1 ? q : 3 - q;
                    std::array<int, 3> at{};
                    at[d] = side * n;
                    at[(d + 1) % 3] = cell % n + (corner == 1 || corner == 2 ? 1 : 0);
                    at[(d + 2) % 3] = cell / n + (corner / 2);
                    quad[static_cast<std::size_t>(q)] = place(at);
                }
                out.push_back({quad[0], quad[1], quad[2]});
                out.push_back({quad[0], quad[2], quad[3]});
            }
        }
    }
    return out;
}

inline Triangles brick_surface(const Corner& low, const Corner& high) {
    return cube_surface(1, [&](const std::array<int, 3>& at) {
        Corner x;
        for (std::size_t d = 0; d < 3; ++d) x[d] = at[d] == 0 ? low[d] : high[d];
        return x;
    });
}

// All corners lie on the ball.
inline Triangles ball_surface(const Corner& centre, double radius, int n) {
    return cube_surface(n, [&](const std::array<int, 3>& at) {
        Corner x;
        for (std::size_t d = 0; d < 3; ++d)
            x[d] = std::tan(0.25 * std::numbers::pi * (2.0 * at[d] / n - 1));
        return centre + radius * x / norm(x);
    });
}

inline std::filesystem::path write_stl(const std::filesystem::path& file,
                                       const Triangles& triangles) {
    std::ofstream out(file);
    out.precision(std::numeric_limits<double>::max_digits10);
    out << "solid test\n";
    for (const auto& triangle : triangles) {
        out << "facet normal 0 0 0\nouter loop\n";
        for (const Corner& x : triangle)
            out << "vertex " << x[0] << ' ' << x[1] << ' ' << x[2] << '\n';
        out << "endloop\nendfacet\n";
    }
    out << "endsolid test\n";
    return file;
}

}  // namespace magfsi::test
