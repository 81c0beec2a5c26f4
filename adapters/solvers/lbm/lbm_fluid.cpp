// SPDX-License-Identifier: GPL-2.0-or-later
#include "adapters/solvers/lbm/lbm_fluid.h"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

#include "adapters/solvers/lbm/fluid_state.h"
#include "base/isa/instruction_set.h"
#include "coupler/participants/errors.h"

namespace magfsi::lbm {

namespace {

constexpr const char* table = "populations";

// Sets 1 in this rank's cells that lie inside obstacles, 0 in the others. Collective.
void mark_obstacles(const fluid::Fluid& fluid, std::span<float> out) {
    std::ranges::fill(out, 0.0F);
    const fluid::CellBox box = fluid.owned();
    const int nx = box.hi[0] - box.lo[0], ny = box.hi[1] - box.lo[1];
    for (const CellRow& row : fluid.solid_rows()) {
        if (row.y < box.lo[1] || row.y >= box.hi[1] || row.z < box.lo[2] ||
            row.z >= box.hi[2])
            continue;
        const int first = std::max(row.x_begin, box.lo[0]) - box.lo[0];
        const int end = std::min(row.x_end, box.hi[0]) - box.lo[0];
        const int start = ((row.z - box.lo[2]) * ny + row.y - box.lo[1]) * nx;
        for (int x = first; x < end; ++x) out[start + x] = 1;
    }
}

}  // namespace

void sample(const fluid::Fluid& fluid, scene::FluidField field, std::span<float> out) {
    std::vector<float> other;
    switch (field) {
        case scene::FluidField::velocity:
            other.resize(out.size() / 3);
            fluid.macroscopic(out, other);
            break;
        case scene::FluidField::density:
            other.resize(out.size() * 3);
            fluid.macroscopic(other, out);
            break;
        case scene::FluidField::vorticity:
            fluid.vorticity(out);
            break;
        case scene::FluidField::pressure:
            fluid.pressure(out);
            break;
        case scene::FluidField::obstacle:
            mark_obstacles(fluid, out);
            break;
    }
}

LbmFluid::LbmFluid(MPI_Comm comm, fluid::Fluid& fluid) : comm_(comm), fluid_(fluid) {
    const fluid::FluidConfig& config = fluid.config();
    grid_.spacing_m = config.spacing_m;
    grid_.cells = config.cells;
    grid_.periodic = fluid::periodic_axes(config);
    for (const fluid::CellBox& box : fluid.owned_by_rank())
        grid_.owned_by_rank.push_back({box});
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

double LbmFluid::quantity(scene::FluidQuantity quantity) {
    if (quantity == scene::FluidQuantity::enstrophy) return fluid_.enstrophy_1_s2();
    throw std::logic_error("no probe of the lattice-Boltzmann fluid");
}

void LbmFluid::field(scene::FluidField field, std::size_t, std::span<float> out) {
    sample(fluid_, field, out);
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
    lbm::save(comm_, fluid_, table, file);
}

// A checkpoint of a longer coupled step counts as several of this run's (a retry with
// halved steps).
void LbmFluid::restore(const coupler::StateReader& file) {
    const std::int64_t steps = steps_in_one(fluid_, file);
    fluid_.set_steps_done(file.header().step * steps);
    lbm::restore(fluid_, table, steps, file);
}

}  // namespace magfsi::lbm
