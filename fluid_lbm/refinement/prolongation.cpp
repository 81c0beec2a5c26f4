#include "fluid_lbm/refinement/prolongation.h"

#include <algorithm>
#include <tuple>

#include "fluid_lbm/refinement/interlevel.h"

namespace magfsi::fluid {

namespace {

constexpr int points = cubic_points;
constexpr std::size_t numbers = numbers_between_levels;

// The coarse cells that a level's cubic may read along an axis: what the level solves,
// unless the axis is periodic.
struct Range {
    int lo, hi;
};
Range readable(const LevelPlace& place, int axis) {
    constexpr int anywhere = 1 << 28;
    if (place.period[axis] > 0) return {-anywhere, anywhere};
    return {place.inside.lo[axis], place.inside.hi[axis]};
}

// Of a fine cell, among the coarse ones: centres of cells lie at whole numbers.
Weights coarse_around(int fine_cell, const LevelPlace& coarse, int axis) {
    const Range range = readable(coarse, axis);
    return cubic_at((2 * fine_cell - 1) / 4.0, range.lo, range.hi);
}

CellBox coarse_beneath(const CellBox& fine, const LevelPlace& coarse) {
    CellBox box;
    for (int d = 0; d < 3; ++d) {
        box.lo[d] = coarse_around(fine.lo[d], coarse, d).first;
        box.hi[d] = coarse_around(fine.hi[d] - 1, coarse, d).first + points;
    }
    return box;
}

std::vector<std::vector<CellBox>> coarse_beneath(
    const std::vector<std::vector<CellBox>>& of_ranks, const LevelPlace& coarse) {
    std::vector<std::vector<CellBox>> beneath(of_ranks.size());
    for (std::size_t r = 0; r < of_ranks.size(); ++r) {
        for (const CellBox& box : of_ranks[r])
            beneath[r].push_back(coarse_beneath(box, coarse));
    }
    return beneath;
}

int rank_of(MPI_Comm comm) {
    int rank = 0;
    MPI_Comm_rank(comm, &rank);
    return rank;
}

// The loops below are compiled for AVX2, too, and chosen when the program starts.
#define MAGFSI_ROW_LOOP __attribute__((target_clones("avx2", "default")))

// Of four rows that lie `apart` from each other.
MAGFSI_ROW_LOOP void combine(const std::array<double, points>& w, const double* rows,
                             std::size_t apart, std::size_t count, double* sum) {
    const double *a = rows, *b = a + apart, *c = b + apart, *d = c + apart;
    for (std::size_t i = 0; i < count; ++i)
        sum[i] = (w[0] * a[i] + w[1] * b[i]) + (w[2] * c[i] + w[3] * d[i]);
}

// Weights of the fine cells of a line; lo: the first coarse cell that is there.
struct Expansion {
    std::vector<Weights> of;
    int lo = 0;
    bool regular = true;  // as away from sides: pairs of cells alike

    Expansion(const CellBox& fine, const CellBox& beneath, const LevelPlace& coarse,
              int axis)
        : lo(beneath.lo[axis]) {
        for (int x = fine.lo[axis]; x < fine.hi[axis]; ++x) {
            of.push_back(coarse_around(x, coarse, axis));
            const auto n = of.size();
            regular = regular && (n < 3 || (of[n - 1].of == of[n - 3].of &&
                                            of[n - 1].first == of[n - 3].first + 1));
        }
    }
};

// Of a regular line, from its first cell on. a, b: weights of the first two cells, whose
// coarse ones begin at those addresses.
MAGFSI_ROW_LOOP void expand_pairs(const std::array<double, points>& wa, const double* a,
                                  const std::array<double, points>& wb, const double* b,
                                  std::size_t pairs, double* fine) {
    for (std::size_t m = 0; m < pairs; ++m) {
        fine[2 * m] =
            (wa[0] * a[m] + wa[1] * a[m + 1]) + (wa[2] * a[m + 2] + wa[3] * a[m + 3]);
        fine[2 * m + 1] =
            (wb[0] * b[m] + wb[1] * b[m + 1]) + (wb[2] * b[m + 2] + wb[3] * b[m + 3]);
    }
}

void expand(const double* coarse, const Expansion& along, double* fine) {
    const std::size_t count = along.of.size();
    std::size_t x = 0;
    if (along.regular && count > 8) {
        const Weights &a = along.of[0], &b = along.of[1];
        expand_pairs(a.of, coarse + (a.first - along.lo), b.of,
                     coarse + (b.first - along.lo), count / 2, fine);
        x = count / 2 * 2;
    }
    for (; x < count; ++x) {
        const double* c = coarse + (along.of[x].first - along.lo);
        const auto& w = along.of[x].of;
        fine[x] = (w[0] * c[0] + w[1] * c[1]) + (w[2] * c[2] + w[3] * c[3]);
    }
}

}  // namespace

std::vector<std::vector<CellBox>> ring_of(const Level& fine) {
    std::vector<std::vector<CellBox>> rings;
    for (const CellBox& owned : fine.owned_by_rank())
        rings.push_back(without(owned, fine.place.inside));
    return rings;
}

Prolongation::Prolongation(const Level& coarse,
                           const std::vector<std::vector<CellBox>>& of_ranks)
    : transfer_(coarse.comm(), one_each(coarse.owned_by_rank()), coarse.place.period,
                coarse_beneath(of_ranks, coarse.place)) {
    for (const CellBox& box :
         of_ranks[static_cast<std::size_t>(rank_of(coarse.comm()))]) {
        const CellBox beneath = coarse_beneath(box, coarse.place);
        const bool thin =
            box.hi[0] - box.lo[0] <= ring_cells && box.hi[1] - box.lo[1] > ring_cells;
        pieces_.push_back(
            {box, beneath, thin ? 1 : 0, thin ? 0 : 1,
             std::vector<double>(numbers * static_cast<std::size_t>(cells_of(beneath)))});
    }
}

// A row of the coarse cells.
void Prolongation::Piece::take(const CellRow& row, const double* numbers_of_row) {
    const std::size_t nx = length(coarse, 0), ny = length(coarse, 1);
    const auto count = static_cast<std::size_t>(row.size());
    const auto x = static_cast<std::size_t>(row.x_begin - coarse.lo[0]);
    const auto y = static_cast<std::size_t>(row.y - coarse.lo[1]);
    double* to =
        flow.data() + static_cast<std::size_t>(row.z - coarse.lo[2]) * ny * numbers * nx;
    for (std::size_t i = 0; i < numbers; ++i, numbers_of_row += count) {
        if (line == 0) {
            std::copy_n(numbers_of_row, count, to + (y * numbers + i) * nx + x);
            continue;
        }
        for (std::size_t k = 0; k < count; ++k)
            to[((x + k) * numbers + i) * ny + y] = numbers_of_row[k];
    }
}

void Prolongation::run(const Level& coarse, const Level& fine) {
    const View view = coarse.state().view();
    const Scales scales = to_fine(coarse, fine);
    transfer_.run(
        numbers,
        [&](std::size_t, const CellRow& row, double* flow) {
            read_flow(view, coarse.local(row), flow);
            apply(scales, 1, flow, static_cast<std::size_t>(row.size()));
        },
        [&](std::size_t box, const CellRow& row, const double* flow) {
            pieces_[box].take(row, flow);
        });
    for (const Piece& piece : pieces_) interpolate(piece, coarse, fine);
}

void Prolongation::interpolate(const Piece& piece, const Level& coarse,
                               const Level& fine) {
    const View view = fine.state().view();
    const auto [box, c, along, across, flow] =
        std::tie(piece.fine, piece.coarse, piece.line, piece.other, piece.flow);
    const std::size_t length = piece.length(box, along), n = piece.length(c, along);
    const Expansion expansion(box, c, coarse.place, along);
    const Expansion others(box, c, coarse.place, across);
    plane_.resize(piece.length(c, across) * numbers * n);
    line_.resize(numbers * n);
    row_.resize(numbers * length);
    for (int z = box.lo[2]; z < box.hi[2]; ++z) {
        const Weights wz = coarse_around(z, coarse.place, 2);
        const auto k = static_cast<std::size_t>(wz.first - c.lo[2]);
        combine(wz.of, flow.data() + k * plane_.size(), plane_.size(), plane_.size(),
                plane_.data());
        for (int other = box.lo[across]; other < box.hi[across]; ++other) {
            const Weights& w =
                others.of[static_cast<std::size_t>(other - box.lo[across])];
            const auto j = static_cast<std::size_t>(w.first - c.lo[across]);
            combine(w.of, plane_.data() + j * line_.size(), line_.size(), line_.size(),
                    line_.data());
            for (std::size_t i = 0; i < numbers; ++i)
                expand(line_.data() + i * n, expansion, row_.data() + i * length);
            if (along == 0) {
                write_flow(view, fine.local({other, z, box.lo[0], box.hi[0]}),
                           row_.data());
                continue;
            }
            const CellRow at = fine.local({box.lo[1], z, other, other + 1});
            write_flow_along_y(view, {at.x_begin, at.y, at.z}, static_cast<int>(length),
                               row_.data());
        }
    }
}

}  // namespace magfsi::fluid
