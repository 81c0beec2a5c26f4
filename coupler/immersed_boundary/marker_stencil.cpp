// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupler/immersed_boundary/marker_stencil.h"

#include <fmt/format.h>

#include <algorithm>

#include "coupler/participants/errors.h"

namespace magfsi::coupler {

namespace {

[[noreturn]] void left_the_box(const Grid& grid, const Vec3& point_m) {
    throw Diverged(fmt::format(
        "the body left the fluid: a marker is at ({:.4g}, {:.4g}, {:.4g}) mm, the box is "
        "{:.4g} x {:.4g} x {:.4g} mm; make fluid.box larger or end the run earlier",
        point_m[0] * 1e3, point_m[1] * 1e3, point_m[2] * 1e3,
        grid.cells[0] * grid.spacing_m * 1e3, grid.cells[1] * grid.spacing_m * 1e3,
        grid.cells[2] * grid.spacing_m * 1e3));
}

// Drops the weights beyond walls and scales the others up, so that they add up to 1.
Stencil1D cut_at_walls(const Stencil1D& s, int cells) {
    Stencil1D cut;
    cut.first = std::max(s.first, 0);
    cut.count = std::min(s.first + s.count, cells) - cut.first;
    double sum = 0;
    for (int k = 0; k < cut.count; ++k) {
        const std::size_t from = cut.first - s.first + k;
        cut.weight[k] = s.weight[from];
        sum += s.weight[from];
    }
    for (double& w : cut.weight) w /= sum;
    return cut;
}

}  // namespace

void set_stencil(MarkerStencil& stencil, const Grid& grid, Kernel kernel,
                 const Vec3& point_m) {
    for (std::size_t d = 0; d < 3; ++d) {
        const int n = grid.cells[d];
        double position = point_m[d] / grid.spacing_m;
        if (grid.periodic[d]) position -= n * std::floor(position / n);
        if (!(position >= 0 && position <= n)) left_the_box(grid, point_m);
        Stencil1D& s = stencil[d];
        set_stencil(s, kernel, position);
        const bool inside = s.first >= 0 && s.first + s.count <= n;
        if (!inside && !grid.periodic[d]) s = cut_at_walls(s, n);
    }
}

MarkerStencil marker_stencil(const Grid& grid, Kernel kernel, const Vec3& point_m) {
    MarkerStencil stencil;
    set_stencil(stencil, grid, kernel, point_m);
    return stencil;
}

SolidCells::SolidCells(const Grid& grid) : cells_(grid.cells) {
    if (grid.solid.empty()) return;
    std::array<int, 3> hi{};
    lo_ = grid.cells;
    for (const GridRow& r : grid.solid) {
        const std::array<int, 3> first{r.x_begin, r.y, r.z};
        const std::array<int, 3> end{r.x_end, r.y + 1, r.z + 1};
        for (std::size_t d = 0; d < 3; ++d) {
            lo_[d] = std::min(lo_[d], first[d]);
            hi[d] = std::max(hi[d], end[d]);
        }
    }
    std::size_t count = 1;
    for (std::size_t d = 0; d < 3; ++d) {
        size_[d] = hi[d] - lo_[d];
        count *= size_[d];
    }
    solid_.assign(count, false);
    for (const GridRow& r : grid.solid) {
        const auto row =
            static_cast<std::ptrdiff_t>(r.z - lo_[2]) * size_[1] + r.y - lo_[1];
        const auto first = solid_.begin() + row * size_[0] - lo_[0];
        std::fill(first + r.x_begin, first + r.x_end, true);
    }
}

bool SolidCells::at(int x, int y, int z) const {
    const std::array<int, 3> cell{x - lo_[0], y - lo_[1], z - lo_[2]};
    for (std::size_t d = 0; d < 3; ++d) {
        if (cell[d] < 0 || cell[d] >= size_[d]) return false;
    }
    return solid_[(static_cast<std::size_t>(cell[2]) *
                       static_cast<std::size_t>(size_[1]) +
                   static_cast<std::size_t>(cell[1])) *
                      static_cast<std::size_t>(size_[0]) +
                  static_cast<std::size_t>(cell[0])];
}

// True if the stencil's cells reach into the box around all solid cells, or wrap.
bool SolidCells::may_meet(const MarkerStencil& stencil) const {
    for (std::size_t d = 0; d < 3; ++d) {
        const int first = stencil[d].first, end = first + stencil[d].count;
        const bool wraps = first < 0 || end > cells_[d];
        if (!wraps && (end <= lo_[d] || first >= lo_[d] + size_[d])) return false;
    }
    return true;
}

double SolidCells::fluid_share(const MarkerStencil& stencil) const {
    if (!any() || !may_meet(stencil)) return 1;
    const auto& [sx, sy, sz] = stencil;
    double share = 0;
    bool met = false;
    for (int k = 0; k < sz.count; ++k) {
        const int z = wrapped(sz.first + k, cells_[2]);
        for (int j = 0; j < sy.count; ++j) {
            const int y = wrapped(sy.first + j, cells_[1]);
            for (int i = 0; i < sx.count; ++i) {
                const double weight = sx.weight[i] * sy.weight[j] * sz.weight[k];
                if (weight == 0) continue;
                if (at(wrapped(sx.first + i, cells_[0]), y, z))
                    met = true;
                else
                    share += weight;
            }
        }
    }
    return met ? share : 1;
}

}  // namespace magfsi::coupler
