#include "fluid_lbm/parallel/halo.h"

#include <algorithm>
#include <cstring>

namespace magfsi::fluid {

using namespace d3q19;

// Slots with velocity component `sign` along the axis in the rows at index `row` of it,
// limited to those whose user (the row at -c_q from the slot) lies across the face.
std::vector<Halo::Slot> Halo::slots(const RowLayout& layout, int axis, int sign,
                                    int row) {
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

Halo::Halo(MPI_Comm comm, const Decomposition& decomposition, int rank)
    : comm_(comm),
      row_length_(decomposition.cells[0]),
      x_walls_(!decomposition.periodic[0]) {
    const RowLayout layout = decomposition.layout(rank);
    for (int axis = 1; axis <= 2; ++axis) {
        const int count = axis == 1 ? layout.ny : layout.nz;
        for (int side = 0; side < 2; ++side) {
            Face face;
            face.rank = decomposition.neighbor(rank, axis, side);
            if (face.rank == no_rank) continue;
            face.axis = axis;
            face.side = side;
            const int outward = side == 0 ? -1 : 1;
            face.borrowed = slots(layout, axis, outward, side == 0 ? -1 : count);
            face.lent = slots(layout, axis, -outward, side == 0 ? 0 : count - 1);
            faces_.push_back(std::move(face));
        }
    }
}

int Halo::first_lent(int q) const {
    return x_walls_ && c[q][0] > 0 ? 1 : 0;
}

int Halo::lent_length(int q) const {
    return x_walls_ && c[q][0] != 0 ? row_length_ - 1 : row_length_;
}

template <class Real>
void Halo::pack(const PopulationRows<Real>& rows, const std::vector<Slot>& slots,
                std::vector<std::byte>& to) const {
    to.resize(slots.size() * row_length_ * sizeof(Real));
    std::byte* next = to.data();
    for (const Slot& slot : slots) {
        const std::size_t bytes = lent_length(slot.q) * sizeof(Real);
        std::memcpy(next, rows.row(slot.q, slot.row) + first_lent(slot.q), bytes);
        next += bytes;
    }
}

template <class Real>
void Halo::unpack(const PopulationRows<Real>& rows, const std::vector<Slot>& slots,
                  const std::vector<std::byte>& from) const {
    const std::byte* next = from.data();
    for (const Slot& slot : slots) {
        const std::size_t bytes = lent_length(slot.q) * sizeof(Real);
        std::memcpy(rows.row(slot.q, slot.row) + first_lent(slot.q), next, bytes);
        next += bytes;
    }
}

void Halo::send(int axis, const Populations& populations) {
    under_way_ = axis;
    // The tag is the side the message leaves by: with two ranks on a periodic axis both
    // sides have the same neighbour.
    for (Face& face : faces_) {
        if (face.axis != axis) continue;
        const auto& receiving = exchange_ == Exchange::fill ? face.borrowed : face.lent;
        face.received.resize(receiving.size() * row_length_ *
                             populations.element_bytes());
        MPI_Irecv(face.received.data(), static_cast<int>(face.received.size()), MPI_BYTE,
                  face.rank, 1 - face.side, comm_, &requests_.emplace_back());
    }
    for (Face& face : faces_) {
        if (face.axis != axis) continue;
        const auto& sending = exchange_ == Exchange::fill ? face.lent : face.borrowed;
        populations.visit([&](const auto& rows) { pack(rows, sending, face.sent); });
        MPI_Isend(face.sent.data(), static_cast<int>(face.sent.size()), MPI_BYTE,
                  face.rank, face.side, comm_, &requests_.emplace_back());
    }
}

void Halo::receive(const Populations& populations) {
    MPI_Waitall(static_cast<int>(requests_.size()), requests_.data(),
                MPI_STATUSES_IGNORE);
    requests_.clear();
    for (const Face& face : faces_) {
        if (face.axis != under_way_) continue;
        const auto& receiving = exchange_ == Exchange::fill ? face.borrowed : face.lent;
        populations.visit(
            [&](const auto& rows) { unpack(rows, receiving, face.received); });
    }
    under_way_ = 0;
}

void Halo::start(Exchange exchange, const Populations& populations) {
    exchange_ = exchange;
    axes_left_ = exchange == Exchange::fill ? std::vector{2, 1} : std::vector{1, 2};
    std::erase_if(axes_left_, [&](int axis) {
        return std::none_of(faces_.begin(), faces_.end(),
                            [&](const Face& face) { return face.axis == axis; });
    });
    if (axes_left_.empty()) return;
    send(axes_left_.back(), populations);
    axes_left_.pop_back();
}

void Halo::advance(const Populations& populations) {
    if (axes_left_.empty()) return;
    receive(populations);
    send(axes_left_.back(), populations);
    axes_left_.pop_back();
}

void Halo::finish(const Populations& populations) {
    advance(populations);
    if (under_way_ != 0) receive(populations);
}

}  // namespace magfsi::fluid
