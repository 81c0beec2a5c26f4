#include "adapters/lbm/lbm_fluid.h"

#include <fmt/format.h>

#include "coupler/participants/errors.h"
#include "fluid_lbm/sampling/step_change.h"
#include "isa/instruction_set.h"

namespace magfsi::lbm {

namespace {

// A checkpoint holds every population by its cell's global index, so that the file is the
// same on any number of ranks.
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

LbmFluid::LbmFluid(MPI_Comm comm, fluid::Fluid& fluid) : comm_(comm), fluid_(fluid) {
    const fluid::FluidConfig& config = fluid.config();
    grid_.spacing_m = config.spacing_m;
    grid_.cells = config.cells;
    grid_.periodic = fluid::periodic_axes(config);
    grid_.owned_by_rank = fluid.owned_by_rank();
    grid_.solid = fluid.solid_rows();
}

std::string LbmFluid::headline() const {
    const fluid::FluidConfig& c = fluid_.config();
    return fmt::format(
        "{} x {} x {} cells of {:.4g} mm, step {:.4g} us, relaxation time {:.5g}, {} "
        "collision, {} kernels",
        c.cells[0], c.cells[1], c.cells[2], c.spacing_m * 1e3, c.time_step_s * 1e6,
        fluid::relaxation_time(c), name_of(fluid::choose_collision(c)),
        name(choose_instruction_set()));
}

fluids::FluidTotals LbmFluid::totals() {
    const fluid::Totals all = fluid_.totals();
    return {all.kinetic_energy_j, all.mass_kg, all.max_speed_m_s};
}

fluids::PlaneFlow LbmFluid::plane_flow(int axis, double at_m) {
    const fluid::PlaneFlow through = fluid_.plane_flow(axis, at_m);
    return {through.flow_m3_s, through.momentum_flux_n, through.pressure_pa};
}

void LbmFluid::field(scene::FluidField field, std::span<float> out) {
    std::vector<float> other;
    switch (field) {
        case scene::FluidField::velocity:
            other.resize(out.size() / 3);
            fluid_.macroscopic(out, other);
            break;
        case scene::FluidField::density:
            other.resize(out.size() * 3);
            fluid_.macroscopic(other, out);
            break;
        case scene::FluidField::vorticity:
            fluid_.vorticity(out);
            break;
    }
}

void LbmFluid::check_divergence() {
    const auto fault = fluid_.diverged();
    if (fault) throw coupler::Diverged(fluid::to_string(*fault));
}

output::FluidSummary LbmFluid::summary() const {
    const fluid::FluidConfig& config = fluid_.config();
    const auto& n = config.cells;
    output::FluidSummary summary;
    summary.cells = static_cast<std::int64_t>(n[0]) * n[1] * n[2];
    summary.relaxation_time = fluid::relaxation_time(config);
    summary.spacing_m = config.spacing_m;
    summary.collision = name_of(fluid::choose_collision(config));
    summary.kernel = name(choose_instruction_set());
    return summary;
}

void LbmFluid::save(const coupler::BalanceRecord* balance, coupler::StateWriter* file) {
    const auto shape = shape_of(fluid_);
    const bool whole = fluid_.config().precision == fluid::Precision::double_;
    if (file)
        file->begin_table(table, shape,
                          whole ? coupler::StoredAs::double_ : coupler::StoredAs::float_);
    std::vector<double> plane(file ? shape[1] * shape[2] * shape[3] : 0);
    for (int z = 0; z < fluid_.config().cells[2]; ++z) {
        collect_plane(comm_, fluid_, z, plane);
        if (file) file->plane(static_cast<std::size_t>(z), plane);
    }
    if (!balance) return;
    const auto mine = balance->values();
    const auto all = coupler::gather_shares(comm_, mine);
    if (file && !mine.empty())
        file->table("balance", all, {all.size() / mine.size(), mine.size()});
}

void LbmFluid::restore(const coupler::StateReader& file,
                       coupler::BalanceRecord* balance) {
    if (file.shape(table) != shape_of(fluid_)) {
        throw coupler::StateFault(fmt::format(
            "--restart: the checkpoint's box has {} cells (z, y, x, "
            "direction), this run's {}",
            fmt::join(file.shape(table), " x "), fmt::join(shape_of(fluid_), " x ")));
    }
    const fluid::CellBox box = fluid_.owned();
    const auto change = step_change(file.header(), fluid_);
    fluid_.set_steps_done(file.header().step * change.steps);
    std::vector<double> rows(values_of(fluid_, box));
    for (int z = box.lo[2]; z < box.hi[2]; ++z) {
        file.rows(table, static_cast<std::size_t>(z), static_cast<std::size_t>(box.lo[1]),
                  static_cast<std::size_t>(box.hi[1]), rows);
        if (change.steps > 1) fluid::change_step(change.factors, rows);
        fluid_.set_populations(z, rows);
    }
    if (balance && file.has("balance")) {
        balance->set(
            coupler::share_of(comm_, file.table("balance"), file.shape("balance")[0]));
    }
}

}  // namespace magfsi::lbm
