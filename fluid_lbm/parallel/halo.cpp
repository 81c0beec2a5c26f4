// SPDX-License-Identifier: GPL-2.0-or-later
#include "fluid_lbm/parallel/halo.h"

#include <algorithm>
#include <utility>

namespace magfsi::fluid {

using namespace d3q19;

namespace {

// The slots of direction q in a whole row.
struct Slot {
    int q, row;
};

// The slots of SlotsType: those with component `sign` in the rows at `row` that a row
// across the face uses.
std::vector<Slot> slots(const RowLayout& layout, int axis, int sign, int row) {
    std::vector<Slot> found;
    for (int q = 1; q < directions; ++q) {
        if (c[q][axis] != sign) continue;
        if (axis == 1) {
            // The user may be a diagonal neighbour, which gets the slot by the exchange
            // along z. Behind a wall there is no user.
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

// A piece of the populations' memory, from Populations::memory() on.
struct ByteRange {
    MPI_Aint offset;
    int bytes;
};

// One range per row, or one for rows that follow each other: the padding between them is
// ghost elements, which nobody uses between two rows.
std::vector<ByteRange> ranges(const std::vector<Slot>& slots, const RowLayout& layout,
                              const Populations& populations) {
    const bool x_walls = layout.beyond_x == Beyond::wall;
    const int size = populations.element_bytes();
    std::vector<ByteRange> found;
    Slot last{-1, -1};
    for (const Slot& slot : slots) {
        // A population that leaves a wall across x stays with the owner.
        const bool whole = !x_walls || c[slot.q][0] == 0;
        const int first = !whole && c[slot.q][0] > 0 ? 1 : 0;
        const ByteRange range{populations.offset(slot.q, slot.row) + first * size,
                              (whole ? layout.nx : layout.nx - 1) * size};
        if (whole && slot.q == last.q && slot.row == last.row + 1) {
            const MPI_Aint end = range.offset + range.bytes;
            found.back().bytes = end - found.back().offset;
        } else {
            found.push_back(range);
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
    for (const ByteRange& range :
         ranges(slots(layout, axis, sign, row), layout, populations)) {
        lengths.push_back(range.bytes);
        offsets.push_back(range.offset);
    }
    MPI_Type_create_hindexed(lengths.size(), lengths.data(), offsets.data(), MPI_BYTE,
                             &type_);
    MPI_Type_commit(&type_);
}

SlotsType::~SlotsType() {
    int finalized = 0;
    MPI_Finalized(&finalized);
    if (finalized == 0 && type_ != MPI_DATATYPE_NULL) MPI_Type_free(&type_);
}

SlotsType::SlotsType(SlotsType&& other) noexcept
    : type_(std::exchange(other.type_, MPI_DATATYPE_NULL)) {}

Halo::Halo(MPI_Comm comm, const Decomposition& decomposition, int rank,
           const Populations& populations)
    : comm_(comm), memory_(populations.memory()) {
    const RowLayout layout = decomposition.layout(rank);
    for (int axis = 1; axis <= 2; ++axis) {
        const int count = axis == 1 ? layout.ny : layout.nz;
        for (int side = 0; side < 2; ++side) {
            const int neighbour = decomposition.neighbour(rank, axis, side);
            if (neighbour == no_rank) continue;
            const int outward = side == 0 ? -1 : 1;
            const int ghost = side == 0 ? -1 : count,
                      outermost = side == 0 ? 0 : count - 1;
            faces_.push_back({neighbour, axis, side,
                              SlotsType(layout, populations, axis, outward, ghost),
                              SlotsType(layout, populations, axis, -outward, outermost)});
        }
    }
}

void Halo::send(int axis) {
    const bool fill = exchange_ == Exchange::fill;
    // The tag is the side the message leaves by: with two ranks on a periodic axis both
    // sides have the same neighbour.
    for (const Face& face : faces_) {
        if (face.axis != axis) continue;
        MPI_Irecv(memory_, 1, (fill ? face.borrowed : face.lent).get(), face.rank,
                  1 - face.side, comm_, &requests_.emplace_back());
    }
    for (const Face& face : faces_) {
        if (face.axis != axis) continue;
        MPI_Isend(memory_, 1, (fill ? face.lent : face.borrowed).get(), face.rank,
                  face.side, comm_, &requests_.emplace_back());
    }
}

void Halo::start(Exchange exchange) {
    exchange_ = exchange;
    axes_left_ = exchange == Exchange::fill ? std::vector{2, 1} : std::vector{1, 2};
    std::erase_if(axes_left_, [&](int axis) {
        return std::none_of(faces_.begin(), faces_.end(),
                            [&](const Face& face) { return face.axis == axis; });
    });
    send_next();
}

void Halo::send_next() {
    if (axes_left_.empty()) return;
    const int axis = axes_left_.back();
    axes_left_.pop_back();
    send(axis);
}

void Halo::wait() {
    if (requests_.empty()) return;
    const double start_s = MPI_Wtime();
    MPI_Waitall(requests_.size(), requests_.data(), MPI_STATUSES_IGNORE);
    waited_s_ += MPI_Wtime() - start_s;
    requests_.clear();
}

void Halo::advance() {
    if (axes_left_.empty()) return;
    wait();
    send_next();
}

void Halo::finish() {
    advance();
    wait();
}

}  // namespace magfsi::fluid
