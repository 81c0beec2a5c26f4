// SPDX-License-Identifier: GPL-2.0-or-later
// Exchange of populations between ranks. In-place streaming needs it in the swapped
// arrangement only: a rank borrows the 5 populations per face whose slots lie in its
// neighbours' rows but belong to its own (fill), steps, and returns them (give_back).
//
// Faces along y go first when filling and last when returning; those along z include the
// ghost rows of y, so that edges pass through a common neighbour. Only what the other
// rank will use is lent: the owner uses the rest itself, to bounce populations off walls,
// and stale values coming back would overwrite that.
#pragma once

#include <mpi.h>

#include <vector>

#include "fluid_lbm/lattice/populations.h"
#include "fluid_lbm/parallel/decomposition.h"

namespace magfsi::fluid {

// The slots that travel over one face, as an MPI datatype on the populations' memory: MPI
// moves them from one rank's arrays into the other's, and no buffer of ours lies between.
class SlotsType {
  public:
    // Slots with velocity component `sign` along the axis (1: y, 2: z) in the rows at
    // index `row` of it, limited to those whose user (the row at -c_q from the slot) lies
    // across the face.
    SlotsType(const RowLayout& layout, const Populations& populations, int axis, int sign,
              int row);
    ~SlotsType();
    SlotsType(SlotsType&& other) noexcept;
    SlotsType(const SlotsType&) = delete;
    SlotsType& operator=(const SlotsType&) = delete;

    MPI_Datatype get() const { return type_; }  // relative to populations.memory()

  private:
    MPI_Datatype type_ = MPI_DATATYPE_NULL;
};

enum class Exchange { fill, give_back };

class Halo {
  public:
    // comm and populations must outlive the object; the ranks of comm are those of the
    // decomposition.
    Halo(MPI_Comm comm, const Decomposition& decomposition, int rank,
         const Populations& populations);

    // Collective among neighbours, in this order, with computation between: the rows at
    // cut sides must be done before start() and no other row touches what travels.
    // advance() ends the first axis and starts the second; finish() ends all.
    void start(Exchange exchange);
    void advance();
    void finish();

    // Seconds spent waiting for neighbours so far.
    double waited_s() const { return waited_s_; }

  private:
    struct Face {
        int rank, axis, side;
        SlotsType borrowed;  // in my ghost rows
        SlotsType lent;      // in my rows
    };

    void send(int axis);
    void send_next();
    void wait();

    MPI_Comm comm_;
    void* memory_;
    std::vector<Face> faces_;
    Exchange exchange_ = Exchange::fill;
    std::vector<int> axes_left_;
    std::vector<MPI_Request> requests_;  // of the axis under way
    double waited_s_ = 0;
};

}  // namespace magfsi::fluid
