// SPDX-License-Identifier: GPL-2.0-or-later
#include "adapters/solvers/lbm/fluid_state.h"

#include <fmt/format.h>

#include "fluid_lbm/sampling/step_change.h"

namespace magfsi::lbm {

namespace {

// Shape of the table: [z][y][x][direction].
std::vector<std::size_t> shape_of(const fluid::Fluid& fluid) {
    const auto& n = fluid.config().cells;
    return {static_cast<std::size_t>(n[2]), static_cast<std::size_t>(n[1]),
            static_cast<std::size_t>(n[0]), fluid::populations_per_cell};
}

// Number of values in `rows` rows of one plane; rows are whole, since x is never cut
// between ranks.
std::size_t values_of(const fluid::Fluid& fluid, int rows) {
    return static_cast<std::size_t>(rows) *
           static_cast<std::size_t>(fluid.config().cells[0]) *
           fluid::populations_per_cell;
}

// Gathers plane z of the box from the ranks that own parts of it; `plane` is filled on
// rank 0. Collective. The plane's number serves as the message tag.
void collect_plane(MPI_Comm comm, const fluid::Fluid& fluid, int z,
                   std::span<double> plane) {
    int rank = 0;
    MPI_Comm_rank(comm, &rank);
    const auto& boxes = fluid.owned_by_rank();
    for (std::size_t r = 0; r < boxes.size(); ++r) {
        const int owner = r;
        if (z < boxes[r].lo[2] || z >= boxes[r].hi[2]) continue;
        if (rank != 0 && rank != owner) continue;
        const std::size_t count = values_of(fluid, boxes[r].hi[1] - boxes[r].lo[1]);
        std::vector<double> sent(rank == 0 ? 0 : count);
        const std::span<double> part =
            rank == 0 ? plane.subspan(values_of(fluid, boxes[r].lo[1]), count)
                      : std::span<double>(sent);
        if (rank == owner) fluid.populations(z, part);
        if (owner == 0) continue;
        const int n = count;
        if (rank == owner) MPI_Send(part.data(), n, MPI_DOUBLE, 0, z, comm);
        if (rank == 0)
            MPI_Recv(part.data(), n, MPI_DOUBLE, owner, z, comm, MPI_STATUS_IGNORE);
    }
}

}  // namespace

void save(MPI_Comm comm, const fluid::Fluid& fluid, const std::string& table,
          coupler::StateWriter* file) {
    const auto shape = shape_of(fluid);
    const bool whole = fluid.config().precision == fluid::Precision::double_;
    if (file)
        file->begin_table(table, shape,
                          whole ? coupler::StoredAs::double_ : coupler::StoredAs::float_);
    std::vector<double> plane(file ? shape[1] * shape[2] * shape[3] : 0);
    for (int z = 0; z < fluid.config().cells[2]; ++z) {
        collect_plane(comm, fluid, z, plane);
        if (file) file->plane(z, plane);
    }
}

std::int64_t steps_in_one(const fluid::Fluid& finest, const coupler::StateReader& file) {
    return file.header().steps_in_one(finest.config().time_step_s);
}

void restore(fluid::Fluid& fluid, const std::string& table, std::int64_t steps_in_one,
             const coupler::StateReader& file) {
    if (file.shape(table) != shape_of(fluid)) {
        throw coupler::StateFault(fmt::format(
            "--restart: the checkpoint's box has {} cells (z, y, x, "
            "direction), this run's {}; start without --restart",
            fmt::join(file.shape(table), " x "), fmt::join(shape_of(fluid), " x ")));
    }
    const fluid::CellBox box = fluid.owned();
    const double step_s = fluid.config().time_step_s * steps_in_one;
    const auto change = fluid::step_change(fluid.config(), step_s);
    std::vector<double> rows(values_of(fluid, box.hi[1] - box.lo[1]));
    for (int z = box.lo[2]; z < box.hi[2]; ++z) {
        file.rows(table, z, box.lo[1], box.hi[1], rows);
        if (steps_in_one > 1) fluid::change_step(change, rows);
        fluid.set_populations(z, rows);
    }
}

}  // namespace magfsi::lbm
