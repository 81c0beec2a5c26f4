#include "adapters/lbm/fluid_output.h"

#include <fmt/format.h>

#include <algorithm>

namespace magfsi::lbm {

FluidFiles::FluidFiles(MPI_Comm comm, const fluid::Fluid& fluid,
                       const scene::FluidOutput& wanted,
                       const std::filesystem::path& run_folder)
    : comm_(comm), fluid_(fluid), fields_(wanted.fields), folder_(run_folder / "fields") {
    MPI_Comm_rank(comm, &rank_);
    const double h = fluid.config().spacing_m;
    grid_.spacing_m = {h, h, h};
    for (const fluid::CellBox& box : fluid.owned_by_rank())
        extents_.push_back({box.lo, box.hi});
    const std::size_t cells = extents_[static_cast<std::size_t>(rank_)].cells();
    velocity_.resize(3 * cells);
    density_.resize(cells);
    if (wants(scene::FluidField::vorticity)) vorticity_.resize(3 * cells);
    if (rank_ == 0)
        series_ = std::make_unique<output::PvdSeries>(run_folder / "fluid.pvd");
}

bool FluidFiles::wants(scene::FluidField field) const {
    return std::find(fields_.begin(), fields_.end(), field) != fields_.end();
}

std::filesystem::path FluidFiles::piece(std::int64_t index, int rank) const {
    return folder_ / fmt::format("fluid_{:06d}_{}.vti", index, rank);
}

std::filesystem::path FluidFiles::whole(std::int64_t index) const {
    return folder_ / fmt::format("fluid_{:06d}.pvti", index);
}

void FluidFiles::resume(const coupler::Clock& clock, std::int64_t every) {
    for (std::int64_t step = 0; series_ && step <= clock.step(); step += every) {
        if (std::filesystem::exists(whole(step / every)))
            series_->add(clock.time_s(step), whole(step / every));
    }
}

void FluidFiles::write(std::int64_t index, double time_s) {
    fluid_.macroscopic(velocity_, density_);
    std::vector<output::Field> fields;
    if (wants(scene::FluidField::velocity)) {
        fields.push_back({"velocity", 3, std::span<const float>(velocity_)});
    }
    if (wants(scene::FluidField::density)) {
        fields.push_back({"density", 1, std::span<const float>(density_)});
    }
    if (wants(scene::FluidField::vorticity)) {
        fluid_.vorticity(vorticity_);
        fields.push_back({"vorticity", 3, std::span<const float>(vorticity_)});
    }
    output::write_vti(piece(index, rank_), grid_,
                      extents_[static_cast<std::size_t>(rank_)], fields);
    MPI_Barrier(comm_);
    if (rank_ == 0) write_index(index, time_s);
}

void FluidFiles::write_index(std::int64_t index, double time_s) {
    std::vector<output::ImagePiece> pieces;
    for (std::size_t r = 0; r < extents_.size(); ++r) {
        pieces.push_back({piece(index, static_cast<int>(r)), extents_[r]});
    }
    std::vector<output::FieldType> types;
    if (wants(scene::FluidField::velocity)) types.push_back({"velocity", 3, false});
    if (wants(scene::FluidField::density)) types.push_back({"density", 1, false});
    if (wants(scene::FluidField::vorticity)) types.push_back({"vorticity", 3, false});
    output::write_pvti(whole(index), grid_, {{0, 0, 0}, fluid_.config().cells}, pieces,
                       types);
    series_->add(time_s, whole(index));
}

}  // namespace magfsi::lbm
