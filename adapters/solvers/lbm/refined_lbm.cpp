// SPDX-License-Identifier: GPL-2.0-or-later
#include "adapters/solvers/lbm/refined_lbm.h"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

#include "adapters/solvers/lbm/fluid_state.h"
#include "adapters/solvers/lbm/lbm_fluid.h"
#include "base/isa/instruction_set.h"
#include "coupler/participants/errors.h"

namespace magfsi::lbm {

namespace {

// Tables of a checkpoint beside the populations of each patch. "patches": for each finer
// patch the box of cells of the next coarser level that it covers, six numbers (lo, hi),
// nest by nest and level by level within it. "mass_owed": two numbers per patch that keep
// the mass constant (RefinedFluid::kept_mass).
constexpr const char* places_table = "patches";
constexpr const char* mass_table = "mass_owed";

// "" for level 0, else "_WORDl", with "_nestN" from the second nest on.
std::string suffix(const std::string& word, int level, int nest) {
    if (level == 0) return "";
    return nest == 0 ? fmt::format("_{}{}", word, level)
                     : fmt::format("_{}{}_nest{}", word, level, nest + 1);
}

// Name of the table with a patch's populations.
std::string table_of(int level, int nest) {
    return "populations" + suffix("", level, nest);
}

std::int64_t cells_in(const fluid::Fluid& fluid) {
    const auto& n = fluid.config().cells;
    return static_cast<std::int64_t>(n[0]) * n[1] * n[2];
}

// The boxes of all nests as a flat list, the "patches" table of a checkpoint.
std::vector<double> numbers_of(const std::vector<fluid::NestPlaces>& nests) {
    std::vector<double> numbers;
    for (const fluid::NestPlaces& nest : nests) {
        for (const fluid::LevelPlace& place : nest) {
            const fluid::CellBox box = place.covered();
            numbers.insert(numbers.end(), box.lo.begin(), box.lo.end());
            numbers.insert(numbers.end(), box.hi.begin(), box.hi.end());
        }
    }
    return numbers;
}

// The nests that such a list describes; each box lies in the cells of the level before.
std::vector<fluid::NestPlaces> places_of(const std::vector<double>& numbers,
                                         const fluid::RefinedConfig& config) {
    const auto periodic = fluid::periodic_axes(config.coarse);
    const std::size_t levels = config.rule.levels;
    std::vector<fluid::NestPlaces> nests;
    for (std::size_t i = 0; i + 6 <= numbers.size(); i += 6) {
        fluid::CellBox box;
        for (std::size_t d = 0; d < 3; ++d) {
            box.lo[d] = numbers[i + d];
            box.hi[d] = numbers[i + 3 + d];
        }
        if (nests.empty() || nests.back().size() == levels) nests.emplace_back();
        const fluid::LevelPlace below =
            nests.back().empty() ? fluid::coarsest_place(config.coarse.cells, periodic)
                                 : nests.back().back();
        nests.back().push_back(fluid::finer_place(below, periodic, box));
    }
    return nests;
}

}  // namespace

RefinedLbm::RefinedLbm(MPI_Comm comm, fluid::RefinedFluid& fluid,
                       const coupler::Renewal& renewal)
    : comm_(comm), fluid_(fluid) {
    const int finest = fluid.levels() - 1;
    grid_.spacing_m = fluid.level(finest).config().spacing_m;
    grid_.cells = fluid.place(finest).domain;
    grid_.periodic = fluid::periodic_axes(fluid.config().coarse);
    grid_.owned_by_rank = fluid.owned_by_rank();
    grid_.solid = fluid.solid_rows();
    grid_.follows = true;
    grid_.renewal = renewal;
}

void RefinedLbm::follow(const std::vector<std::array<scene::Vec3, 2>>& bodies_m) {
    try {
        if (fluid_.follow(bodies_m)) grid_.owned_by_rank = fluid_.owned_by_rank();
    } catch (const std::invalid_argument& fault) {
        throw coupler::Diverged(fault.what());
    }
}

std::vector<RefinedLbm::Patch> RefinedLbm::patches() const {
    std::vector<Patch> all{{0, 0}};
    for (int l = 1; l < fluid_.levels(); ++l)
        for (int nest = 0; nest < fluid_.nests(); ++nest) all.push_back({l, nest});
    return all;
}

std::string RefinedLbm::headline() const {
    std::string text;
    for (const auto [l, nest] : patches()) {
        const fluid::FluidConfig& c = fluid_.level(l, nest).config();
        text += fmt::format(
            "{}{} x {} x {} cells of {:.4g} mm, step {:.4g} us, "
            "relaxation time {:.5g}, {}",
            l == 0 ? "" : "; refined ", c.cells[0], c.cells[1], c.cells[2],
            c.spacing_m * 1e3, c.time_step_s * 1e6, fluid::relaxation_time(c),
            name_of(fluid::choose_collision(c)));
    }
    return text + fmt::format("; {} kernels", name(choose_instruction_set()));
}

fluids::FluidTotals RefinedLbm::totals() {
    const fluid::Totals all = fluid_.totals();
    return {all.kinetic_energy_j, all.mass_kg, all.max_speed_m_s, all.momentum_kg_m_s,
            all.sound_energy_j};
}

double RefinedLbm::quantity(scene::FluidQuantity quantity) {
    if (quantity == scene::FluidQuantity::enstrophy) return fluid_.enstrophy_1_s2();
    throw std::logic_error("no probe of the lattice-Boltzmann fluid");
}

std::vector<fluids::FieldCells> RefinedLbm::field_cells() const {
    std::vector<fluids::FieldCells> all;
    for (const auto [l, nest] : patches()) {
        fluids::FieldCells cells{suffix("level", l, nest),
                                 fluid_.level(l, nest).config().spacing_m,
                                 fluid_.inside_by_rank(l, nest), fluid_.covered(l, nest)};
        all.push_back(std::move(cells));
    }
    return all;
}

// The patch's own ghost cells are left out. Level 0 is first given the values of the
// finer levels where these cover it.
void RefinedLbm::field(scene::FluidField field, std::size_t patch, std::span<float> out) {
    const auto [l, nest] = patches()[patch];
    if (l == 0) fluid_.cover_all();
    const fluid::Fluid& fluid = fluid_.level(l, nest);
    int rank = 0;
    MPI_Comm_rank(comm_, &rank);
    const fluid::CellBox inside = fluid_.inside_by_rank(l, nest)[rank];
    const fluid::CellBox own = fluid.owned();
    const auto& first = fluid_.place(l, nest).stored.lo;
    const std::size_t components = scene::components_of(field);
    std::array<std::size_t, 3> n{};
    for (std::size_t d = 0; d < 3; ++d) n[d] = own.hi[d] - own.lo[d];
    std::vector<float> all(components * n[0] * n[1] * n[2]);
    sample(fluid, field, all);
    float* to = out.data();
    for (int z = inside.lo[2]; z < inside.hi[2]; ++z) {
        for (int y = inside.lo[1]; y < inside.hi[1]; ++y) {
            const auto row = static_cast<std::size_t>(z - first[2] - own.lo[2]) * n[1] +
                             static_cast<std::size_t>(y - first[1] - own.lo[1]);
            const std::size_t x = inside.lo[0] - first[0];
            to = std::copy_n(all.data() + components * (row * n[0] + x),
                             components * (inside.hi[0] - inside.lo[0]), to);
        }
    }
}

void RefinedLbm::check_divergence() {
    const auto fault = fluid_.diverged();
    if (fault) throw coupler::Diverged(fluid::to_string(*fault));
}

// "cells" of the summary is the mean number of cells that a coupled step updates.
output::FluidSummary RefinedLbm::summary() const {
    const fluid::FluidConfig& config = fluid_.level(0).config();
    output::FluidSummary summary;
    const int finest = fluid_.levels() - 1;
    double cells = 0;
    for (const auto [l, nest] : patches())
        cells +=
            std::ldexp(static_cast<double>(cells_in(fluid_.level(l, nest))), l - finest);
    summary.cells = cells;
    summary.relaxation_time = fluid::relaxation_time(config);
    summary.spacing_m = config.spacing_m;
    summary.collision = name_of(fluid::choose_collision(config));
    summary.kernel = name(choose_instruction_set());
    return summary;
}

void RefinedLbm::save(coupler::StateWriter* file) {
    const auto places = numbers_of(fluid_.places());
    const auto mass = fluid_.kept_mass();
    if (file) {
        file->table(places_table, places, {places.size() / 6, 6});
        file->table(mass_table, mass, {mass.size()});
    }
    for (const auto [l, nest] : patches())
        lbm::save(comm_, fluid_.level(l, nest), table_of(l, nest), file);
}

// Places of the patches come first, then their populations. Throws StateFault if the
// checkpoint is of a grid with another number of levels.
void RefinedLbm::restore(const coupler::StateReader& file) {
    const int finest = fluid_.levels() - 1;
    if (!file.has(places_table) || !file.has(table_of(finest, 0)) ||
        file.has(table_of(finest + 1, 0)))
        throw coupler::StateFault(
            fmt::format("--restart: the checkpoint has no grid of {} finer levels, as "
                        "fluid.refinement asks for; start without --restart",
                        finest));
    const std::int64_t steps = steps_in_one(fluid_.level(finest), file);
    fluid_.restore(file.header().step * steps,
                   places_of(file.table(places_table), fluid_.config()),
                   file.has(mass_table) ? file.table(mass_table) : std::vector<double>());
    for (const auto [l, nest] : patches())
        lbm::restore(fluid_.level(l, nest), table_of(l, nest), steps, file);
    grid_.owned_by_rank = fluid_.owned_by_rank();
}

}  // namespace magfsi::lbm
