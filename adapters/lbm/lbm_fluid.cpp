#include "adapters/lbm/lbm_fluid.h"

#include <fmt/format.h>

#include <stdexcept>

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

// Values of so many rows of a plane: x is never cut between ranks.
std::size_t values_of(const fluid::Fluid& fluid, int rows) {
    return static_cast<std::size_t>(rows) *
           static_cast<std::size_t>(fluid.config().cells[0]) *
           fluid::populations_per_cell;
}

// The parts of all ranks in one plane, on the root.
void collect_plane(MPI_Comm comm, const fluid::Fluid& fluid, int z,
                   std::span<double> plane) {
    int rank = 0;
    MPI_Comm_rank(comm, &rank);
    const auto& boxes = fluid.owned_by_rank();
    for (std::size_t r = 0; r < boxes.size(); ++r) {
        const auto owner = static_cast<int>(r);
        if (z < boxes[r].lo[2] || z >= boxes[r].hi[2]) continue;
        if (rank != 0 && rank != owner) continue;
        const std::size_t count = values_of(fluid, boxes[r].hi[1] - boxes[r].lo[1]);
        std::vector<double> sent(rank == 0 ? 0 : count);
        const std::span<double> part =
            rank == 0 ? plane.subspan(values_of(fluid, boxes[r].lo[1]), count)
                      : std::span<double>(sent);
        if (rank == owner) fluid.populations(z, part);
        if (owner == 0) continue;
        const int n = static_cast<int>(count);
        if (rank == owner) MPI_Send(part.data(), n, MPI_DOUBLE, 0, z, comm);
        if (rank == 0)
            MPI_Recv(part.data(), n, MPI_DOUBLE, owner, z, comm, MPI_STATUS_IGNORE);
    }
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

double LbmFluid::quantity(scene::FluidQuantity quantity) {
    if (quantity == scene::FluidQuantity::enstrophy) return fluid_.enstrophy_1_s2();
    throw std::logic_error("no probe of the lattice-Boltzmann fluid");
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

void LbmFluid::save(coupler::StateWriter* file) {
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
}

void LbmFluid::restore(const coupler::StateReader& file) {
    if (file.shape(table) != shape_of(fluid_)) {
        throw coupler::StateFault(fmt::format(
            "--restart: the checkpoint's box has {} cells (z, y, x, "
            "direction), this run's {}",
            fmt::join(file.shape(table), " x "), fmt::join(shape_of(fluid_), " x ")));
    }
    const fluid::CellBox box = fluid_.owned();
    const coupler::StateHeader& header = file.header();
    // Steps of this run in one of the state's.
    const std::int64_t steps = header.steps_in_one(fluid_.config().time_step_s);
    const auto change = fluid::step_change(fluid_.config(), header.step_s);
    fluid_.set_steps_done(header.step * steps);
    std::vector<double> rows(values_of(fluid_, box.hi[1] - box.lo[1]));
    for (int z = box.lo[2]; z < box.hi[2]; ++z) {
        file.rows(table, static_cast<std::size_t>(z), static_cast<std::size_t>(box.lo[1]),
                  static_cast<std::size_t>(box.hi[1]), rows);
        if (steps > 1) fluid::change_step(change, rows);
        fluid_.set_populations(z, rows);
    }
}

}  // namespace magfsi::lbm
