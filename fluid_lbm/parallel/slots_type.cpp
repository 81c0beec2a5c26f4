#include "fluid_lbm/parallel/slots_type.h"

#include <utility>
#include <vector>

namespace magfsi::fluid {

using namespace d3q19;

namespace {

struct Slot {
    int q, row;
};

std::vector<Slot> slots(const RowLayout& layout, int axis, int sign, int row) {
    std::vector<Slot> found;
    for (int q = 1; q < directions; ++q) {
        if (c[q][axis] != sign) continue;
        if (axis == 1) {
            // The user may be a diagonal neighbour, which gets the slot by way of the
            // exchange along z; behind a wall there is none.
            for (int z = 0; z < layout.nz; ++z) {
                if (cross(z - c[q][2], layout.nz, layout.beyond_z).wall) continue;
                found.push_back({q, layout.row(row, z)});
            }
        } else {
            for (int user = 0; user < layout.ny; ++user) {
                const Crossing y = cross(user + c[q][1], layout.ny, layout.beyond_y);
                if (!y.wall) found.push_back({q, layout.row(y.index, row)});
            }
        }
    }
    return found;
}

struct Block {
    MPI_Aint offset;
    int bytes;
};

// One block a row, or one for rows that follow each other: their padding is ghost
// elements, which nobody uses between two rows.
std::vector<Block> blocks(const std::vector<Slot>& slots, const RowLayout& layout,
                          const Populations& populations) {
    const bool x_walls = layout.beyond_x == Beyond::wall;
    const auto size = static_cast<int>(populations.element_bytes());
    std::vector<Block> found;
    Slot last{-1, -1};
    for (const Slot& slot : slots) {
        // A population that leaves a wall across x stays with the owner.
        const bool whole = !x_walls || c[slot.q][0] == 0;
        const int first = !whole && c[slot.q][0] > 0 ? 1 : 0;
        const Block block{populations.offset(slot.q, slot.row) + first * size,
                          (whole ? layout.nx : layout.nx - 1) * size};
        if (whole && slot.q == last.q && slot.row == last.row + 1) {
            const MPI_Aint end = block.offset + block.bytes;
            found.back().bytes = static_cast<int>(end - found.back().offset);
        } else {
            found.push_back(block);
        }
        last = slot;
    }
    return found;
}

}  // namespace

SlotsType::SlotsType(const RowLayout& layout, const Populations& populations, int axis,
                     int sign, int row) {
    std::vector<int> lengths;
    std::vector<MPI_Aint> offsets;
    for (const Block& block :
         blocks(slots(layout, axis, sign, row), layout, populations)) {
        lengths.push_back(block.bytes);
        offsets.push_back(block.offset);
    }
    MPI_Type_create_hindexed(static_cast<int>(lengths.size()), lengths.data(),
                             offsets.data(), MPI_BYTE, &type_);
    MPI_Type_commit(&type_);
}

SlotsType::~SlotsType() {
    int finalized = 0;
    MPI_Finalized(&finalized);
    if (finalized == 0 && type_ != MPI_DATATYPE_NULL) MPI_Type_free(&type_);
}

SlotsType::SlotsType(SlotsType&& other) noexcept
    : type_(std::exchange(other.type_, MPI_DATATYPE_NULL)) {}

}  // namespace magfsi::fluid
