// The slots that travel over one face, as an MPI datatype on the populations' memory: MPI
// moves them from one rank's arrays into the other's, and no buffer of ours lies between.
#pragma once

#include <mpi.h>

#include "fluid_lbm/lattice/populations.h"

namespace magfsi::fluid {

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

}  // namespace magfsi::fluid
