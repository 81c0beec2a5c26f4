// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupler/immersed_boundary/spreading.h"

#include <algorithm>
#include <type_traits>

namespace magfsi::coupler {

namespace {

// True if two stencils of full support touch the same cells.
bool same_cells(const MarkerStencil& a, const MarkerStencil& b) {
    return a[0].first == b[0].first && a[1].first == b[1].first &&
           a[2].first == b[2].first;
}

}  // namespace

TouchedRows::TouchedRows(const Grid& grid, const std::vector<CellBox>& boxes,
                         Kernel kernel)
    : grid_(&grid), kernel_(kernel), solid_(grid) {
    int slots = 0;
    for (const CellBox& box : boxes) {
        parts_.push_back({box, slots});
        slots += (box.hi[1] - box.lo[1]) * (box.hi[2] - box.lo[2]);
    }
    row_of_.assign(slots, -1);
}

int TouchedRows::part_of(const MarkerStencil& stencil) const {
    if (parts_.size() == 1) return 0;
    for (std::size_t p = 0; p < parts_.size(); ++p) {
        const CellBox& box = parts_[p].box;
        bool meets = true;
        for (std::size_t d = 0; d < 3 && meets; ++d) {
            meets = false;
            for (int i = 0; i < stencil[d].count && !meets; ++i)
                meets = from_box(box, stencil[d].first + i, d) < box.hi[d];
        }
        if (meets) return static_cast<int>(p);
    }
    return no_part;
}

// Calls visit(slot, run, weight along y and z) for the marker's cells that this rank owns
// and that hold fluid, as runs along x that do not wrap. Weights are divided by the
// marker's share in the fluid.
template <typename Visit>
void TouchedRows::for_each_run(std::size_t marker, Visit&& visit) const {
    const auto& [sx, sy, sz] = stencils_[marker];
    const double share = share_[marker];
    if (share == 0 || part_of_[marker] == no_part) return;
    const Part& mine = part(marker);
    const CellBox& box = mine.box;
    Runs runs;
    const std::size_t pieces = runs_along_x(box, sx, runs);
    for (int k = 0; k < sz.count; ++k) {
        const int z = from_box(box, sz.first + k, 2);
        if (z < box.lo[2] || z >= box.hi[2]) continue;
        for (int j = 0; j < sy.count; ++j) {
            const int y = from_box(box, sy.first + j, 1);
            if (y < box.lo[1] || y >= box.hi[1]) continue;
            const double wyz = sy.weight[j] * sz.weight[k] / share;
            for (std::size_t p = 0; p < pieces; ++p) {
                if (share == 1) {
                    visit(mine.slot(y, z), runs[p], wyz);
                    continue;
                }
                without_solid(y, z, runs[p],
                              [&](const Run& run) { visit(mine.slot(y, z), run, wyz); });
            }
        }
    }
}

// Splits a run at solid cells.
template <typename Visit>
void TouchedRows::without_solid(int y, int z, const Run& run, Visit&& visit) const {
    for (int i = 0; i < run.cells;) {
        int end = i;
        while (end < run.cells && !solid_.at(run.x + end, y, z)) ++end;
        if (end > i) visit(Run{run.x + i, end - i, run.weight + i});
        i = end + 1;
    }
}

// Splits the stencil into runs where a periodic side cuts it. Runs keep the order of the
// stencil, on which the rounding of sums depends.
std::size_t TouchedRows::runs_along_x(const CellBox& box, const Stencil1D& sx,
                                      Runs& runs) const {
    std::size_t pieces = 0;
    for (int i = 0; i < sx.count; ++i) {
        const int x = from_box(box, sx.first + i, 0);
        if (x < box.lo[0] || x >= box.hi[0]) continue;
        if (pieces > 0 && x == runs[pieces - 1].x + runs[pieces - 1].cells) {
            ++runs[pieces - 1].cells;
        } else {
            runs[pieces++] = {x, 1, sx.weight.data() + i};
        }
    }
    return pieces;
}

void TouchedRows::widen(const Part& part, int y, int z, int x_begin, int x_end) {
    const int slot = part.slot(y, z);
    int& row = row_of_[slot];
    if (row < 0) {
        row = rows_.size();
        rows_.push_back({y, z, x_begin, x_end});
        slot_of_.push_back(slot);
        return;
    }
    GridRow& r = rows_[row];
    if (x_begin < r.x_begin) r.x_begin = x_begin;
    if (x_end > r.x_end) r.x_end = x_end;
}

void TouchedRows::widen_by(std::size_t marker) {
    if (plain_[marker]) {
        // Consecutive markers often touch the same cells.
        if (marker > 0 && plain_[marker - 1] &&
            same_cells(stencils_[marker], stencils_[marker - 1]))
            return;
        return widen_plain(marker);
    }
    for_each_run(marker, [&](int at, const Run& run, double) {
        const Part& mine = part(marker);
        const int ny = mine.box.hi[1] - mine.box.lo[1], in_box = at - mine.first_slot;
        widen(mine, mine.box.lo[1] + in_box % ny, mine.box.lo[2] + in_box / ny, run.x,
              run.x + run.cells);
    });
}

void TouchedRows::widen_plain(std::size_t marker) {
    const auto& [sx, sy, sz] = stencils_[marker];
    const Part& mine = part(marker);
    for (int z = sz.first; z < sz.first + sz.count; ++z) {
        for (int y = sy.first; y < sy.first + sy.count; ++y)
            widen(mine, y, z, sx.first, sx.first + sx.count);
    }
}

template <bool BesideSolid>
void TouchedRows::place_each() {
    for (std::size_t m = 0; m < points_m_.size(); ++m) {
        set_stencil(stencils_[m], *grid_, kernel_, points_m_[m]);
        part_of_[m] = part_of(stencils_[m]);
        plain_[m] = is_plain(m);
        if constexpr (BesideSolid) {
            share_[m] = solid_.fluid_share(stencils_[m]);
            plain_[m] = plain_[m] && share_[m] == 1;
        }
        widen_by(m);
    }
}

bool TouchedRows::is_plain(std::size_t marker) const {
    if (part_of_[marker] == no_part) return false;
    const CellBox& box = part(marker).box;
    for (std::size_t d = 0; d < 3; ++d) {
        const Stencil1D& s = stencils_[marker][d];
        if (s.count != support(kernel_) || s.first < box.lo[d] ||
            s.first + s.count > box.hi[d])
            return false;
    }
    return true;
}

void TouchedRows::place(std::span<const Vec3> points_m) {
    for (const int slot : slot_of_) row_of_[slot] = -1;
    rows_.clear();
    slot_of_.clear();
    points_m_.assign(points_m.begin(), points_m.end());
    stencils_.resize(points_m.size());
    share_.resize(points_m.size(), 1);
    plain_.resize(points_m.size());
    part_of_.resize(points_m.size());
    if (solid_.any())
        place_each<true>();
    else
        place_each<false>();
    origin_.clear();
    cells_ = 0;
    for (const GridRow& r : rows_) {
        origin_.push_back(static_cast<std::ptrdiff_t>(cells_) - r.x_begin);
        cells_ += r.x_end - r.x_begin;
    }
}

bool TouchedRows::placed_at(std::span<const Vec3> points_m) const {
    return std::ranges::equal(points_m_, points_m);
}

std::size_t TouchedRows::first_value(int at, int x) const {
    const std::size_t row = row_of_[at];
    return 3 * (origin_[row] + x);
}

// Calls use with the kernel's support as a compile-time constant: loops of constant
// length become a few vector instructions.
template <typename Use>
void TouchedRows::with_support(Use&& use) const {
    switch (kernel_) {
        case Kernel::two_point:
            return use(std::integral_constant<int, 2>());
        case Kernel::three_point:
            return use(std::integral_constant<int, 3>());
        case Kernel::four_point:
            return use(std::integral_constant<int, 4>());
    }
}

// Interpolation for a plain marker: sums over y and z first, with all cells and
// components along x side by side, so that the inner loop vectorises.
template <int Cells>
Vec3 TouchedRows::read_plain(std::size_t marker, const double* velocity) const {
    const auto& [sx, sy, sz] = stencils_[marker];
    const Part& mine = part(marker);
    std::array<double, 3 * Cells> line{};
    for (std::size_t k = 0; k < Cells; ++k) {
        const int first = mine.slot(sy.first, sz.first + static_cast<int>(k));
        for (std::size_t j = 0; j < Cells; ++j) {
            const double weight = sy.weight[j] * sz.weight[k];
            const double* u =
                velocity + first_value(first + static_cast<int>(j), sx.first);
            for (std::size_t i = 0; i < line.size(); ++i) line[i] += weight * u[i];
        }
    }
    Vec3 sum{};
    for (std::size_t i = 0; i < line.size(); ++i)
        sum[i % 3] += sx.weight[i / 3] * line[i];
    return sum;
}

// Spreading for a plain marker, the transpose of read_plain.
template <int Cells>
void TouchedRows::add_plain(std::size_t marker, const Vec3& force,
                            double* density) const {
    const auto& [sx, sy, sz] = stencils_[marker];
    const Part& mine = part(marker);
    std::array<double, 3 * Cells> line;
    for (std::size_t i = 0; i < line.size(); ++i)
        line[i] = sx.weight[i / 3] * force[i % 3];
    for (std::size_t k = 0; k < Cells; ++k) {
        const int first = mine.slot(sy.first, sz.first + static_cast<int>(k));
        for (std::size_t j = 0; j < Cells; ++j) {
            const double weight = sy.weight[j] * sz.weight[k];
            double* f = density + first_value(first + static_cast<int>(j), sx.first);
            for (std::size_t i = 0; i < line.size(); ++i) f[i] += weight * line[i];
        }
    }
}

void TouchedRows::interpolate(std::span<const double> velocity,
                              std::span<Vec3> markers) const {
    with_support([&](auto cells) {
        for (std::size_t m = 0; m < stencils_.size(); ++m) {
            if (plain_[m]) {
                markers[m] = read_plain<cells()>(m, velocity.data());
                continue;
            }
            Vec3 sum{};
            for_each_run(m, [&](int at, const Run& run, double wyz) {
                const double* u = velocity.data() + first_value(at, run.x);
                for (int i = 0; i < run.cells; ++i, u += 3) {
                    const double weight = wyz * run.weight[i];
                    for (std::size_t d = 0; d < 3; ++d) sum[d] += weight * u[d];
                }
            });
            markers[m] = sum;
        }
    });
}

// A force density is the force over the volume of a cell; each marker's weights add up to
// 1.
void TouchedRows::spread(std::span<const Vec3> impulse, double duration_s,
                         std::span<double> density) const {
    const double per_volume =
        1 / (grid_->spacing_m * grid_->spacing_m * grid_->spacing_m);
    with_support([&](auto cells) {
        for (std::size_t m = 0; m < stencils_.size(); ++m) {
            const Vec3 force = impulse[m] / duration_s * per_volume;
            if (plain_[m]) {
                add_plain<cells()>(m, force, density.data());
                continue;
            }
            for_each_run(m, [&](int at, const Run& run, double wyz) {
                double* f = density.data() + first_value(at, run.x);
                for (int i = 0; i < run.cells; ++i, f += 3) {
                    const double weight = wyz * run.weight[i];
                    for (std::size_t d = 0; d < 3; ++d) f[d] += weight * force[d];
                }
            });
        }
    });
}

}  // namespace magfsi::coupler
