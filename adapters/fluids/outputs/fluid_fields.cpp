// SPDX-License-Identifier: GPL-2.0-or-later
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <vector>

#include "adapters/fluids/fluid_run.h"
#include "adapters/scene/keys.h"
#include "coupler/output/vtk.h"

namespace magfsi::fluids {

namespace {

output::FieldType type_of(scene::FluidField field) {
    return {.name = fmt::format("{}[{}]", scene::name_of(field), scene::unit_of(field)),
            .components = scene::components_of(field)};
}

// fluid.pvd and its files: one .vti a rank, one .pvti an instant; in a refined grid for
// each of its levels, which are the parts of one picture: where a finer level is, cells
// are marked as hidden.
class FluidFields : public coupler::Output {
  public:
    explicit FluidFields(FluidRun& run);
    void begin() override {
        if (!session_.restart()) write();
    }
    void end_step() override {
        if (session_.clock().step() % every_ == 0) write();
    }

  private:
    void write();  // collective
    void write_level(std::int64_t number, std::size_t level, const FieldCells& cells);
    void write_index(std::int64_t number, std::size_t level, const FieldCells& cells);
    static std::string level_name(std::size_t level) {
        return level == 0 ? "" : fmt::format("_level{}", level);
    }
    std::filesystem::path whole(std::int64_t number, std::size_t level = 0) const {
        return folder_ / fmt::format("fluid_{:06d}{}.pvti", number, level_name(level));
    }
    std::filesystem::path piece(std::int64_t number, std::size_t level,
                                std::size_t rank) const {
        return folder_ /
               fmt::format("fluid_{:06d}{}_{}.vti", number, level_name(level), rank);
    }

    const coupler::Session& session_;
    FluidSolver& fluid_;
    const std::vector<scene::FluidField>& fields_;
    std::int64_t every_;
    std::filesystem::path folder_;
    std::unique_ptr<output::PvdSeries> series_;  // on the root
};

FluidFields::FluidFields(FluidRun& run)
    : session_(run.session),
      fluid_(run.fluid),
      fields_(run.scene.output.fluid->fields),
      every_(session_.clock().every(run.scene.output.fluid->every_s)),
      folder_(session_.out() / "fields") {
    if (session_.world().rank() != 0) return;
    series_ = std::make_unique<output::PvdSeries>(session_.out() / "fluid.pvd");
    if (!session_.restart()) return;
    // The series again up to the present step.
    const coupler::Clock& clock = session_.clock();
    const std::size_t levels = fluid_.field_cells().size();
    for (std::int64_t step = 0; step <= clock.step(); step += every_) {
        for (std::size_t level = 0; level < levels; ++level) {
            const auto file = whole(step / every_, level);
            if (std::filesystem::exists(file))
                series_->add(clock.time_s(step), file, static_cast<int>(level));
        }
    }
}

void FluidFields::write() {
    const std::int64_t number = session_.clock().step() / every_;
    const std::vector<FieldCells> levels = fluid_.field_cells();
    for (std::size_t level = 0; level < levels.size(); ++level)
        write_level(number, level, levels[level]);
    MPI_Barrier(session_.world().local());
    for (std::size_t level = 0; series_ && level < levels.size(); ++level)
        write_index(number, level, levels[level]);
}

output::ImageGrid image_of(const FieldCells& cells) {
    return {{}, {cells.spacing_m, cells.spacing_m, cells.spacing_m}};
}

// One flag a cell of the box, x fastest.
std::vector<std::uint8_t> hidden_in(const coupler::CellBox& box,
                                    const coupler::CellBox& hidden) {
    std::vector<std::uint8_t> flags;
    const auto within = [&](int d, int i) {
        return i >= hidden.lo[static_cast<std::size_t>(d)] &&
               i < hidden.hi[static_cast<std::size_t>(d)];
    };
    for (int z = box.lo[2]; z < box.hi[2]; ++z) {
        for (int y = box.lo[1]; y < box.hi[1]; ++y) {
            for (int x = box.lo[0]; x < box.hi[0]; ++x)
                flags.push_back(within(0, x) && within(1, y) && within(2, z)
                                    ? output::hidden_cell
                                    : 0);
        }
    }
    return flags;
}

void FluidFields::write_level(std::int64_t number, std::size_t level,
                              const FieldCells& cells) {
    const auto rank = static_cast<std::size_t>(session_.world().rank());
    const coupler::CellBox& box = cells.owned_by_rank[rank];
    const output::CellExtent extent{box.lo, box.hi};
    std::vector<output::Field> fields;
    std::vector<std::vector<float>> values(fields_.size());
    for (std::size_t i = 0; i < fields_.size(); ++i) {
        const output::FieldType type = type_of(fields_[i]);
        values[i].resize(extent.cells() * static_cast<std::size_t>(type.components));
        fluid_.field(fields_[i], level, values[i]);
        fields.push_back({type.name, type.components, std::span<const float>(values[i])});
    }
    std::vector<std::uint8_t> flags;
    if (cells.hidden) {
        flags = hidden_in(box, *cells.hidden);
        fields.push_back({output::ghost_cells, 1, std::span<const std::uint8_t>(flags)});
    }
    if (extent.cells() > 0)
        output::write_vti(piece(number, level, rank), image_of(cells), extent, fields);
}

void FluidFields::write_index(std::int64_t number, std::size_t level,
                              const FieldCells& cells) {
    std::vector<output::ImagePiece> pieces;
    output::CellExtent all;
    for (std::size_t r = 0; r < cells.owned_by_rank.size(); ++r) {
        const coupler::CellBox& box = cells.owned_by_rank[r];
        const output::CellExtent extent{box.lo, box.hi};
        if (extent.cells() == 0) continue;
        if (pieces.empty()) all = extent;
        for (std::size_t d = 0; d < 3; ++d) {
            all.lo[d] = std::min(all.lo[d], box.lo[d]);
            all.hi[d] = std::max(all.hi[d], box.hi[d]);
        }
        pieces.push_back({piece(number, level, r), extent});
    }
    std::vector<output::FieldType> types;
    for (const scene::FluidField field : fields_) types.push_back(type_of(field));
    if (cells.hidden) types.push_back({.name = output::ghost_cells, .uint8 = true});
    output::write_pvti(whole(number, level), image_of(cells), all, pieces, types);
    series_->add(session_.clock().time_s(), whole(number, level),
                 static_cast<int>(level));
}

}  // namespace

extern const FluidOutput fluid_fields_output{
    "fluid_fields", "write fields",
    [](FluidRun& run) -> std::unique_ptr<coupler::Output> {
        if (!run.scene.output.fluid) return nullptr;
        return std::make_unique<FluidFields>(run);
    }};

}  // namespace magfsi::fluids
