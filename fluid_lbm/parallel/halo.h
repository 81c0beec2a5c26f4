// SPDX-License-Identifier: GPL-2.0-or-later
// Exchange of populations between ranks. In-place streaming needs it in the swapped
// arrangement only: a rank borrows the 5 populations per face whose slots lie in its
// neighbours' rows but belong to its own rows (fill), steps, and returns them
// (give_back).
//
// Faces along y go first when filling and last when returning; those along z include the
// ghost rows of y, so that edges pass through a common neighbour. Only populations that
// the other rank uses are lent: the owner uses the others itself, to bounce them off
// walls, and stale values that came back would overwrite these.
#pragma once

#include <mpi.h>

#include <vector>

#include "fluid_lbm/lattice/populations.h"
#include "fluid_lbm/parallel/decomposition.h"

namespace magfsi::fluid {

// The slots that travel over one face, as an MPI datatype on the populations' memory. MPI
// moves them from one rank's arrays into the other's without a buffer of ours.
class SlotsType {
  public:
    // The slots with velocity component `sign` along the axis (1 y, 2 z) in the rows at
    // index `row` of that axis, limited to those whose user (the row at -c_q from the
    // slot) lies across the face.
    SlotsType(const RowLayout& layout, const Populations& populations, int axis, int sign,
              int row);
    ~SlotsType();
    SlotsType(SlotsType&& other) noexcept;
    SlotsType(const SlotsType&) = delete;
    SlotsType& operator=(const SlotsType&) = delete;

    MPI_Datatype get() const { return type_; }  // offsets count from populations.memory()

  private:
    MPI_Datatype type_ = MPI_DATATYPE_NULL;
};

// Direction of an exchange: borrow populations before a step, or return them after it.
enum class Exchange { fill, give_back };

// The exchanges of one rank with its neighbours.
class Halo {
  public:
    // comm and populations must outlive the object. The ranks of comm are those of the
    // decomposition.
    Halo(MPI_Comm comm, const Decomposition& decomposition, int rank,
         const Populations& populations);

    // An exchange is a call of start(), advance() and finish(), in this order, collective
    // among neighbours, with computation between them. The rows at cut sides must be
    // finished before start(), and no other row may touch the populations that travel.
    // advance() ends the first axis and starts the second; finish() ends the exchange.
    void start(Exchange exchange);
    void advance();
    void finish();

    // Time [s] spent waiting for neighbours so far.
    double waited_s() const { return waited_s_; }

  private:
    // A side of the rank's box with a neighbour.
    struct Face {
        int rank, axis, side;
        SlotsType borrowed;  // slots in this rank's ghost rows
        SlotsType lent;      // slots in this rank's own rows
    };

    void send(int axis);
    void send_next();
    void wait();

    MPI_Comm comm_;
    void* memory_;
    std::vector<Face> faces_;
    Exchange exchange_ = Exchange::fill;
    std::vector<int> axes_left_;         // axes still to send, the next one last
    std::vector<MPI_Request> requests_;  // requests of the axis under way
    double waited_s_ = 0;
};

}  // namespace magfsi::fluid
