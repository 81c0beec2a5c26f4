#include "fluid_lbm/refinement/prolongation.h"

#include <algorithm>

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

// Weights of the fine cells of a row; lo: the first coarse cell that is there.
struct Expansion {
    std::vector<Weights> of;
    int lo = 0;
    bool regular = true;  // as away from sides: pairs of cells alike

    Expansion(const CellBox& fine, const CellBox& beneath, const LevelPlace& coarse)
        : lo(beneath.lo[0]) {
        for (int x = fine.lo[0]; x < fine.hi[0]; ++x) {
            of.push_back(coarse_around(x, coarse, 0));
            const auto n = of.size();
            regular = regular && (n < 3 || (of[n - 1].of == of[n - 3].of &&
                                            of[n - 1].first == of[n - 3].first + 1));
        }
    }
};

// Every other cell of a regular row, from the one that w belongs to.
MAGFSI_ROW_LOOP void expand_half(const std::array<double, points>& w,
                                 const double* coarse, std::size_t count, double* fine) {
    for (std::size_t m = 0; m < count; ++m)
        fine[2 * m] = (w[0] * coarse[m] + w[1] * coarse[m + 1]) +
                      (w[2] * coarse[m + 2] + w[3] * coarse[m + 3]);
}

void expand_row(const double* coarse, const Expansion& along_x, double* fine) {
    const std::size_t count = along_x.of.size();
    if (along_x.regular && count > 8) {
        for (std::size_t half = 0; half < 2; ++half) {
            const Weights& w = along_x.of[half];
            expand_half(w.of, coarse + (w.first - along_x.lo), (count + 1 - half) / 2,
                        fine + half);
        }
        return;
    }
    for (std::size_t x = 0; x < count; ++x) {
        const double* c = coarse + (along_x.of[x].first - along_x.lo);
        const auto& w = along_x.of[x].of;
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
    : transfer_(coarse.comm(), coarse.owned_by_rank(), coarse.place.period,
                coarse_beneath(of_ranks, coarse.place)) {
    for (const CellBox& box :
         of_ranks[static_cast<std::size_t>(rank_of(coarse.comm()))]) {
        const CellBox beneath = coarse_beneath(box, coarse.place);
        pieces_.push_back(
            {box, beneath,
             std::vector<double>(numbers * static_cast<std::size_t>(cells_of(beneath)))});
    }
}

void Prolongation::run(const Level& coarse, const Level& fine) {
    const View view = coarse.state().view();
    transfer_.run(
        numbers,
        [&](const CellRow& row, double* flow) {
            read_flow(view, coarse.local(row), flow);
        },
        [&](std::size_t box, const CellRow& row, const double* flow) {
            Piece& piece = pieces_[box];
            const CellBox& c = piece.coarse;
            const auto nx = static_cast<std::size_t>(c.hi[0] - c.lo[0]);
            const auto ny = static_cast<std::size_t>(c.hi[1] - c.lo[1]);
            const auto count = static_cast<std::size_t>(row.size());
            double* to = piece.flow.data() +
                         (static_cast<std::size_t>(row.z - c.lo[2]) * ny +
                          static_cast<std::size_t>(row.y - c.lo[1])) *
                             numbers * nx +
                         static_cast<std::size_t>(row.x_begin - c.lo[0]);
            for (std::size_t i = 0; i < numbers; ++i)
                std::copy_n(flow + i * count, count, to + i * nx);
        });
    for (const Piece& piece : pieces_) interpolate(piece, coarse, fine);
}

void Prolongation::interpolate(const Piece& piece, const Level& coarse,
                               const Level& fine) {
    const Scales scales = to_fine(coarse, fine);
    const View view = fine.state().view();
    const CellBox& c = piece.coarse;
    const auto nx = static_cast<std::size_t>(c.hi[0] - c.lo[0]);
    const auto ny = static_cast<std::size_t>(c.hi[1] - c.lo[1]);
    const auto length = static_cast<std::size_t>(piece.fine.hi[0] - piece.fine.lo[0]);
    const Expansion along_x(piece.fine, c, coarse.place);
    std::vector<double> plane(ny * numbers * nx), line(numbers * nx),
        row(numbers * length);
    for (int z = piece.fine.lo[2]; z < piece.fine.hi[2]; ++z) {
        const Weights wz = coarse_around(z, coarse.place, 2);
        const auto k = static_cast<std::size_t>(wz.first - c.lo[2]);
        combine(wz.of, piece.flow.data() + k * plane.size(), plane.size(), plane.size(),
                plane.data());
        for (int y = piece.fine.lo[1]; y < piece.fine.hi[1]; ++y) {
            const Weights wy = coarse_around(y, coarse.place, 1);
            const auto j = static_cast<std::size_t>(wy.first - c.lo[1]);
            combine(wy.of, plane.data() + j * line.size(), line.size(), line.size(),
                    line.data());
            for (std::size_t i = 0; i < numbers; ++i)
                expand_row(line.data() + i * nx, along_x, row.data() + i * length);
            apply(scales, 1, row.data(), length);
            write_flow(view, fine.local({y, z, piece.fine.lo[0], piece.fine.hi[0]}),
                       row.data());
        }
    }
}

}  // namespace magfsi::fluid
