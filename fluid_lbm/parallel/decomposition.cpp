#include "fluid_lbm/parallel/decomposition.h"

#include <algorithm>
#include <stdexcept>
#include <string>

namespace magfsi::fluid {

namespace {

int first_row(int count, int parts, int part) {
    return static_cast<int>(static_cast<long long>(count) * part / parts);
}

int largest_part(int count, int parts) {
    return (count + parts - 1) / parts;
}

// Sides of a block's axis that border another rank, at most.
int cut_sides(int parts, bool periodic) {
    if (parts == 1) return 0;
    return parts == 2 && !periodic ? 1 : 2;
}

double load(const std::array<int, 3>& cells, const std::array<bool, 3>& periodic,
            int ranks_y, int ranks_z) {
    const int ny = largest_part(cells[1], ranks_y), nz = largest_part(cells[2], ranks_z);
    const int ghosts =
        cut_sides(ranks_y, periodic[1]) * nz + cut_sides(ranks_z, periodic[2]) * ny;
    return static_cast<double>(ny) * nz + 0.5 * ghosts;
}

std::string refusal(const std::array<int, 3>& cells, int ranks) {
    return "a fluid of " + std::to_string(cells[1]) + " x " + std::to_string(cells[2]) +
           " rows (y, z) cannot be cut into " + std::to_string(ranks) +
           " blocks; choose a number of fluid ranks that is a product of at most " +
           std::to_string(cells[1]) + " and at most " + std::to_string(cells[2]);
}

Beyond beyond(const Decomposition& d, int rank, int axis, int side) {
    if (d.neighbor(rank, axis, side) != no_rank) return Beyond::neighbor;
    return d.periodic[axis] ? Beyond::wrap : Beyond::wall;
}

}  // namespace

int Decomposition::neighbor(int rank, int axis, int side) const {
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

}  // namespace magfsi::fluid
