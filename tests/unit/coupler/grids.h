// SPDX-License-Identifier: GPL-2.0-or-later
// Grids cut into boxes, points and values at random, for the tests of the coupler.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <random>
#include <span>
#include <vector>

#include "coupler/immersed_boundary/grid.h"
#include "coupler/immersed_boundary/marker_stencil.h"

namespace magfsi::coupler::testing {

// phi(r) of each kernel, as it is defined piece by piece.
inline double delta(Kernel kernel, double r) {
    const double d = std::abs(r);
    if (kernel == Kernel::two_point) return std::max(0.0, 1 - d);
    if (kernel == Kernel::three_point) {
        if (d <= 0.5) return (1 + std::sqrt(1 - 3 * d * d)) / 3;
        if (d >= 1.5) return 0;
        return (5 - 3 * d - std::sqrt(std::max(0.0, 1 - 3 * (1 - d) * (1 - d)))) / 6;
    }
    if (d < 1) return (3 - 2 * d + std::sqrt(1 + 4 * d - 4 * d * d)) / 8;
    if (d >= 2) return 0;
    return (5 - 2 * d - std::sqrt(std::max(0.0, -7 + 12 * d - 4 * d * d))) / 8;
}

inline Stencil1D stencil_1d(Kernel kernel, double position_in_cells) {
    Stencil1D s;
    set_stencil(s, kernel, position_in_cells);
    return s;
}

inline constexpr Kernel all_kernels[] = {Kernel::two_point, Kernel::three_point,
                                         Kernel::four_point};

// A grid of 0.2 mm in pieces[0] x pieces[1] x pieces[2] boxes, one a rank.
inline Grid cut_grid(std::array<int, 3> cells, std::array<bool, 3> periodic,
                     std::array<int, 3> pieces = {1, 1, 1}) {
    Grid grid{2e-4, cells, periodic, {}};
    for (int k = 0; k < pieces[2]; ++k)
        for (int j = 0; j < pieces[1]; ++j)
            for (int i = 0; i < pieces[0]; ++i) {
                const int at[] = {i, j, k};
                CellBox box;
                for (std::size_t d = 0; d < 3; ++d) {
                    box.lo[d] = cells[d] * at[d] / pieces[d];
                    box.hi[d] = cells[d] * (at[d] + 1) / pieces[d];
                }
                grid.owned_by_rank.push_back({box});
            }
    return grid;
}

class Random {
  public:
    explicit Random(std::uint64_t seed) : engine_(seed) {}

    double between(double lo, double hi) {
        return std::uniform_real_distribution<double>(lo, hi)(engine_);
    }
    Vec3 vector(double size) {
        return {between(-size, size), between(-size, size), between(-size, size)};
    }
    std::vector<Vec3> vectors(std::size_t count, double size) {
        std::vector<Vec3> v;
        for (std::size_t i = 0; i < count; ++i) v.push_back(vector(size));
        return v;
    }
    // Anywhere in the box; along periodic sides up to a box and a half beyond it.
    std::vector<Vec3> points(const Grid& grid, std::size_t count) {
        std::vector<Vec3> all(count);
        for (Vec3& p : all) {
            for (std::size_t d = 0; d < 3; ++d) {
                const double size = grid.cells[d] * grid.spacing_m;
                const double beyond = grid.periodic[d] ? 1.5 * size : 0;
                p[d] = between(-beyond, size + beyond);
            }
        }
        return all;
    }

  private:
    std::mt19937_64 engine_;
};

// Three values in each cell of the whole grid.
class CellField {
  public:
    explicit CellField(const Grid& grid)
        : cells_(grid.cells),
          values_(3 * static_cast<std::size_t>(grid.cells[0]) *
                  static_cast<std::size_t>(grid.cells[1]) *
                  static_cast<std::size_t>(grid.cells[2])) {}

    std::vector<double>& values() { return values_; }
    const std::vector<double>& values() const { return values_; }

    std::size_t index(int x, int y, int z) const {
        return 3 * static_cast<std::size_t>((z * cells_[1] + y) * cells_[0] + x);
    }

    std::vector<double> read(std::span<const GridRow> rows) const {
        std::vector<double> out;
        for (const GridRow& r : rows) {
            const double* from = &values_[index(r.x_begin, r.y, r.z)];
            out.insert(out.end(), from, from + 3 * (r.x_end - r.x_begin));
        }
        return out;
    }
    void add(std::span<const GridRow> rows, std::span<const double> in) {
        auto at = in.begin();
        for (const GridRow& r : rows) {
            double* to = &values_[index(r.x_begin, r.y, r.z)];
            for (int i = 0; i < 3 * (r.x_end - r.x_begin); ++i) *to++ += *at++;
        }
    }

  private:
    std::array<int, 3> cells_;
    std::vector<double> values_;
};

}  // namespace magfsi::coupler::testing
