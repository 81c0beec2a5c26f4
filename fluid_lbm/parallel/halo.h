// Exchange of populations between ranks. In-place streaming needs it in the swapped
// arrangement only: a rank borrows the 5 populations a face whose slots lie in its
// neighbours' rows but belong to its own (fill), steps, and returns them (give_back).
//
// Faces along y go first when filling and last when returning; those along z include the
// ghost rows of y, so that edges pass through a common neighbour. Only what the other
// rank will use is lent: the owner uses the rest itself, to bounce populations off walls,
// and stale values coming back would overwrite that.
#pragma once

#include <mpi.h>

#include <cstddef>
#include <vector>

#include "fluid_lbm/lattice/populations.h"
#include "fluid_lbm/parallel/decomposition.h"

namespace magfsi::fluid {

enum class Exchange { fill, give_back };

class Halo {
  public:
    // comm must outlive the object; its ranks are those of the decomposition.
    Halo(MPI_Comm comm, const Decomposition& decomposition, int rank);

    // Collective among neighbours, in this order, with computation between: the rows at
    // cut sides must be done before start() and no other row touches what travels.
    // advance() ends the first axis and starts the second; finish() ends all.
    void start(Exchange exchange, const Populations& populations);
    void advance(const Populations& populations);
    void finish(const Populations& populations);

  private:
    struct Slot {
        int q, row;
    };
    struct Face {
        int rank = no_rank, axis = 0, side = 0;
        std::vector<Slot> borrowed;  // in my ghost rows
        std::vector<Slot> lent;      // in my rows
        std::vector<std::byte> sent, received;
    };

    static std::vector<Slot> slots(const RowLayout& layout, int axis, int sign, int row);
    // Cells of a row whose slot q is lent: all but the one at a wall across x.
    int first_lent(int q) const;
    int lent_length(int q) const;
    template <class Real>
    void pack(const PopulationRows<Real>& rows, const std::vector<Slot>& slots,
              std::vector<std::byte>& to) const;
    template <class Real>
    void unpack(const PopulationRows<Real>& rows, const std::vector<Slot>& slots,
                const std::vector<std::byte>& from) const;
    void send(int axis, const Populations& populations);
    void receive(const Populations& populations);

    MPI_Comm comm_;
    int row_length_;
    bool x_walls_;
    std::vector<Face> faces_;
    Exchange exchange_ = Exchange::fill;
    int under_way_ = 0;  // axis; 0: none
    std::vector<int> axes_left_;
    std::vector<MPI_Request> requests_;
};

}  // namespace magfsi::fluid
