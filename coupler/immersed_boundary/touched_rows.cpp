#include "coupler/immersed_boundary/touched_rows.h"

#include <algorithm>

namespace magfsi::coupler {

TouchedRows::TouchedRows(const Grid& grid, const CellBox& box, Kernel kernel)
    : grid_(&grid), box_(box), kernel_(kernel), solid_(grid) {
    const auto rows = static_cast<std::size_t>(box.hi[1] - box.lo[1]) *
                      static_cast<std::size_t>(box.hi[2] - box.lo[2]);
    row_of_.assign(rows, -1);
}

int TouchedRows::slot(int y, int z) const {
    return (z - box_.lo[2]) * (box_.hi[1] - box_.lo[1]) + (y - box_.lo[1]);
}

// Visits the marker's cells that this rank owns and that hold fluid, as runs along x that
// do not wrap: (row, first x, cells, their weights along x, the weight along y and z).
template <typename Visit>
void TouchedRows::for_each_run(std::size_t marker, Visit&& visit) const {
    const auto& [sx, sy, sz] = stencils_[marker];
    const double share = share_[marker];
    if (share == 0) return;
    Runs runs;
    const std::size_t pieces = runs_along_x(sx, runs);
    for (int k = 0; k < sz.count; ++k) {
        const int z = wrapped(sz.first + k, grid_->cells[2]);
        if (z < box_.lo[2] || z >= box_.hi[2]) continue;
        for (int j = 0; j < sy.count; ++j) {
            const int y = wrapped(sy.first + j, grid_->cells[1]);
            if (y < box_.lo[1] || y >= box_.hi[1]) continue;
            const double wyz = sy.weight[static_cast<std::size_t>(j)] *
                               sz.weight[static_cast<std::size_t>(k)] / share;
            for (std::size_t p = 0; p < pieces; ++p) {
                if (share == 1) {
                    visit(slot(y, z), runs[p], wyz);
                    continue;
                }
                without_solid(y, z, runs[p],
                              [&](const Run& part) { visit(slot(y, z), part, wyz); });
            }
        }
    }
}

template <typename Visit>
void TouchedRows::without_solid(int y, int z, const Run& run, Visit&& visit) const {
    for (int i = 0; i < run.cells;) {
        int end = i;
        while (end < run.cells && !solid_.at(run.x + end, y, z)) ++end;
        if (end > i) visit(Run{run.x + i, end - i, run.weight + i});
        i = end + 1;
    }
}

// A periodic side cuts a stencil; in what order they come decides about rounding.
std::size_t TouchedRows::runs_along_x(const Stencil1D& sx, Runs& runs) const {
    std::size_t pieces = 0;
    for (int i = 0; i < sx.count; ++i) {
        const int x = wrapped(sx.first + i, grid_->cells[0]);
        if (x < box_.lo[0] || x >= box_.hi[0]) continue;
        if (pieces > 0 && x == runs[pieces - 1].x + runs[pieces - 1].cells) {
            ++runs[pieces - 1].cells;
        } else {
            runs[pieces++] = {x, 1, sx.weight.data() + i};
        }
    }
    return pieces;
}

void TouchedRows::widen(int y, int z, int x_begin, int x_end) {
    int& row = row_of_[static_cast<std::size_t>(slot(y, z))];
    if (row < 0) {
        row = static_cast<int>(rows_.size());
        rows_.push_back({y, z, x_begin, x_end});
        return;
    }
    GridRow& r = rows_[static_cast<std::size_t>(row)];
    r.x_begin = std::min(r.x_begin, x_begin);
    r.x_end = std::max(r.x_end, x_end);
}

void TouchedRows::place(std::span<const Vec3> points_m) {
    for (const GridRow& r : rows_) row_of_[static_cast<std::size_t>(slot(r.y, r.z))] = -1;
    rows_.clear();
    stencils_.clear();
    points_m_.assign(points_m.begin(), points_m.end());
    const int ny = box_.hi[1] - box_.lo[1];
    share_.clear();
    for (const Vec3& point : points_m) {
        stencils_.push_back(marker_stencil(*grid_, kernel_, point));
        share_.push_back(solid_.fluid_share(stencils_.back()));
        for_each_run(stencils_.size() - 1, [&](int at, const Run& run, double) {
            widen(box_.lo[1] + at % ny, box_.lo[2] + at / ny, run.x, run.x + run.cells);
        });
    }
    offset_.clear();
    cells_ = 0;
    for (const GridRow& r : rows_) {
        offset_.push_back(cells_);
        cells_ += static_cast<std::size_t>(r.x_end - r.x_begin);
    }
}

bool TouchedRows::placed_at(std::span<const Vec3> points_m) const {
    return std::ranges::equal(points_m_, points_m);
}

std::size_t TouchedRows::first_value(int at, int x) const {
    const auto row = static_cast<std::size_t>(row_of_[static_cast<std::size_t>(at)]);
    return 3 * (offset_[row] + static_cast<std::size_t>(x - rows_[row].x_begin));
}

void TouchedRows::interpolate(std::span<const double> velocity,
                              std::span<Vec3> markers) const {
    for (std::size_t m = 0; m < stencils_.size(); ++m) {
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
}

void TouchedRows::spread(std::span<const Vec3> force_n, std::span<double> density) const {
    const double per_volume =
        1 / (grid_->spacing_m * grid_->spacing_m * grid_->spacing_m);
    for (std::size_t m = 0; m < stencils_.size(); ++m) {
        for_each_run(m, [&](int at, const Run& run, double wyz) {
            double* f = density.data() + first_value(at, run.x);
            for (int i = 0; i < run.cells; ++i, f += 3) {
                const double weight = wyz * run.weight[i] * per_volume;
                for (std::size_t d = 0; d < 3; ++d) f[d] += weight * force_n[m][d];
            }
        });
    }
}

void TouchedRows::add_shared(const TouchedRows& other, std::span<const double> values,
                             double factor, std::span<double> to) const {
    for (std::size_t r = 0; r < rows_.size(); ++r) {
        const GridRow& mine = rows_[r];
        const int at = other.row_of_[static_cast<std::size_t>(slot(mine.y, mine.z))];
        if (at < 0) continue;
        const auto o = static_cast<std::size_t>(at);
        const GridRow& theirs = other.rows_[o];
        const int end = std::min(mine.x_end, theirs.x_end);
        for (int x = std::max(mine.x_begin, theirs.x_begin); x < end; ++x) {
            const auto cell = offset_[r] + static_cast<std::size_t>(x - mine.x_begin);
            const auto from =
                other.offset_[o] + static_cast<std::size_t>(x - theirs.x_begin);
            for (std::size_t d = 0; d < 3; ++d)
                to[3 * cell + d] += factor * values[3 * from + d];
        }
    }
}

}  // namespace magfsi::coupler
