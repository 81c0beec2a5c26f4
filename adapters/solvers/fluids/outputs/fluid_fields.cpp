// SPDX-License-Identifier: GPL-2.0-or-later
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <memory>
#include <set>
#include <string_view>
#include <vector>

#include "adapters/scene/keys.h"
#include "adapters/solvers/fluids/fluid_run.h"
#include "coupler/output/vtk.h"

namespace magfsi::fluids {

namespace {

// Column name with unit and number of components, as ParaView shows them.
output::FieldType type_of(scene::FluidField field) {
    return {.name = fmt::format("{}[{}]", scene::name_of(field), scene::unit_of(field)),
            .components = scene::components_of(field)};
}

// Writes fluid.pvd and its files: for each instant one .vti per rank and one .pvti that
// joins them. A refined grid has such a set for each patch; the .pvd lists the patches as
// parts of one instant, and cells that a finer patch solves are marked as hidden.
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
    void write();  // collective over the fluid's ranks
    // Writes this rank's .vti of a patch; number counts the instants from 0.
    void write_patch(std::int64_t number, std::size_t patch, const FieldCells& cells);
    // Writes the patch's .pvti and enters it into the series; rank 0 only.
    void write_index(std::int64_t number, std::size_t patch, const FieldCells& cells);
    static constexpr std::string_view start = "fluid_";
    std::filesystem::path whole(std::int64_t number, const FieldCells& cells) const {
        return folder_ / fmt::format("{}{:06d}{}.pvti", start, number, cells.name);
    }
    std::filesystem::path piece(std::int64_t number, const FieldCells& cells,
                                std::size_t rank) const {
        return folder_ /
               fmt::format("{}{:06d}{}_{}.vti", start, number, cells.name, rank);
    }

    const coupler::Session& session_;
    FluidSolver& fluid_;
    const std::vector<scene::FluidField>& fields_;
    std::int64_t every_;
    std::filesystem::path folder_;
    std::unique_ptr<output::PvdSeries> series_;  // on rank 0
    // The .pvti files that the run left before it was restarted, by number of the
    // instant.
    std::map<std::int64_t, std::set<std::filesystem::path>> left_;
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
    for (const auto& entry : std::filesystem::directory_iterator(folder_)) {
        const std::string name = entry.path().filename().string();
        if (name.starts_with(start) && entry.path().extension() == ".pvti")
            left_[std::stoll(name.substr(start.size()))].insert(entry.path());
    }
    // Rebuilds the series up to the present step from the files that are there: the
    // number of patches may differ from instant to instant.
    const coupler::Clock& clock = session_.clock();
    for (std::int64_t step = 0; step <= clock.step(); step += every_) {
        int part = 0;
        for (const auto& file : left_[step / every_])
            series_->add(clock.time_s(step), file, part++);
    }
}

void FluidFields::write() {
    const std::int64_t number = session_.clock().step() / every_;
    const std::vector<FieldCells> patches = fluid_.field_cells();
    for (std::size_t patch = 0; patch < patches.size(); ++patch)
        write_patch(number, patch, patches[patch]);
    MPI_Barrier(session_.world().local());
    if (!series_) return;
    // An instant that is written again may have had other patches.
    if (const auto left = left_.extract(number)) {
        for (const auto& file : left.mapped()) std::filesystem::remove(file);
    }
    for (std::size_t patch = 0; patch < patches.size(); ++patch)
        write_index(number, patch, patches[patch]);
}

output::ImageGrid image_of(const FieldCells& cells) {
    return {{}, {cells.spacing_m, cells.spacing_m, cells.spacing_m}};
}

// One flag per cell of the box, x fastest: hidden_cell where a box of `hidden` covers it.
std::vector<std::uint8_t> hidden_in(const coupler::CellBox& box,
                                    const std::vector<coupler::CellBox>& hidden) {
    const std::array<int, 3> n{box.hi[0] - box.lo[0], box.hi[1] - box.lo[1],
                               box.hi[2] - box.lo[2]};
    std::vector<std::uint8_t> flags(output::CellExtent{box.lo, box.hi}.cells(), 0);
    for (const coupler::CellBox& part : hidden) {
        // Corners of the covered part, relative to the box.
        std::array<int, 3> lo{}, hi{};
        for (std::size_t d = 0; d < 3; ++d) {
            lo[d] = std::max(part.lo[d], box.lo[d]) - box.lo[d];
            hi[d] = std::min(part.hi[d], box.hi[d]) - box.lo[d];
        }
        for (int z = lo[2]; z < hi[2]; ++z) {
            for (int y = lo[1]; y < hi[1]; ++y) {
                const auto row = flags.begin() + (std::ptrdiff_t{z} * n[1] + y) * n[0];
                if (hi[0] > lo[0])
                    std::fill(row + lo[0], row + hi[0], output::hidden_cell);
            }
        }
    }
    return flags;
}

void FluidFields::write_patch(std::int64_t number, std::size_t patch,
                              const FieldCells& cells) {
    const std::size_t rank = session_.world().rank();
    const coupler::CellBox& box = cells.owned_by_rank[rank];
    const output::CellExtent extent{box.lo, box.hi};
    std::vector<output::Field> fields;
    std::vector<std::vector<float>> values(fields_.size());
    for (std::size_t i = 0; i < fields_.size(); ++i) {
        const output::FieldType type = type_of(fields_[i]);
        values[i].resize(extent.cells() * type.components);
        fluid_.field(fields_[i], patch, values[i]);
        fields.push_back({type.name, type.components, std::span<const float>(values[i])});
    }
    std::vector<std::uint8_t> flags;
    if (!cells.hidden.empty()) {
        flags = hidden_in(box, cells.hidden);
        fields.push_back({output::ghost_cells, 1, std::span<const std::uint8_t>(flags)});
    }
    if (extent.cells() > 0)
        output::write_vti(piece(number, cells, rank), image_of(cells), extent, fields);
}

// The .pvti names only the ranks that own cells of the patch.
void FluidFields::write_index(std::int64_t number, std::size_t patch,
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
        pieces.push_back({piece(number, cells, r), extent});
    }
    std::vector<output::FieldType> types;
    for (const scene::FluidField field : fields_) types.push_back(type_of(field));
    if (!cells.hidden.empty())
        types.push_back({.name = output::ghost_cells, .uint8 = true});
    output::write_pvti(whole(number, cells), image_of(cells), all, pieces, types);
    series_->add(session_.clock().time_s(), whole(number, cells),
                 static_cast<int>(patch));
}

}  // namespace

extern const FluidOutput fluid_fields_output{
    "fluid_fields", "write fields",
    [](FluidRun& run) -> std::unique_ptr<coupler::Output> {
        if (!run.scene.output.fluid) return nullptr;
        return std::make_unique<FluidFields>(run);
    }};

}  // namespace magfsi::fluids
