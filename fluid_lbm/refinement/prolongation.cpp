// SPDX-License-Identifier: GPL-2.0-or-later
#include "fluid_lbm/refinement/prolongation.h"

#include <algorithm>

namespace magfsi::fluid {

namespace {

constexpr int points = cubic_points;
constexpr std::size_t numbers = numbers_between_levels;

// The coarse cells that a cubic may read along an axis: those that the level solves, or
// any if the axis is periodic.
struct Range {
    int lo, hi;
};
Range readable(const LevelPlace& place, int axis) {
    constexpr int anywhere = 1 << 28;
    if (place.period[axis] > 0) return {-anywhere, anywhere};
    return {place.inside.lo[axis], place.inside.hi[axis]};
}

// Weights of a fine cell among the coarse ones, whose centres lie at whole numbers. In
// the ring of a patch the cubic reads one layer of covered cells, the one that is
// overwritten in every step.
Weights coarse_around(int fine_cell, const LevelPlace& coarse, const LevelPlace& fine,
                      int axis) {
    Range range = readable(coarse, axis);
    const int lo = fine.inside.lo[axis], hi = fine.inside.hi[axis];
    if (fine_cell < lo) range.hi = std::min(range.hi, lo / 2 + band_cells);
    if (fine_cell >= hi) range.lo = std::max(range.lo, hi / 2 - band_cells);
    return cubic_at((2 * fine_cell - 1) / 4.0, range.lo, range.hi);
}

// Number of layers of solid cells that are given numbers for the cubic.
constexpr int solid_layers = 2;

// True if the map has a solid cell in the box that it was made for.
bool has_solid(const SolidMap& map, const CellBox& box) {
    bool some = false;
    for_each_cell({{0, 0, 0},
                   {box.hi[0] - box.lo[0], box.hi[1] - box.lo[1], box.hi[2] - box.lo[2]}},
                  [&](const Cell& cell) { some = some || map.solid(cell); });
    return some;
}

// The coarse cells that the interpolation of a box reads. Near obstacles the box is wider
// by the cells that the numbers of solid cells come from, so that the result does not
// depend on how boxes are cut.
CellBox coarse_beneath(const CellBox& fine, const Level& level, const LevelPlace& place) {
    const LevelPlace& coarse = level.place;
    CellBox box, wider;
    if (is_empty(fine)) return {};
    for (int d = 0; d < 3; ++d) {
        box.lo[d] = coarse_around(fine.lo[d], coarse, place, d).first;
        box.hi[d] = coarse_around(fine.hi[d] - 1, coarse, place, d).first + points;
        const Range range = readable(coarse, d);
        wider.lo[d] = std::max(box.lo[d] - solid_layers, range.lo);
        wider.hi[d] = std::min(box.hi[d] + solid_layers, range.hi);
    }
    const auto map = level.solids_in(wider);
    return map && has_solid(*map, wider) ? wider : box;
}

std::vector<std::vector<CellBox>> coarse_beneath(
    const std::vector<std::vector<CellBox>>& of_ranks, const Level& coarse,
    const LevelPlace& place) {
    std::vector<std::vector<CellBox>> beneath(of_ranks.size());
    for (std::size_t r = 0; r < of_ranks.size(); ++r) {
        for (const CellBox& box : of_ranks[r])
            beneath[r].push_back(coarse_beneath(box, coarse, place));
    }
    return beneath;
}

int rank_of(MPI_Comm comm) {
    int rank = 0;
    MPI_Comm_rank(comm, &rank);
    return rank;
}

// Loops with this mark are compiled for AVX2, too; the processor decides when the program
// starts.
#define MAGFSI_ROW_LOOP __attribute__((target_clones("avx2", "default")))

// Weighted sum of four rows that lie `apart` elements from each other.
MAGFSI_ROW_LOOP void combine(const std::array<double, points>& w, const double* rows,
                             std::size_t apart, std::size_t count, double* sum) {
    const double *a = rows, *b = a + apart, *c = b + apart, *d = c + apart;
    for (std::size_t i = 0; i < count; ++i)
        sum[i] = (w[0] * a[i] + w[1] * b[i]) + (w[2] * c[i] + w[3] * d[i]);
}

// Weights of the fine cells of a box along an axis.
std::vector<Weights> weights_along(const CellBox& fine, const LevelPlace& coarse,
                                   const LevelPlace& place, int axis) {
    std::vector<Weights> weights;
    for (int x = fine.lo[axis]; x < fine.hi[axis]; ++x)
        weights.push_back(coarse_around(x, coarse, place, axis));
    return weights;
}

// Finds the part of a line in which all pairs of fine cells have the same weights.
Expansion expansion_of(std::vector<Weights> weights, int first_coarse) {
    Expansion e{std::move(weights), first_coarse, 0, 0};
    const auto alike = [&](std::size_t i) {
        return e.of[i].of == e.of[i + 2].of && e.of[i].first + 1 == e.of[i + 2].first;
    };
    while (e.begin + 3 < e.of.size() && !(alike(e.begin) && alike(e.begin + 1)))
        ++e.begin;
    // The regular part extends as far as each cell is like the one before the last: the
    // two cells of a pair may meet the end of the line at different pairs.
    e.end = std::min(e.begin + 2, e.of.size());
    while (e.end < e.of.size() && alike(e.end - 2)) ++e.end;
    return e;
}

// Fine cells of a regular line, from its first cell on. wa, wb: weights of the first two
// cells; a, b: the coarse values that these weights belong to.
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

// Interpolates one number along a line.
void expand(const double* coarse, const Expansion& along, double* fine) {
    const auto one_by_one = [&](std::size_t begin, std::size_t end) {
        for (std::size_t x = begin; x < end; ++x) {
            const double* c = coarse + (along.of[x].first - along.lo);
            const auto& w = along.of[x].of;
            fine[x] = (w[0] * c[0] + w[1] * c[1]) + (w[2] * c[2] + w[3] * c[3]);
        }
    };
    const std::size_t pairs = (along.end - along.begin) / 2;
    one_by_one(0, along.begin);
    if (pairs > 0) {
        const Weights &a = along.of[along.begin], &b = along.of[along.begin + 1];
        expand_pairs(a.of, coarse + (a.first - along.lo), b.of,
                     coarse + (b.first - along.lo), pairs, fine + along.begin);
    }
    one_by_one(along.begin + 2 * pairs, along.of.size());
}

}  // namespace

std::vector<std::vector<CellBox>> ring_of(const Level& fine) {
    std::vector<std::vector<CellBox>> rings;
    for (const CellBox& owned : fine.owned_by_rank())
        rings.push_back(without(owned, fine.place.inside));
    return rings;
}

Prolongation::Prolongation(const Level& coarse, const LevelPlace& place,
                           const std::vector<std::vector<CellBox>>& of_ranks)
    : transfer_(coarse.comm(), one_each(coarse.owned_by_rank()), coarse.place.period,
                coarse_beneath(of_ranks, coarse, place)) {
    for (const CellBox& box : of_ranks[rank_of(coarse.comm())])
        pieces_.emplace_back(box, coarse, place);
}

Prolongation::Piece::Piece(const CellBox& fine_cells, const Level& level,
                           const LevelPlace& place)
    : fine(fine_cells), coarse(coarse_beneath(fine, level, place)) {
    if (is_empty(fine)) return;
    if (length(fine, 0) <= ring_cells && length(fine, 1) > ring_cells)
        std::swap(line, other);
    expansion =
        expansion_of(weights_along(fine, level.place, place, line), coarse.lo[line]);
    across = weights_along(fine, level.place, place, other);
    up = weights_along(fine, level.place, place, 2);
    flow.resize(numbers * cells_of(coarse));
    find_solids(level);
}

std::size_t Prolongation::Piece::first_number(const std::array<int, 3>& cell) const {
    const auto at = [&](int axis) {
        return static_cast<std::size_t>(cell[axis] - coarse.lo[axis]);
    };
    return ((at(2) * length(coarse, other) + at(other)) * numbers) *
               length(coarse, line) +
           at(line);
}

// Finds the solid cells layer by layer: those beside the fluid, then those beside these,
// as far as a cubic reaches.
void Prolongation::Piece::find_solids(const Level& level) {
    const auto map = level.solids_in(coarse);
    if (!map) return;
    enum Known : char { no, fluid, found };
    std::vector<char> known(static_cast<std::size_t>(cells_of(coarse)));
    const auto index = [&](const Cell& c) {
        return (static_cast<std::size_t>(c[2]) * length(coarse, 1) +
                static_cast<std::size_t>(c[1])) *
                   length(coarse, 0) +
               static_cast<std::size_t>(c[0]);
    };
    CellBox local;
    for (int d = 0; d < 3; ++d) local.hi[d] = coarse.hi[d] - coarse.lo[d];
    for_each_cell(local,
                  [&](const Cell& c) { known[index(c)] = map->solid(c) ? no : fluid; });
    const auto number = [&](const Cell& c) {
        return first_number(
            {c[0] + coarse.lo[0], c[1] + coarse.lo[1], c[2] + coarse.lo[2]});
    };
    for (int layer = 0; layer < solid_layers; ++layer) {
        std::vector<std::size_t> now;
        for_each_cell(local, [&](const Cell& c) {
            if (known[index(c)] != no) return;
            SolidCell cell{number(c), {}, layer == 0};
            for (int q = 1; q < d3q19::directions; ++q) {
                Cell beside = c;
                bool there = true;
                for (int d = 0; d < 3; ++d) {
                    beside[d] += d3q19::c[q][d];
                    there = there && beside[d] >= 0 && beside[d] < local.hi[d];
                }
                if (there && known[index(beside)] != no)
                    cell.beside.push_back(number(beside));
            }
            if (cell.beside.empty()) return;
            now.push_back(index(c));
            solids.push_back(std::move(cell));
        });
        for (const std::size_t cell : now) known[cell] = found;
    }
}

// Density and stress of a solid cell are the mean of the cells beside it. The velocity
// has the opposite sign in the first layer: it passes through zero at the wall, which
// lies half-way between cells on average.
void Prolongation::Piece::extend_into_solids() {
    const std::size_t step = length(coarse, line);
    for (const SolidCell& cell : solids) {
        for (std::size_t i = 0; i < numbers; ++i) {
            double sum = 0;
            for (const std::size_t beside : cell.beside) sum += flow[beside + i * step];
            const bool velocity = i > 0 && i < first_stress;
            const double sign = velocity && cell.at_wall ? -1 : 1;
            flow[cell.first + i * step] = sign * sum / cell.beside.size();
        }
    }
}

std::array<double*, numbers> Prolongation::Piece::of_row(const CellRow& row) {
    std::array<double*, numbers> at{};
    const std::size_t first = first_number({row.x_begin, row.y, row.z});
    for (std::size_t i = 0; i < numbers; ++i)
        at[i] = flow.data() + first + i * length(coarse, line);
    return at;
}

// Stores a row of coarse cells along x, whichever way the lines run.
void Prolongation::Piece::take(const CellRow& row, const double* numbers_of_row) {
    const std::size_t count = row.size();
    const auto at = of_row(row);
    const std::size_t step = line == 0 ? 1 : numbers * length(coarse, line);
    for (std::size_t i = 0; i < numbers; ++i, numbers_of_row += count) {
        for (std::size_t k = 0; k < count; ++k) at[i][k * step] = numbers_of_row[k];
    }
}

void Prolongation::run(const Level& coarse, Level& fine) {
    const View view = coarse.state().view();
    const Scales scales = to_fine(coarse, fine);
    const auto add_velocity = [&](const auto& flow, int count) {
        for (std::size_t a = 0; a < 3; ++a) {
            for (int i = 0; scales.velocity[a] != 0 && i < count; ++i)
                flow[1 + a][i] += scales.velocity[a];
        }
    };
    const auto read = [&](std::size_t, const CellRow& row, double* flow) {
        std::array<double*, numbers> at{};
        for (std::size_t i = 0; i < numbers; ++i)
            at[i] = flow + i * static_cast<std::size_t>(row.size());
        read_flow(view, coarse.local(row), at);
        add_velocity(at, row.size());
    };
    transfer_.run(
        numbers, read,
        [&](std::size_t box, const CellRow& row, const double* flow) {
            pieces_[box].take(row, flow);
        },
        [&](std::size_t from, const CellRow& owned, std::size_t box, const CellRow& row) {
            Piece& piece = pieces_[box];
            if (piece.line == 0) {
                const auto at = piece.of_row(row);
                read_flow(view, coarse.local(owned), at);
                add_velocity(at, row.size());
                return;
            }
            row_.resize(numbers * row.size());
            read(from, owned, row_.data());
            piece.take(row, row_.data());
        });
    for (Piece& piece : pieces_) {
        piece.extend_into_solids();
        interpolate(piece, scales, fine);
    }
    fine.reset_solid_cells();
}

// Interpolates a box: along z by planes, then across the lines, then along them.
void Prolongation::interpolate(const Piece& piece, const Scales& scales,
                               const Level& fine) {
    const View view = fine.state().view();
    const CellBox& box = piece.fine;
    if (is_empty(box)) return;
    const CellBox& c = piece.coarse;
    const std::size_t length = piece.length(box, piece.line),
                      n = piece.length(c, piece.line);
    const std::size_t lines = piece.across.size();
    plane_.resize(piece.length(c, piece.other) * numbers * n);
    line_.resize(numbers * n);
    // Short columns along y are written together, so that all lines of a plane are kept.
    row_.resize(numbers * length * (piece.line == 0 ? 1 : lines));
    for (int z = box.lo[2]; z < box.hi[2]; ++z) {
        const Weights& wz = piece.up[z - box.lo[2]];
        const std::size_t k = wz.first - c.lo[2];
        combine(wz.of, piece.flow.data() + k * plane_.size(), plane_.size(),
                plane_.size(), plane_.data());
        for (std::size_t other = 0; other < lines; ++other) {
            const Weights& w = piece.across[other];
            const double* first =
                plane_.data() +
                static_cast<std::size_t>(w.first - c.lo[piece.other]) * line_.size();
            std::array<double, points> of_stress = w.of;
            for (double& weight : of_stress) weight *= scales.stress;
            const std::size_t flow_size = first_stress * n;
            combine(w.of, first, line_.size(), flow_size, line_.data());
            combine(of_stress, first + flow_size, line_.size(), line_.size() - flow_size,
                    line_.data() + flow_size);
            if (scales.trace != 1) scale_trace(scales.trace, line_.data() + flow_size, n);
            double* row = row_.data() + (piece.line == 0 ? 0 : other * numbers * length);
            for (std::size_t i = 0; i < numbers; ++i)
                expand(line_.data() + i * n, piece.expansion, row + i * length);
            const int y = box.lo[1] + static_cast<int>(other);
            if (piece.line == 0)
                write_flow(view, fine.local({y, z, box.lo[0], box.hi[0]}), row);
        }
        if (piece.line == 0) continue;
        const CellRow first = fine.local({box.lo[1], z, box.lo[0], box.hi[0]});
        write_flow_along_y(
            view,
            {{first.x_begin, first.y, first.z},
             {first.x_end, first.y + static_cast<int>(length), first.z + 1}},
            row_.data());
    }
}

}  // namespace magfsi::fluid
