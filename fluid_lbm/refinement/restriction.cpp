// SPDX-License-Identifier: GPL-2.0-or-later
#include "fluid_lbm/refinement/restriction.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace magfsi::fluid {

namespace {

constexpr std::size_t cell_numbers = numbers_between_levels;

// Weights of a coarse cell among the fine ones that the level solves.
Weights fine_in(int coarse_cell, const LevelPlace& fine, int axis) {
    const bool wraps = fine.period[axis] > 0;
    const int lo = wraps ? -cubic_points : fine.inside.lo[axis];
    const int hi = wraps ? fine.domain[axis] + cubic_points : fine.inside.hi[axis];
    return cubic_at(2 * coarse_cell + 0.5, lo, hi);
}

// The coarse cells of a box that the rank with these fine cells averages.
CellBox share_of(const CellBox& box, const CellBox& owned) {
    CellBox share = box;
    if (is_empty(owned)) return {};
    for (int d = 1; d < 3; ++d) {
        share.lo[d] = std::max(box.lo[d], (owned.lo[d] + 1) / 2);
        share.hi[d] = std::min(box.hi[d], (owned.hi[d] + 1) / 2);
    }
    return is_empty(share) ? CellBox{} : share;
}

// The fine cells that a share is made of; along x only as far as they are stored.
CellBox fine_beneath(const CellBox& share, const LevelPlace& place) {
    CellBox box;
    if (is_empty(share)) return {};
    for (int d = 0; d < 3; ++d) {
        box.lo[d] = fine_in(share.lo[d], place, d).first;
        box.hi[d] = fine_in(share.hi[d] - 1, place, d).first + cubic_points;
    }
    box.lo[0] = std::max(box.lo[0], place.stored.lo[0]);
    box.hi[0] = std::min(box.hi[0], place.stored.hi[0]);
    return box;
}

// The shares of each rank, box by box; halos_of: the fine cells that these need from
// others.
std::vector<std::vector<CellBox>> shares_of(const Level& fine,
                                            const std::vector<CellBox>& boxes) {
    std::vector<std::vector<CellBox>> shares;
    for (const CellBox& owned : fine.owned_by_rank()) {
        shares.emplace_back();
        for (const CellBox& box : boxes) shares.back().push_back(share_of(box, owned));
    }
    return shares;
}

std::vector<std::vector<CellBox>> halos_of(const Level& fine,
                                           const std::vector<CellBox>& boxes) {
    std::vector<std::vector<CellBox>> halos;
    for (const CellBox& owned : fine.owned_by_rank()) {
        halos.emplace_back();
        for (const CellBox& box : boxes) {
            for (const CellBox& halo :
                 without(fine_beneath(share_of(box, owned), fine.place), owned))
                halos.back().push_back(halo);
        }
    }
    return halos;
}

// Loops with this mark are compiled for AVX2, too; the processor decides at the start.
#define MAGFSI_ROW_LOOP __attribute__((target_clones("avx2", "default")))

MAGFSI_ROW_LOOP void combine_four(const std::array<double, cubic_points>& w,
                                  const std::array<const double*, cubic_points>& rows,
                                  std::size_t count, double* sum) {
    const double *a = rows[0], *b = rows[1], *c = rows[2], *d = rows[3];
    for (std::size_t i = 0; i < count; ++i)
        sum[i] = (w[0] * a[i] + w[1] * b[i]) + (w[2] * c[i] + w[3] * d[i]);
}

MAGFSI_ROW_LOOP void mean_of_two(const double* a, const double* b, std::size_t count,
                                 double* mean) {
    for (std::size_t i = 0; i < count; ++i) mean[i] = 0.5 * (a[i] + b[i]);
}

// The same along a row; `fine` begins at the first fine cell of the first average.
MAGFSI_ROW_LOOP void combine_along(const std::array<double, cubic_points>& w,
                                   const double* fine, std::size_t count, double* sum) {
    for (std::size_t i = 0; i < count; ++i)
        sum[i] = (w[0] * fine[2 * i] + w[1] * fine[2 * i + 1]) +
                 (w[2] * fine[2 * i + 2] + w[3] * fine[2 * i + 3]);
}

MAGFSI_ROW_LOOP void mean_along(const double* fine, std::size_t count, double* mean) {
    for (std::size_t i = 0; i < count; ++i)
        mean[i] = 0.5 * (fine[2 * i] + fine[2 * i + 1]);
}

// Combines rows or planes of ten numbers each of `cells` cells: density and velocity by
// the four around a coarse cell, the stress, if there is any, by the two inside it.
void combine(const Weights& w, int coarse, std::size_t cells,
             const std::array<const double*, cubic_points>& from, bool with_stress,
             double* to) {
    const std::size_t first = 2 * coarse - w.first;
    combine_four(w.of, from, first_stress * cells, to);
    if (!with_stress) return;
    const std::size_t stress = first_stress * cells;
    mean_of_two(from[first] + stress, from[first + 1] + stress,
                (cell_numbers - first_stress) * cells, to + stress);
}

std::size_t length(const CellBox& box, int axis) {
    return box.hi[axis] - box.lo[axis];
}

}  // namespace

namespace {

// Writes the cells of a row whose density is not NaN (see CutCell).
void write_where_known(const View& view, const CellRow& row, const double* flow) {
    const std::size_t count = row.size();
    std::vector<double> known;
    for (std::size_t begin = 0; begin < count;) {
        std::size_t end = begin;
        while (end < count && !std::isnan(flow[end])) ++end;
        known.clear();
        for (std::size_t i = 0; i < cell_numbers && begin < end; ++i)
            known.insert(known.end(), flow + i * count + begin, flow + i * count + end);
        if (begin < end)
            write_flow(view,
                       {row.y, row.z, row.x_begin + static_cast<int>(begin),
                        row.x_begin + static_cast<int>(end)},
                       known.data());
        begin = std::max(end, begin + 1);
    }
}

}  // namespace

std::vector<CellBox> band_of(const LevelPlace& fine) {
    const CellBox covered = fine.covered();
    CellBox core = covered;
    for (int d = 0; d < 3; ++d) {
        core.lo[d] += fine.stored.lo[d] < fine.inside.lo[d] ? band_cells : 0;
        core.hi[d] -= fine.stored.hi[d] > fine.inside.hi[d] ? band_cells : 0;
    }
    return is_empty(core) ? std::vector{covered} : without(covered, core);
}

Restriction::Piece::Piece(const CellBox& share, const Level& level)
    : coarse(share),
      fine(fine_beneath(share, level.place)),
      flow(cell_numbers * cells_of(share)) {
    for (int x = coarse.lo[0]; x < coarse.hi[0]; ++x)
        along.push_back(fine_in(x, level.place, 0));
}

Restriction::Restriction(const Level& coarse, const Level& fine,
                         const std::vector<CellBox>& boxes)
    : to_halo_(coarse.comm(), one_each(fine.owned_by_rank()), fine.place.period,
               halos_of(fine, boxes)),
      to_coarse_(coarse.comm(), shares_of(fine, boxes), coarse.place.period,
                 one_each(coarse.owned_by_rank())) {
    for (const CellBox& box : boxes) {
        pieces_.emplace_back(share_of(box, fine.owned()), fine);
        pieces_.back().find_cut(fine);
        for (const CellBox& halo : without(pieces_.back().fine, fine.owned())) {
            halo_.push_back(halo);
            of_piece_.push_back(pieces_.size() - 1);
            halo_flow_.emplace_back(cell_numbers *
                                    static_cast<std::size_t>(cells_of(halo)));
        }
    }
}

void Restriction::Piece::find_cut(const Level& level) {
    const auto map = level.solids_in(fine);
    if (!map) return;
    const auto solid = [&](int x, int y, int z) {
        return map->solid({x - fine.lo[0], y - fine.lo[1], z - fine.lo[2]});
    };
    for_each_cell(coarse, [&](const Cell& c) {
        CellBox read;
        for (int d = 0; d < 3; ++d) {
            read.lo[d] = std::max(fine_in(c[d], level.place, d).first, fine.lo[d]);
            read.hi[d] = std::min(read.lo[d] + cubic_points, fine.hi[d]);
        }
        bool is_cut = false;
        for_each_cell(read,
                      [&](const Cell& f) { is_cut = is_cut || solid(f[0], f[1], f[2]); });
        if (!is_cut) return;
        CutCell cell{c, {}};
        for (std::size_t i = 0; i < 8; ++i) {
            const int k = i;
            cell.counts[i] =
                !solid(2 * c[0] + k % 2, 2 * c[1] + k / 2 % 2, 2 * c[2] + k / 4);
        }
        cut.push_back(cell);
    });
}

bool Restriction::Piece::has_within(int axis, int place) const {
    return place >= 2 * coarse.lo[axis] && place < 2 * coarse.hi[axis];
}

void Restriction::average_cut(Piece& piece, std::size_t number, const Level& fine) {
    const std::size_t width = length(piece.coarse, 0), row_width = length(piece.fine, 0);
    for (const CutCell& cut : piece.cut) {
        std::array<double, cell_numbers> sum{};
        int cells = 0;
        for (std::size_t i = 0; i < 8; ++i) {
            if (!cut.counts[i]) continue;
            const int k = i;
            const double* row = fine_row(piece, number, fine, 2 * cut.cell[1] + k / 2 % 2,
                                         2 * cut.cell[2] + k / 4, row_.data());
            const std::size_t x = 2 * cut.cell[0] + k % 2 - piece.fine.lo[0];
            for (std::size_t n = 0; n < cell_numbers; ++n)
                sum[n] += row[n * row_width + x];
            ++cells;
        }
        const auto at = [&](int d) {
            return static_cast<std::size_t>(cut.cell[d] - piece.coarse.lo[d]);
        };
        double* to = piece.flow.data() +
                     (at(2) * length(piece.coarse, 1) + at(1)) * cell_numbers * width +
                     at(0);
        for (std::size_t n = 0; n < cell_numbers; ++n)
            to[n * width] =
                cells > 0 ? sum[n] / cells : std::numeric_limits<double>::quiet_NaN();
    }
}

const double* Restriction::fine_row(const Piece& piece, std::size_t number,
                                    const Level& fine, int y, int z, double* room) {
    const std::size_t count = length(piece.fine, 0);
    for (std::size_t b = 0; b < halo_.size(); ++b) {
        const CellBox& box = halo_[b];
        if (of_piece_[b] != number) continue;
        if (y < box.lo[1] || y >= box.hi[1] || z < box.lo[2] || z >= box.hi[2]) continue;
        const std::size_t row = (z - box.lo[2]) * (box.hi[1] - box.lo[1]) + y - box.lo[1];
        return halo_flow_[b].data() + row * cell_numbers * count;
    }
    std::array<double*, flow_numbers> flow{};
    const std::size_t wanted =
        piece.has_within(1, y) && piece.has_within(2, z) ? cell_numbers : first_stress;
    for (std::size_t i = 0; i < wanted; ++i) flow[i] = room + i * count;
    read_flow(fine.state().view(), fine.local({y, z, piece.fine.lo[0], piece.fine.hi[0]}),
              flow);
    return room;
}

void Restriction::average_along_x(const Piece& piece, const double* row,
                                  double* to) const {
    const std::size_t width = length(piece.fine, 0), count = length(piece.coarse, 0);
    const int lo = piece.fine.lo[0], hi = piece.fine.hi[0];
    const auto cell = [&](int fine_x) {  // around the axis where it is periodic
        const int n = hi - lo;
        return static_cast<std::size_t>((fine_x - lo + n) % n);
    };
    // Cells in the middle whose four points lie in the row and have the same weights.
    std::size_t begin = 0, end = count;
    const auto is_regular = [&](std::size_t i) {
        const int first = piece.along[i].first;
        return first >= lo && first + cubic_points <= hi &&
               first == 2 * (piece.coarse.lo[0] + static_cast<int>(i)) - 1;
    };
    while (begin < count && !is_regular(begin)) ++begin;
    while (end > begin && !is_regular(end - 1)) --end;
    for (std::size_t i = 0; i < cell_numbers; ++i, row += width, to += count) {
        const auto one = [&](std::size_t x) {
            const Weights& w = piece.along[x];
            const int two = 2 * (piece.coarse.lo[0] + static_cast<int>(x));
            to[x] =
                i < first_stress
                    ? (w.of[0] * row[cell(w.first)] + w.of[1] * row[cell(w.first + 1)]) +
                          (w.of[2] * row[cell(w.first + 2)] +
                           w.of[3] * row[cell(w.first + 3)])
                    : 0.5 * (row[cell(two)] + row[cell(two + 1)]);
        };
        for (std::size_t x = 0; x < begin; ++x) one(x);
        if (begin < end) {
            const double* first = row + (piece.along[begin].first - lo);
            if (i < first_stress)
                combine_along(piece.along[begin].of, first, end - begin, to + begin);
            else
                mean_along(first + 1, end - begin, to + begin);
        }
        for (std::size_t x = end; x < count; ++x) one(x);
    }
}

// Averages along y, then z, then x. Each fine row is read once, and coarse rows are made
// as soon as the last fine row of theirs is there. Steps across rows run in whole
// vectors; the step along rows, which does not, comes last, when the fewest cells are
// left.
void Restriction::average(Piece& piece, std::size_t number, const Level& fine) {
    if (is_empty(piece.coarse)) return;
    const CellBox &c = piece.coarse, &f = piece.fine;
    const std::size_t cells = length(f, 0), row_size = cell_numbers * cells;
    const std::size_t plane_size = row_size * length(c, 1);
    row_.resize(row_size);
    rows_.resize(row_size * length(f, 1));
    std::vector<const double*> row_at(length(f, 1));
    for (auto& plane : planes_) plane.resize(plane_size);
    int next = c.lo[2];  // coarse plane
    double* to = piece.flow.data();
    std::vector<Weights> across;
    for (int y = c.lo[1]; y < c.hi[1]; ++y) across.push_back(fine_in(y, fine.place, 1));
    for (int z = f.lo[2]; z < f.hi[2]; ++z) {
        for (std::size_t j = 0; j < row_at.size(); ++j)
            row_at[j] = fine_row(piece, number, fine, f.lo[1] + static_cast<int>(j), z,
                                 rows_.data() + j * row_size);
        auto& plane = planes_[static_cast<std::size_t>(z - f.lo[2]) % cubic_points];
        for (std::size_t j = 0; j < across.size(); ++j) {
            const double* const* first = &row_at[across[j].first - f.lo[1]];
            combine(across[j], c.lo[1] + static_cast<int>(j), cells,
                    {first[0], first[1], first[2], first[3]}, piece.has_within(2, z),
                    plane.data() + j * row_size);
        }
        // In a patch that is four fine cells long, two coarse planes use the same four.
        for (; next < c.hi[2]; ++next) {
            const Weights w = fine_in(next, fine.place, 2);
            if (z + 1 < w.first + cubic_points) break;
            std::array<const double*, cubic_points> from;
            for (std::size_t j = 0; j < across.size(); ++j) {
                for (int k = 0; k < cubic_points; ++k)
                    from[k] = planes_[static_cast<std::size_t>(w.first + k - f.lo[2]) %
                                      cubic_points]
                                  .data() +
                              j * row_size;
                combine(w, next, cells, from, true, row_.data());
                average_along_x(piece, row_.data(), to);
                to += cell_numbers * length(c, 0);
            }
        }
    }
}

void Restriction::run(Level& coarse, const Level& fine) {
    const View fine_view = fine.state().view();
    to_halo_.run(
        cell_numbers,
        [&](std::size_t, const CellRow& row, double* flow) {
            read_flow(fine_view, fine.local(row), flow);
        },
        [&](std::size_t b, const CellRow& row, const double* flow) {
            const CellBox& box = halo_[b];
            const std::size_t at =
                (row.z - box.lo[2]) * (box.hi[1] - box.lo[1]) + row.y - box.lo[1];
            const std::size_t count = cell_numbers * row.size();
            std::copy_n(flow, count, halo_flow_[b].data() + at * count);
        });
    for (std::size_t i = 0; i < pieces_.size(); ++i) {
        average(pieces_[i], i, fine);
        average_cut(pieces_[i], i, fine);
    }
    const Scales scales = to_fine(coarse, fine);
    const View view = coarse.state().view();
    to_coarse_.run(
        cell_numbers,
        [&](std::size_t box, const CellRow& row, double* flow) {
            const Piece& piece = pieces_[box];
            const std::size_t width = length(piece.coarse, 0);
            const auto r = static_cast<std::size_t>(row.z - piece.coarse.lo[2]) *
                               length(piece.coarse, 1) +
                           static_cast<std::size_t>(row.y - piece.coarse.lo[1]);
            const std::size_t count = row.size();
            const double* from =
                piece.flow.data() + r * cell_numbers * width +
                static_cast<std::size_t>(row.x_begin - piece.coarse.lo[0]);
            for (std::size_t i = 0; i < cell_numbers; ++i)
                std::copy_n(from + i * width, count, flow + i * count);
            apply(scales, -1, flow, count);
        },
        [&](std::size_t, const CellRow& row, const double* flow) {
            if (coarse.solids.empty())
                write_flow(view, coarse.local(row), flow);
            else
                write_where_known(view, coarse.local(row), flow);
        });
    coarse.reset_solid_cells();
}

}  // namespace magfsi::fluid
