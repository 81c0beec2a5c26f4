// SPDX-License-Identifier: GPL-2.0-or-later
#include "fluid_lbm/parallel/decomposition.h"

#include <algorithm>
#include <stdexcept>
#include <string>

namespace magfsi::fluid {

namespace {

// First row of a part, and the size of the largest part, if `count` rows are divided.
int first_row(int count, int parts, int part) {
    return static_cast<long long>(count) * part / parts;
}

int largest_part(int count, int parts) {
    return (count + parts - 1) / parts;
}

// Largest number of sides of a block, along an axis of `parts` blocks, that border
// another rank.
int cut_sides(int parts, bool periodic) {
    if (parts == 1) return 0;
    return parts == 2 && !periodic ? 1 : 2;
}

// Work of the fullest rank in rows.
double load(const std::array<int, 3>& cells, const std::array<bool, 3>& periodic,
            int ranks_y, int ranks_z) {
    const int ny = largest_part(cells[1], ranks_y), nz = largest_part(cells[2], ranks_z);
    const int ghosts =
        cut_sides(ranks_y, periodic[1]) * nz + cut_sides(ranks_z, periodic[2]) * ny;
    return 1.0 * ny * nz + 0.5 * ghosts;
}

std::string refusal(const std::array<int, 3>& cells, int ranks) {
    return "a fluid of " + std::to_string(cells[1]) + " x " + std::to_string(cells[2]) +
           " rows (y, z) cannot be cut into " + std::to_string(ranks) +
           " blocks; choose a number of fluid ranks that is a product of at most " +
           std::to_string(cells[1]) + " and at most " + std::to_string(cells[2]);
}

Beyond beyond(const Decomposition& d, int rank, int axis, int side) {
    if (d.neighbour(rank, axis, side) != no_rank) return Beyond::neighbour;
    return d.periodic[axis] ? Beyond::wrap : Beyond::wall;
}

// The rows that remain without those at cut sides; a single row between two cuts is at
// both.
RowBox inner(const RowLayout& layout) {
    const auto cut = [](Beyond beyond) { return beyond == Beyond::neighbour ? 1 : 0; };
    RowBox box{cut(layout.beyond_y[0]), layout.ny - cut(layout.beyond_y[1]),
               cut(layout.beyond_z[0]), layout.nz - cut(layout.beyond_z[1])};
    box.y_end = std::max(box.y_end, box.y_begin);
    box.z_end = std::max(box.z_end, box.z_begin);
    return box;
}

std::vector<RowBox> without_empty(std::vector<RowBox> boxes) {
    std::erase_if(boxes, [](const RowBox& box) { return box.size() == 0; });
    return boxes;
}

}  // namespace

int Decomposition::neighbour(int rank, int axis, int side) const {
    const int parts = ranks[axis - 1];
    if (parts == 1) return no_rank;
    const int position[2] = {rank % ranks[0], rank / ranks[0]};
    int next = position[axis - 1] + (side == 0 ? -1 : 1);
    if (next < 0 || next >= parts) {
        if (!periodic[axis]) return no_rank;
        next = (next + parts) % parts;
    }
    return axis == 1 ? position[1] * ranks[0] + next : next * ranks[0] + position[0];
}

RowLayout Decomposition::layout(int rank) const {
    const CellBox& box = boxes[rank];
    RowLayout rows;
    rows.nx = cells[0];
    rows.ny = box.hi[1] - box.lo[1];
    rows.nz = box.hi[2] - box.lo[2];
    rows.beyond_x = periodic[0] ? Beyond::wrap : Beyond::wall;
    for (int side = 0; side < 2; ++side) {
        rows.beyond_y[side] = beyond(*this, rank, 1, side);
        rows.beyond_z[side] = beyond(*this, rank, 2, side);
    }
    return rows;
}

Decomposition decompose(const std::array<int, 3>& cells,
                        const std::array<bool, 3>& periodic, int ranks) {
    Decomposition best{cells, periodic, {0, 0}, {}};
    double best_load = 0;
    for (int ranks_y = 1; ranks_y <= std::min(ranks, cells[1]); ++ranks_y) {
        const int ranks_z = ranks / ranks_y;
        if (ranks_y * ranks_z != ranks || ranks_z > cells[2]) continue;
        const double this_load = load(cells, periodic, ranks_y, ranks_z);
        // Equal loads: cut z, whose faces are contiguous in memory.
        if (best.ranks[0] == 0 || this_load < best_load) {
            best.ranks = {ranks_y, ranks_z};
            best_load = this_load;
        }
    }
    if (best.ranks[0] == 0) throw std::invalid_argument(refusal(cells, ranks));
    for (int z = 0; z < best.ranks[1]; ++z) {
        for (int y = 0; y < best.ranks[0]; ++y) {
            best.boxes.push_back({{0, first_row(cells[1], best.ranks[0], y),
                                   first_row(cells[2], best.ranks[1], z)},
                                  {cells[0], first_row(cells[1], best.ranks[0], y + 1),
                                   first_row(cells[2], best.ranks[1], z + 1)}});
        }
    }
    return best;
}

std::vector<RowBox> rows_at_cuts(const RowLayout& layout) {
    const RowBox in = inner(layout);
    return without_empty({{0, layout.ny, 0, in.z_begin},
                          {0, layout.ny, in.z_end, layout.nz},
                          {0, in.y_begin, in.z_begin, in.z_end},
                          {in.y_end, layout.ny, in.z_begin, in.z_end}});
}

std::vector<RowBox> inner_rows(const RowLayout& layout) {
    const RowBox in = inner(layout);
    if (in.size() == layout.ny * layout.nz) return {in};  // nothing to exchange
    const int middle = (in.z_begin + in.z_end) / 2;
    return without_empty({{in.y_begin, in.y_end, in.z_begin, middle},
                          {in.y_begin, in.y_end, middle, in.z_end}});
}

std::vector<RowBox> clipped(std::vector<RowBox> boxes, const RowBox& to) {
    for (RowBox& box : boxes) {
        box.y_begin = std::max(box.y_begin, to.y_begin);
        box.z_begin = std::max(box.z_begin, to.z_begin);
        box.y_end = std::max(std::min(box.y_end, to.y_end), box.y_begin);
        box.z_end = std::max(std::min(box.z_end, to.z_end), box.z_begin);
    }
    return without_empty(std::move(boxes));
}

}  // namespace magfsi::fluid
