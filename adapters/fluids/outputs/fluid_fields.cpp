#include <fmt/format.h>

#include <filesystem>
#include <memory>
#include <vector>

#include "adapters/fluids/fluid_run.h"
#include "adapters/scene/keys.h"
#include "coupler/output/vtk.h"

namespace magfsi::fluids {

namespace {

output::FieldType type_of(scene::FluidField field) {
    const int components = field == scene::FluidField::density ? 1 : 3;
    return {std::string(scene::name_of(field)), components, false};
}

// fluid.pvd and its files: one .vti a rank, one .pvti an instant.
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
    void write_index(std::int64_t number);
    std::filesystem::path whole(std::int64_t number) const {
        return folder_ / fmt::format("fluid_{:06d}.pvti", number);
    }
    std::filesystem::path piece(std::int64_t number, std::size_t rank) const {
        return folder_ / fmt::format("fluid_{:06d}_{}.vti", number, rank);
    }

    const coupler::Session& session_;
    FluidSolver& fluid_;
    const std::vector<scene::FluidField>& fields_;
    std::int64_t every_;
    std::filesystem::path folder_;
    output::ImageGrid grid_;
    std::vector<output::CellExtent> extents_;    // by rank
    std::unique_ptr<output::PvdSeries> series_;  // on the root
};

FluidFields::FluidFields(FluidRun& run)
    : session_(run.session),
      fluid_(run.fluid),
      fields_(run.scene.output.fluid->fields),
      every_(session_.clock().every(run.scene.output.fluid->every_s)),
      folder_(session_.out() / "fields") {
    const double h = fluid_.grid().spacing_m;
    grid_.spacing_m = {h, h, h};
    for (const coupler::CellBox& box : fluid_.grid().owned_by_rank)
        extents_.push_back({box.lo, box.hi});
    if (session_.world().rank() != 0) return;
    series_ = std::make_unique<output::PvdSeries>(session_.out() / "fluid.pvd");
    if (!session_.restart()) return;
    // The series again up to the present step.
    const coupler::Clock& clock = session_.clock();
    for (std::int64_t step = 0; step <= clock.step(); step += every_) {
        if (std::filesystem::exists(whole(step / every_)))
            series_->add(clock.time_s(step), whole(step / every_));
    }
}

void FluidFields::write() {
    const std::int64_t number = session_.clock().step() / every_;
    const auto rank = static_cast<std::size_t>(session_.world().rank());
    std::vector<output::Field> fields;
    std::vector<std::vector<float>> values(fields_.size());
    for (std::size_t i = 0; i < fields_.size(); ++i) {
        const output::FieldType type = type_of(fields_[i]);
        values[i].resize(extents_[rank].cells() *
                         static_cast<std::size_t>(type.components));
        fluid_.field(fields_[i], 0, values[i]);
        fields.push_back({type.name, type.components, std::span<const float>(values[i])});
    }
    output::write_vti(piece(number, rank), grid_, extents_[rank], fields);
    MPI_Barrier(session_.world().local());
    if (series_) write_index(number);
}

void FluidFields::write_index(std::int64_t number) {
    std::vector<output::ImagePiece> pieces;
    for (std::size_t r = 0; r < extents_.size(); ++r)
        pieces.push_back({piece(number, r), extents_[r]});
    std::vector<output::FieldType> types;
    for (const scene::FluidField field : fields_) types.push_back(type_of(field));
    output::write_pvti(whole(number), grid_, {{0, 0, 0}, fluid_.grid().cells}, pieces,
                       types);
    series_->add(session_.clock().time_s(), whole(number));
}

}  // namespace

extern const FluidOutput fluid_fields_output{
    "fluid_fields", "write fields",
    [](FluidRun& run) -> std::unique_ptr<coupler::Output> {
        if (!run.scene.output.fluid) return nullptr;
        return std::make_unique<FluidFields>(run);
    }};

}  // namespace magfsi::fluids
