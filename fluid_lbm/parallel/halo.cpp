#include "fluid_lbm/parallel/halo.h"

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

void Halo::exchange(int axis, const Populations& populations,
                    std::vector<Slot> Face::*sending,
                    std::vector<Slot> Face::*receiving) {
    std::vector<MPI_Request> requests;
    // The tag is the side the message leaves by: with two ranks on a periodic axis both
    // sides have the same neighbour.
    for (Face& face : faces_) {
        if (face.axis != axis) continue;
        face.received.resize((face.*receiving).size() * row_length_ *
                             populations.element_bytes());
        MPI_Irecv(face.received.data(), static_cast<int>(face.received.size()), MPI_BYTE,
                  face.rank, 1 - face.side, comm_, &requests.emplace_back());
    }
    for (Face& face : faces_) {
        if (face.axis != axis) continue;
        populations.visit(
            [&](const auto& rows) { pack(rows, face.*sending, face.sent); });
        MPI_Isend(face.sent.data(), static_cast<int>(face.sent.size()), MPI_BYTE,
                  face.rank, face.side, comm_, &requests.emplace_back());
    }
    MPI_Waitall(static_cast<int>(requests.size()), requests.data(), MPI_STATUSES_IGNORE);
    for (const Face& face : faces_) {
        if (face.axis != axis) continue;
        populations.visit(
            [&](const auto& rows) { unpack(rows, face.*receiving, face.received); });
    }
}

void Halo::fill(const Populations& populations) {
    exchange(1, populations, &Face::lent, &Face::borrowed);
    exchange(2, populations, &Face::lent, &Face::borrowed);
}

void Halo::give_back(const Populations& populations) {
    exchange(2, populations, &Face::borrowed, &Face::lent);
    exchange(1, populations, &Face::borrowed, &Face::lent);
}

}  // namespace magfsi::fluid
