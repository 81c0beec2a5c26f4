#include "adapters/lbm/lbm_fluid.h"

#include <fmt/format.h>

#include "adapters/lbm/fluid_probes.h"
#include "adapters/lbm/fluid_state.h"
#include "coupler/participants/errors.h"
#include "isa/instruction_set.h"

namespace magfsi::lbm {

LbmFluid::LbmFluid(MPI_Comm comm, fluid::Fluid& fluid) : comm_(comm), fluid_(fluid) {
    const fluid::FluidConfig& config = fluid.config();
    grid_.spacing_m = config.spacing_m;
    grid_.cells = config.cells;
    grid_.periodic = fluid::periodic_axes(config);
    for (const fluid::CellBox& box : fluid.owned_by_rank()) {
        grid_.owned_by_rank.push_back({box.lo, box.hi});
    }
    for (const fluid::CellRow& r : fluid.solid_rows())
        grid_.solid.push_back({r.y, r.z, r.x_begin, r.x_end});
}

std::span<const fluid::CellRow> LbmFluid::convert(
    std::span<const coupler::GridRow> rows) {
    rows_.clear();
    for (const coupler::GridRow& r : rows)
        rows_.push_back({r.y, r.z, r.x_begin, r.x_end});
    return rows_;
}

void LbmFluid::velocity(std::span<const coupler::GridRow> rows, std::span<double> out) {
    fluid_.velocity(convert(rows), out);
}

void LbmFluid::set_force(std::span<const coupler::GridRow> rows,
                         std::span<const double> density) {
    fluid_.set_force(convert(rows), density);
}

void LbmFluid::advance() {
    fluid_.step();
}

void LbmFluid::keep() {
    fluid_.keep();
}

void LbmFluid::go_back() {
    fluid_.go_back();
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

std::vector<double> LbmFluid::probe_values(const scene::Scene& scene) {
    return lbm::probe_values(scene, fluid_);
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

double LbmFluid::waited_for_neighbors_s() const {
    return fluid_.waited_for_neighbours_s();
}

void LbmFluid::save(const coupler::BalanceRecord* balance, coupler::StateWriter* file) {
    save_fluid(comm_, fluid_, balance, file);
}

void LbmFluid::restore(const coupler::StateReader& file,
                       coupler::BalanceRecord* balance) {
    restore_fluid(comm_, file, fluid_, balance);
}

}  // namespace magfsi::lbm
