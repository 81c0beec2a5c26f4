// SPDX-License-Identifier: GPL-2.0-or-later
// Sums over cells weigh each cell with its volume. Checkpoint tables are indexed by the
// cells and faces of the whole box.
#include "adapters/solvers/openfoam/flow.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "adapters/solvers/openfoam/mesh.h"
#include "coupler/checkpoint/rank_rows.h"
#include "coupler/checkpoint/state_file.h"

namespace magfsi::openfoam {

namespace {

// |v|^2 / 2 of a vector.
double half_square(const double* v) {
    return (v[0] * v[0] + v[1] * v[1] + v[2] * v[2]) / 2;
}

}  // namespace

std::size_t cell_count(const Widths& width_m) {
    return width_m[0].size() * width_m[1].size() * width_m[2].size();
}

std::array<std::size_t, 3> index_of(const Widths& width_m, std::size_t cell) {
    const std::size_t row = cell / width_m[0].size();
    return {cell % width_m[0].size(), row % width_m[1].size(), row / width_m[1].size()};
}

// Cells are bricks between the planes of the three axes.
double volume(const Widths& width_m, std::size_t cell) {
    const auto i = index_of(width_m, cell);
    return width_m[0][i[0]] * width_m[1][i[1]] * width_m[2][i[2]];
}

// max_speed_m_s ignores NaN (fmax); fastest_cell reports it.
FlowSums flow_sums(MPI_Comm comm, const Widths& width_m, const double* velocity,
                   std::span<const double> vorticity) {
    enum { space, x, y, z, energy, enstrophy, count };
    std::array<double, count> sum{};
    double most = 0;
    for (std::size_t cell = 0; cell < cell_count(width_m); ++cell) {
        const double v = volume(width_m, cell);
        const double e = half_square(velocity + 3 * cell);
        sum[space] += v;
        for (std::size_t d = 0; d < 3; ++d) sum[x + d] += v * velocity[3 * cell + d];
        sum[energy] += v * e;
        most = std::fmax(most, e);
        if (!vorticity.empty())
            sum[enstrophy] += v * half_square(vorticity.data() + 3 * cell);
    }
    MPI_Allreduce(MPI_IN_PLACE, sum.data(), count, MPI_DOUBLE, MPI_SUM, comm);
    MPI_Allreduce(MPI_IN_PLACE, &most, 1, MPI_DOUBLE, MPI_MAX, comm);
    return {sum[space],
            {sum[x], sum[y], sum[z]},
            sum[energy],
            sum[enstrophy] / sum[space],
            std::sqrt(2 * most)};
}

// The comparison is false for NaN, so that the first NaN ends the search as the fastest
// cell.
FastestCell fastest_cell(std::size_t cells, const double* velocity) {
    FastestCell fastest;
    double most = -1;
    for (std::size_t cell = 0; cell < cells; ++cell) {
        const double e = half_square(velocity + 3 * cell);
        if (e <= most) continue;
        most = e;
        fastest.cell = cell;
        if (std::isnan(e)) break;
    }
    fastest.speed_m_s = std::sqrt(2 * most);
    return fastest;
}

namespace {

// Row of a cell in a checkpoint: velocity, velocity of the step before, pressure.
constexpr std::size_t values_per_cell = 7;
constexpr std::array<const char*, 3> flux_table = {"flux_x", "flux_y", "flux_z"};

// This rank's block of cells, or of faces across an axis, within the whole box. Both
// ranks hold the faces between them: `skip` is the number of layers, 0 or 1, at the lower
// end that the rank below saves.
struct Part {
    std::array<int, 3> whole{}, first{}, mine{};
    int skip = 0;
    std::size_t cut = 0;

    std::size_t count() const {
        return static_cast<std::size_t>(whole[0]) * static_cast<std::size_t>(whole[1]) *
               static_cast<std::size_t>(whole[2]);
    }
    // Calls visit(index in the whole box, index in this rank's block), leaving out the
    // layers before `from`.
    template <class Visit>
    void for_each(int from, Visit&& visit) const {
        std::size_t local = 0;
        for (int k = 0; k < mine[2]; ++k) {
            for (int j = 0; j < mine[1]; ++j) {
                for (int i = 0; i < mine[0]; ++i, ++local) {
                    const std::array<int, 3> at{i, j, k};
                    if (at[cut] < from) continue;
                    visit((first[0] + i) +
                              whole[0] * ((first[1] + j) + whole[1] * (first[2] + k)),
                          local);
                }
            }
        }
    }
};

// Block of the faces across `axis`, or of the cells for axis 3.
Part part_of(const BoxMesh& mesh, std::size_t axis) {
    Part part;
    part.whole = part.mine = mesh_cells(mesh);
    part.cut = mesh.cut_axis;
    const std::size_t rank = mesh.rank;
    part.first[part.cut] = mesh.first_cell[rank];
    part.mine[part.cut] = mesh.first_cell[rank + 1] - mesh.first_cell[rank];
    if (axis == 3) return part;
    ++part.whole[axis];
    ++part.mine[axis];
    if (axis == part.cut && mesh.rank > 0) part.skip = 1;
    return part;
}

// Gathers the rows of all ranks on the root, which writes them as one table. Collective.
void save_rows(MPI_Comm comm, const Part& part, std::span<const double> rows,
               std::size_t width, const char* table, coupler::StateWriter* file) {
    std::vector<int> index;
    std::vector<double> mine;
    part.for_each(part.skip, [&](int place, std::size_t local) {
        index.push_back(place);
        const auto row = rows.subspan(local * width, width);
        mine.insert(mine.end(), row.begin(), row.end());
    });
    const auto all = coupler::gather_rows(comm, index, mine, width, part.count());
    if (file) file->table(table, all, {part.count(), width});
}

// Reads this rank's rows, including faces shared with the rank below.
std::vector<double> load_rows(const coupler::StateReader& file, const char* table,
                              const Part& part, std::size_t width) {
    const std::vector<std::size_t> wanted{part.count(), width};
    if (file.shape(table) != wanted) {
        throw coupler::StateFault(fmt::format(
            "--restart: the checkpoint's table {} is {}, this run's {}: it is "
            "of another mesh; start without --restart",
            table, fmt::join(file.shape(table), " x "), fmt::join(wanted, " x ")));
    }
    const std::vector<double> all = file.table(table);
    std::vector<double> rows;
    part.for_each(0, [&](int place, std::size_t) {
        const auto row = all.begin() + static_cast<std::ptrdiff_t>(width) * place;
        rows.insert(rows.end(), row, row + static_cast<std::ptrdiff_t>(width));
    });
    return rows;
}

}  // namespace

namespace {

// The rows of the table of cells.
std::vector<double> rows_of_cells(const FlowState& state) {
    std::vector<double> cells;
    for (std::size_t c = 0; c < state.pressure.size(); ++c) {
        for (const auto* velocity : {&state.velocity, &state.old_velocity}) {
            for (std::size_t d = 0; d < 3; ++d) cells.push_back((*velocity)[3 * c + d]);
        }
        cells.push_back(state.pressure[c]);
    }
    return cells;
}

// The inverse.
FlowState state_of(const std::vector<double>& cells) {
    FlowState state;
    for (std::size_t c = 0; c < cells.size(); c += values_per_cell) {
        const auto row = cells.begin() + static_cast<std::ptrdiff_t>(c);
        state.velocity.insert(state.velocity.end(), row, row + 3);
        state.old_velocity.insert(state.old_velocity.end(), row + 3, row + 6);
        state.pressure.push_back(row[6]);
    }
    return state;
}

}  // namespace

// Writes one table for the cells and one for the faces across each axis.
void save_flow(MPI_Comm comm, const BoxMesh& mesh, const FlowState& state,
               coupler::StateWriter* file) {
    save_rows(comm, part_of(mesh, 3), rows_of_cells(state), values_per_cell, "cells",
              file);
    for (std::size_t d = 0; d < 3; ++d)
        save_rows(comm, part_of(mesh, d), state.flux[d], 1, flux_table[d], file);
}

// The inverse of save_flow, on any number of ranks.
FlowState load_flow(const BoxMesh& mesh, const coupler::StateReader& file) {
    FlowState state =
        state_of(load_rows(file, "cells", part_of(mesh, 3), values_per_cell));
    for (std::size_t d = 0; d < 3; ++d)
        state.flux[d] = load_rows(file, flux_table[d], part_of(mesh, d), 1);
    return state;
}

void save_listed_flow(const FlowState& state, coupler::StateWriter* file) {
    if (!file) return;
    file->table("cells", rows_of_cells(state), {state.pressure.size(), values_per_cell});
    file->table("face_flux", state.face_flux, {state.face_flux.size(), 1});
}

// The mesh is made anew by the same programs from the same dictionaries; the numbers of
// its cells and faces tell whether it is the same.
FlowState load_listed_flow(const Engine* engine, const coupler::StateReader& file) {
    FlowState now;
    engine->keep(now);
    FlowState state = state_of(file.table("cells"));
    if (file.has("face_flux")) state.face_flux = file.table("face_flux");
    if (state.pressure.size() != now.pressure.size() ||
        state.face_flux.size() != now.face_flux.size()) {
        throw coupler::StateFault(fmt::format(
            "--restart: the checkpoint has {} cells and {} faces, this run's mesh {} and "
            "{}: it is of another mesh; start without --restart",
            state.pressure.size(), state.face_flux.size(), now.pressure.size(),
            now.face_flux.size()));
    }
    return state;
}

}  // namespace magfsi::openfoam
