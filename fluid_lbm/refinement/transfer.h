// SPDX-License-Identifier: GPL-2.0-or-later
// Transfer of numbers of cells from the ranks that own the cells to the ranks that want
// them: between two levels of a refined grid, or two places of one patch. All ranks know
// who owns and who wants which cells, so that no request is sent.
#pragma once

#include <mpi.h>

#include <functional>
#include <vector>

#include "base/grid/cells.h"

namespace magfsi::fluid {

// One pattern of such messages, found once and run any number of times.
class CellTransfer {
  public:
    // owned, wanted: boxes of each rank; wanted cells that no rank owns are left out.
    // period: number of cells along each periodic axis, else 0; cells a period apart are
    // the same.
    CellTransfer(MPI_Comm comm, const std::vector<std::vector<CellBox>>& owned,
                 const std::array<int, 3>& period,
                 const std::vector<std::vector<CellBox>>& wanted);

    // Numbers travel by rows of cells: the first number of all cells, then the second
    // one, and so on. Read writes the numbers of a row in the rank's own box `box` to
    // `numbers`; Take receives those of a row in its wanted box `box`, in the indices of
    // that box.
    using Read =
        std::function<void(std::size_t box, const CellRow& row, double* numbers)>;
    using Take =
        std::function<void(std::size_t box, const CellRow& row, const double* numbers)>;
    // Pass replaces both for a row that this rank owns and wants, to avoid a copy.
    using Pass = std::function<void(std::size_t owned_box, const CellRow& owned_row,
                                    std::size_t box, const CellRow& row)>;
    // Runs the transfer. Collective.
    void run(std::size_t numbers_per_cell, const Read& read, const Take& take,
             const Pass& pass = {});

  private:
    // Cells that go from a box of one rank to a box of another, or of the same.
    struct Part {
        int rank = 0;                   // the other rank
        std::size_t from = 0, box = 0;  // numbers of the owned and of the wanted box
        CellBox cells;                  // in the indices of the wanted box
        std::array<int, 3> image;       // shift from the owner's indices to these
    };
    // Number of cells of the parts that concern a rank.
    static std::size_t cells_with(const std::vector<Part>& parts, int rank);
    void pass_to_itself(const Pass& pass) const;

    MPI_Comm comm_;
    int rank_ = 0;
    // Parts by rank; cells that stay on this rank are in in_ alone.
    std::vector<Part> out_, in_;
    std::vector<int> to_, from_;  // the other ranks in out_ and in_
    std::vector<std::vector<double>> sent_, received_;
    std::vector<double> row_;
};

// The boxes as lists of one box per rank.
std::vector<std::vector<CellBox>> one_each(const std::vector<CellBox>& boxes);

}  // namespace magfsi::fluid
