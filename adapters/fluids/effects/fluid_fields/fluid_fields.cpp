#include "adapters/fluids/effects/fluid_fields/fluid_files.h"
#include "adapters/fluids/fluid_run.h"

namespace magfsi::fluids {

namespace {

class FluidFields : public coupler::Output {
  public:
    explicit FluidFields(FluidRun& run)
        : session_(run.session),
          every_(session_.clock().every(run.scene.output.fluid->every_s)),
          files_(session_.world(), run.fluid, *run.scene.output.fluid,
                 session_.out()) {
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
