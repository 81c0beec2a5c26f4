// SPDX-License-Identifier: GPL-2.0-or-later
// Numbers of cells from the ranks that own them to those that want them: between two
// levels of a refined grid, or two places of one patch. Who owns and who wants what is
// known to all ranks, so that nothing has to be asked for.
#pragma once

#include <mpi.h>

#include <functional>
#include <vector>

#include "grid/cells.h"

namespace magfsi::fluid {

class CellTransfer {
  public:
    // owned and wanted: boxes of each rank; cells that nobody owns are left out. period:
    // cells along each axis that is periodic, else 0; cells a period apart are the same.
    CellTransfer(MPI_Comm comm, const std::vector<std::vector<CellBox>>& owned,
                 const std::array<int, 3>& period,
                 const std::vector<std::vector<CellBox>>& wanted);

    // Rows of cells with so many numbers each: all first ones, all second ones, ...
    // read: of a row in the rank's own box of that number. take: of a row in its wanted
    // box of that number, in the indices of the box. Collective.
    using Read =
        std::function<void(std::size_t box, const CellRow& row, double* numbers)>;
    using Take =
        std::function<void(std::size_t box, const CellRow& row, const double* numbers)>;
    // pass: of a row that does both on this rank, without a copy on the way.
    using Pass = std::function<void(std::size_t owned_box, const CellRow& owned_row,
                                    std::size_t box, const CellRow& row)>;
    void run(std::size_t numbers_per_cell, const Read& read, const Take& take,
             const Pass& pass = {});

  private:
    // What goes from one rank's box to another's.
    struct Part {
        int rank = 0;  // the other
        std::size_t from = 0, box = 0;
        CellBox cells;             // in the wanted box's indices
        std::array<int, 3> image;  // less these they are the owner's
    };
    static std::size_t cells_with(const std::vector<Part>& parts, int rank);
    void pass_to_itself(const Pass& pass) const;

    MPI_Comm comm_;
    int rank_ = 0;
    std::vector<Part> out_, in_;  // by rank; what stays here is in in_ alone
    std::vector<int> to_, from_;  // ranks of those
    std::vector<std::vector<double>> sent_, received_;
    std::vector<double> row_;
};

// Of each rank one box.
std::vector<std::vector<CellBox>> one_each(const std::vector<CellBox>& boxes);

}  // namespace magfsi::fluid
