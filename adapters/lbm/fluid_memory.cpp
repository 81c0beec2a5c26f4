#include "adapters/lbm/fluid_memory.h"

#include <algorithm>

#include "adapters/lbm/scene_to_fluid.h"
#include "adapters/scene/effective.h"
#include "coupler/exchange/exchange.h"
#include "coupler/immersed_boundary/marker_stencil.h"
#include "fluid_lbm/parallel/decomposition.h"
#include "fluid_lbm/streaming/kernel_choice.h"

namespace magfsi::lbm {

namespace {

// Bytes a cell of what is made of the populations: float in files, double within.
constexpr double file_vector = 12, file_scalar = 4, velocity_field = 24;

double field_bytes(scene::FluidField field) {
    return field == scene::FluidField::density ? file_scalar : file_vector;
}

// Beside the field itself: the other half of what a sweep gives, or the velocities that a
// curl is taken of.
double while_made(scene::FluidField field) {
    switch (field) {
        case scene::FluidField::velocity:
            return file_scalar;
        case scene::FluidField::density:
            return file_vector;
        case scene::FluidField::vorticity:
            break;
    }
    return velocity_field;
}

double output_bytes_a_cell(const scene::FluidOutput& output) {
    double held = 0, peak = 0;
    for (const scene::FluidField field : output.fields) {
        held += field_bytes(field);
        peak = std::max(peak, held + while_made(field));
    }
    return peak;
}

// The only sum that takes velocities beside each other.
bool has_enstrophy(const scene::Scene& scene) {
    return scene.probes && std::ranges::any_of(scene.probes->fluid, [](auto quantity) {
               return quantity == scene::FluidQuantity::enstrophy;
           });
}

// The whole fluid is copied where more than the sweep changes it.
bool keeps_all(const scene::Scene& scene, const fluid::FluidConfig& config) {
    const bool implicit =
        scene.coupling && scene.coupling->scheme == coupler::Scheme::implicit;
    return implicit && !fluid::sweep_is_all(config);
}

// In both sets of touched rows a stencil, a place and a share; three vectors as they come
// and three as they are used, one that goes back, a force and a velocity.
constexpr double marker_bytes =
    2 * (sizeof(coupler::MarkerStencil) + sizeof(coupler::Vec3) + sizeof(double) + 1) +
    9 * sizeof(coupler::Vec3);
// Rows along x. Sheets of markers, some to a cell, touch a thirtieth as many where they
// lie along them and a fifth where they have bent across.
constexpr double rows_a_marker = 0.1;

// Three numbers a cell, with room for half as many rows again, as there is in the mean.
double forced_rows_bytes(double markers, int nx, bool single_precision) {
    return 1.5 * rows_a_marker * markers * 3 * nx *
           (single_precision ? sizeof(float) : sizeof(double));
}

// Those near a cut are known to the ranks on both of its sides.
double known_markers(const scene::Scene& scene, const fluid::Decomposition& parts,
                     std::span<const fluid::Vec3> markers_m) {
    const coupler::Grid grid{scene.fluid->spacing_m, parts.cells, parts.periodic, {}};
    const auto kernel = scene.coupling->immersed_boundary.kernel;
    std::int64_t known = 0;
    for (const fluid::CellBox& box : parts.boxes) {
        known += std::ranges::count_if(markers_m, [&](const fluid::Vec3& at) {
            return coupler::may_touch(grid, kernel, {box.lo, box.hi}, at);
        });
    }
    return static_cast<double>(known);
}

}  // namespace

double FluidMemory::peak() const {
    double all = populations, largest = 0;
    for (const auto& part : held) all += part.second;
    for (const auto& part : passing) largest = std::max(largest, part.second);
    return all + largest;
}

FluidMemory fluid_memory(const scene::Scene& scene, int ranks,
                         std::span<const fluid::Vec3> markers_m) {
    const auto config = to_config(*scene.fluid, *scene::coupled_step_s(scene));
    const auto& n = config.cells;
    const double cells = static_cast<double>(n[0]) * n[1] * n[2];
    const auto storage = fluid::storage_of(config.precision);
    const auto parts = fluid::decompose(n, fluid::periodic_axes(config), ranks);
    FluidMemory memory;
    double ghosted_cells = 0;  // of a velocity field, which always has a layer around it
    for (int rank = 0; rank < ranks; ++rank) {
        const fluid::RowLayout rows = parts.layout(rank);
        memory.populations += static_cast<double>(
            fluid::Populations::bytes_of(rows.nx, rows.row_count(), storage));
        ghosted_cells += static_cast<double>(rows.nx) * (rows.ny + 2) * (rows.nz + 2);
    }
    if (!config.obstacles.empty())
        memory.held.emplace_back("map of the obstacles", cells * sizeof(short));
    if (!markers_m.empty())
        memory.held.emplace_back(
            "markers and the rows that they push",
            known_markers(scene, parts, markers_m) * marker_bytes +
                forced_rows_bytes(static_cast<double>(markers_m.size()), n[0],
                                  storage == fluid::Storage::float_));
    if (keeps_all(scene, config))
        memory.held.emplace_back("the implicit scheme's copy", memory.populations);
    if (has_enstrophy(scene))
        memory.passing.emplace_back("the probe of the enstrophy",
                                    ghosted_cells * velocity_field);
    if (scene.output.fluid)
        memory.passing.emplace_back("fields in files",
                                    cells * output_bytes_a_cell(*scene.output.fluid));
    return memory;
}

}  // namespace magfsi::lbm
