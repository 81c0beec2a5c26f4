#include <fmt/format.h>

#include <filesystem>
#include <memory>
#include <vector>

#include "adapters/fluids/fluid_run.h"
#include "adapters/scene/scene.h"
#include "coupler/output/vtk.h"

namespace magfsi::fluids {

namespace {

// fluid.pvd and its files: one .vti a rank, one .pvti an instant.
class FluidFiles {
  public:
    FluidFiles(const coupler::World& world, FluidSolver& fluid,
               const scene::FluidOutput& wanted, const std::filesystem::path& run_folder);

    // After a restart: the series again up to the clock's step, one file every so many.
    void resume(const coupler::Clock& clock, std::int64_t every);

    // Collective. index numbers the files.
    void write(std::int64_t index, double time_s);

  private:
    void write_index(std::int64_t index, double time_s);
    std::filesystem::path whole(std::int64_t index) const;
    std::filesystem::path piece(std::int64_t index, int rank) const;

    MPI_Comm comm_;
    int rank_ = 0;
    FluidSolver& fluid_;
    std::vector<scene::FluidField> fields_;
    std::filesystem::path folder_;
    output::ImageGrid grid_;
    std::vector<output::CellExtent> extents_;
    std::unique_ptr<output::PvdSeries> series_;  // on the root
};

output::FieldType type_of(scene::FluidField field) {
    const int components = field == scene::FluidField::density ? 1 : 3;
    return {std::string(scene::name_of(field)), components, false};
}

FluidFiles::FluidFiles(const coupler::World& world, FluidSolver& fluid,
                       const scene::FluidOutput& wanted,
                       const std::filesystem::path& run_folder)
    : comm_(world.local()),
      rank_(world.rank()),
      fluid_(fluid),
      fields_(wanted.fields),
      folder_(run_folder / "fields") {
    const double h = fluid.grid().spacing_m;
    grid_.spacing_m = {h, h, h};
    for (const coupler::CellBox& box : fluid.grid().owned_by_rank)
        extents_.push_back({box.lo, box.hi});
    if (rank_ == 0)
        series_ = std::make_unique<output::PvdSeries>(run_folder / "fluid.pvd");
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
    const std::size_t cells = extents_[static_cast<std::size_t>(rank_)].cells();
    std::vector<output::Field> fields;
    std::vector<std::vector<float>> values(fields_.size());
    for (std::size_t i = 0; i < fields_.size(); ++i) {
        const output::FieldType type = type_of(fields_[i]);
        values[i].resize(cells * static_cast<std::size_t>(type.components));
        fluid_.field(fields_[i], values[i]);
        fields.push_back({type.name, type.components, std::span<const float>(values[i])});
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
    for (const scene::FluidField field : fields_) types.push_back(type_of(field));
    output::write_pvti(whole(index), grid_, {{0, 0, 0}, fluid_.grid().cells}, pieces,
                       types);
    series_->add(time_s, whole(index));
}

class FluidFields : public coupler::Output {
  public:
    explicit FluidFields(FluidRun& run)
        : session_(run.session),
          every_(session_.clock().every(run.scene.output.fluid->every_s)),
          files_(session_.world(), run.fluid, *run.scene.output.fluid, session_.out()) {
        if (session_.restart()) files_.resume(session_.clock(), every_);
    }
    void begin() override {
        if (!session_.restart()) files_.write(0, 0);
    }
    void end_step() override {
        const auto step = session_.clock().step();
        if (step % every_ == 0) files_.write(step / every_, session_.clock().time_s());
    }

  private:
    const coupler::Session& session_;
    std::int64_t every_;
    FluidFiles files_;
};

}  // namespace

extern const FluidOutput fluid_fields_output{
    "fluid_fields", "write fields",
    [](FluidRun& run) -> std::unique_ptr<coupler::Output> {
        if (!run.scene.output.fluid) return nullptr;
        return std::make_unique<FluidFields>(run);
    }};

}  // namespace magfsi::fluids
