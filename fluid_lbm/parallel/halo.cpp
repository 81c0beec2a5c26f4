#include "fluid_lbm/parallel/halo.h"

#include <algorithm>

namespace magfsi::fluid {

Halo::Halo(MPI_Comm comm, const Decomposition& decomposition, int rank,
           const Populations& populations)
    : comm_(comm), memory_(populations.memory()) {
    const RowLayout layout = decomposition.layout(rank);
    for (int axis = 1; axis <= 2; ++axis) {
        const int count = axis == 1 ? layout.ny : layout.nz;
        for (int side = 0; side < 2; ++side) {
            const int neighbor = decomposition.neighbor(rank, axis, side);
            if (neighbor == no_rank) continue;
            const int outward = side == 0 ? -1 : 1;
            const int ghost = side == 0 ? -1 : count,
                      outermost = side == 0 ? 0 : count - 1;
            faces_.push_back({neighbor, axis, side,
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
    MPI_Waitall(static_cast<int>(requests_.size()), requests_.data(),
                MPI_STATUSES_IGNORE);
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
