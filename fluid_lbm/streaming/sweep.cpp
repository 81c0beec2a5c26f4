// SPDX-License-Identifier: GPL-2.0-or-later
#include "fluid_lbm/streaming/sweep.h"

#include <cmath>

namespace magfsi::fluid {

namespace {

// Pointers of row after row. Away from the box's sides they differ by a shift only, so
// that one shifted pattern serves all inner rows: computing each from the layout took 5 %
// of a step in float.
template <class Real>
class RowWalk {
  public:
    explicit RowWalk(const View& now)
        : rows_(now.populations.rows<Real>()),
          layout_(now.layout),
          arrangement_(now.arrangement),
          row_stride_(now.populations.row_stride()),
          pattern_row_(now.layout.row(1, 1)) {
        if (layout_.ny > 2 && layout_.nz > 2) {
            pattern_ = pointers(rows_, layout_, arrangement_, 1, 1);
        }
    }

    RowPointers<Real> at(int y, int z) const {
        const bool inner = y > 0 && y < layout_.ny - 1 && z > 0 && z < layout_.nz - 1;
        if (!inner) return pointers(rows_, layout_, arrangement_, y, z);
        const std::ptrdiff_t shift = (layout_.row(y, z) - pattern_row_) * row_stride_;
        RowPointers<Real> p = pattern_;
        for (int q = 0; q < d3q19::directions; ++q) {
            p.at[q] += shift;
            p.own[q] += shift;
        }
        return p;
    }

  private:
    PopulationRows<Real> rows_;
    const RowLayout& layout_;
    Arrangement arrangement_;
    std::ptrdiff_t row_stride_;
    int pattern_row_;
    RowPointers<Real> pattern_{};
};

// The first cell of a row that fails the check, or the fastest cell, should rounding hide
// the failure. It is computed from the populations that the collision left: the collision
// has kept the density and added the force to the momentum.
template <class Real>
InvalidCell find_invalid(const RowPointers<Real>& p, const ForcePointers<Real>& force,
                         int length, MomentsKernel<Real> moments, int y, int z) {
    std::vector<double> values(4 * static_cast<std::size_t>(length));
    double* const out[4] = {&values[0], &values[length], &values[2 * length],
                            &values[3 * length]};
    const Real* outgoing[d3q19::directions];
    for (int q = 0; q < d3q19::directions; ++q) outgoing[q] = p.at[d3q19::opposite(q)];
    moments(outgoing, length, out);
    InvalidCell worst;
    for (int x = 0; x < length; ++x) {
        InvalidCell cell{z, y, x, 1 + out[0][x], 0, 0};
        for (int a = 0; a < 3; ++a) {
            const double local = force.at[a] != nullptr ? force.at[a][x] : 0;
            const double u = (out[1 + a][x] - 0.5 * local) / cell.density;
            cell.speed += u * u;
            cell.force += local * local;
        }
        cell.speed = std::sqrt(cell.speed);
        cell.force = std::sqrt(cell.force);
        if (!is_valid(cell.density, cell.speed)) return cell;
        if (x == 0 || cell.speed > worst.speed) worst = cell;
    }
    return worst;
}

// Keeps the earlier of two invalid cells.
void keep_first(std::optional<InvalidCell>& kept, const InvalidCell& found) {
    if (!kept || found.before(*kept)) kept = found;
}

// Stands in place of ForcedRows where no row has a force.
struct NoForces {};

template <class Real>
ForcePointers<Real> force_of(NoForces, int, int) {
    return {};
}

template <class Real>
ForcePointers<Real> force_of(const ForcedRows& forces, int y, int z) {
    return forces.row<Real>(y, z);
}

// Input that the rows of one step share. Forces: ForcedRows or NoForces.
template <class Forces, class Real>
struct SweepRows {
    const View& now;
    const RowKernels<Real>& kernels;
    const Forces& forces;
    bool x_ends = true;
    RowWalk<Real> walk{now};

    // Collides and streams one row, ends included.
    std::optional<InvalidCell> step_row(int y, int z) const {
        const RowLayout& layout = now.layout;
        const bool swapped = now.arrangement == Arrangement::swapped;
        const RowPointers<Real> p = walk.at(y, z);
        const auto force = force_of<Real>(forces, y, z);
        const auto kernel = force.at[0] != nullptr ? kernels.forced : kernels.plain;
        if (swapped && x_ends) {
            prefetch_x_ends(p, layout, now.populations.row_stride());
            open_x_ends(p, layout);
        } else if (swapped) {
            rest_x_ends(p, layout);
        }
        const bool valid = kernel(p.at, force.at, layout.nx, now.parameters);
        std::optional<InvalidCell> invalid;
        if (!valid) invalid = find_invalid(p, force, layout.nx, kernels.moments, y, z);
        if (swapped && x_ends) close_x_ends(p, layout);
        return invalid;
    }

    std::optional<InvalidCell> step(const RowBox& box) const {
        const int count = box.size(), length = box.y_end - box.y_begin;
        std::optional<InvalidCell> first;
#pragma omp parallel
        {
            std::optional<InvalidCell> mine;
#pragma omp for schedule(static)
            for (int i = 0; i < count; ++i) {
                const auto found =
                    step_row(box.y_begin + i % length, box.z_begin + i / length);
                if (found) keep_first(mine, *found);
            }
#pragma omp critical
            if (mine) keep_first(first, *mine);
        }
        return first;
    }
};

}  // namespace

std::optional<InvalidCell> sweep(const View& now, const ForcedRows* forces,
                                 const RowBox& box, bool x_ends) {
    return std::visit(
        [&]<class Real>(const RowKernels<Real>& kernels) {
            if (forces) {
                return SweepRows<ForcedRows, Real>{now, kernels, *forces, x_ends}.step(
                    box);
            }
            return SweepRows<NoForces, Real>{now, kernels, {}, x_ends}.step(box);
        },
        now.kernels);
}

}  // namespace magfsi::fluid
