#include "adapters/lbm/fluid_state.h"

#include <fmt/format.h>

#include "coupler/checkpoint/state_file.h"
#include "fluid_lbm/sampling/step_change.h"

namespace magfsi::lbm {

namespace {

constexpr const char* table = "populations";

// [z][y][x][direction]
std::vector<std::size_t> shape_of(const fluid::Fluid& fluid) {
    const auto& n = fluid.config().cells;
    return {static_cast<std::size_t>(n[2]), static_cast<std::size_t>(n[1]),
            static_cast<std::size_t>(n[0]), fluid::populations_per_cell};
}

// Values of the rows y_lo to y_hi of a plane: x is never cut between ranks.
std::size_t values_of(const fluid::Fluid& fluid, const fluid::CellBox& box) {
    return static_cast<std::size_t>(box.hi[1] - box.lo[1]) *
           static_cast<std::size_t>(fluid.config().cells[0]) *
           fluid::populations_per_cell;
}

std::size_t first_value_of(const fluid::Fluid& fluid, const fluid::CellBox& box) {
    return static_cast<std::size_t>(box.lo[1]) *
           static_cast<std::size_t>(fluid.config().cells[0]) *
           fluid::populations_per_cell;
}

bool holds(const fluid::CellBox& box, int plane) {
    return plane >= box.lo[2] && plane < box.hi[2];
}

// The parts of all ranks in one plane, on the root.
void collect_plane(MPI_Comm comm, const fluid::Fluid& fluid, int z,
                   std::span<double> plane) {
    int rank = 0;
    MPI_Comm_rank(comm, &rank);
    const auto& boxes = fluid.owned_by_rank();
    for (std::size_t r = 0; r < boxes.size(); ++r) {
        const auto owner = static_cast<int>(r);
        if (!holds(boxes[r], z) || (rank != 0 && rank != owner)) continue;
        const std::size_t count = values_of(fluid, boxes[r]);
        std::vector<double> sent(rank == 0 ? 0 : count);
        const std::span<double> part =
            rank == 0 ? plane.subspan(first_value_of(fluid, boxes[r]), count)
                      : std::span<double>(sent);
        if (rank == owner) fluid.populations(z, part);
        if (owner == 0) continue;
        const int n = static_cast<int>(count);
        if (rank == owner) MPI_Send(part.data(), n, MPI_DOUBLE, 0, z, comm);
        if (rank == 0)
            MPI_Recv(part.data(), n, MPI_DOUBLE, owner, z, comm, MPI_STATUS_IGNORE);
    }
}

struct StepOfRestart {
    std::int64_t steps = 1;  // of the run in one of the state's
    fluid::StepChange factors;
};

StepOfRestart step_change(const coupler::StateHeader& header, const fluid::Fluid& fluid) {
    const double step_s = fluid.config().time_step_s;
    return {header.steps_in_one(step_s),
            fluid::step_change(fluid.config(), header.step_s)};
}

}  // namespace

void save_fluid(MPI_Comm comm, const fluid::Fluid& fluid,
                const coupler::BalanceRecord* balance, coupler::StateWriter* file) {
    const auto shape = shape_of(fluid);
    const bool whole = fluid.config().precision == fluid::Precision::double_;
    if (file)
        file->begin_table(table, shape,
                          whole ? coupler::StoredAs::double_ : coupler::StoredAs::float_);
    std::vector<double> plane(file ? shape[1] * shape[2] * shape[3] : 0);
    for (int z = 0; z < fluid.config().cells[2]; ++z) {
        collect_plane(comm, fluid, z, plane);
        if (file) file->plane(static_cast<std::size_t>(z), plane);
    }
    if (!balance) return;
    const auto mine = balance->values();
    const auto all = coupler::gather_shares(comm, mine);
    if (file && !mine.empty())
        file->table("balance", all, {all.size() / mine.size(), mine.size()});
}

void restore_fluid(MPI_Comm comm, const coupler::StateReader& file, fluid::Fluid& fluid,
                   coupler::BalanceRecord* balance) {
    if (file.shape(table) != shape_of(fluid)) {
        throw coupler::StateFault(fmt::format(
            "--restart: the checkpoint's box has {} cells (z, y, x, "
            "direction), this run's {}",
            fmt::join(file.shape(table), " x "), fmt::join(shape_of(fluid), " x ")));
    }
    const fluid::CellBox box = fluid.owned();
    const auto change = step_change(file.header(), fluid);
    fluid.set_steps_done(file.header().step * change.steps);
    std::vector<double> rows(values_of(fluid, box));
    for (int z = box.lo[2]; z < box.hi[2]; ++z) {
        file.rows(table, static_cast<std::size_t>(z), static_cast<std::size_t>(box.lo[1]),
                  static_cast<std::size_t>(box.hi[1]), rows);
        if (change.steps > 1) fluid::change_step(change.factors, rows);
        fluid.set_populations(z, rows);
    }
    if (balance && file.has("balance")) {
        balance->set(
            coupler::share_of(comm, file.table("balance"), file.shape("balance")[0]));
    }
}

}  // namespace magfsi::lbm
