// SPDX-License-Identifier: GPL-2.0-or-later
// Calls of a controller, which returns the uniform field of the coming interval. A call
// comes after the row of probes that the controller sees and before the checkpoint that
// keeps the field which it has set.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "adapters/scene/reader.h"
#include "adapters/solvers/bodies/probe_row.h"
#include "adapters/solvers/lammps/structure_run.h"
#include "coupler/checkpoint/state_file.h"
#include "coupler/participants/controller.h"

namespace magfsi::lammps {

namespace {

// Coupled steps between two calls: with probes a whole number of their intervals.
std::int64_t steps_between_calls(const scene::Scene& scene, const coupler::Clock& clock) {
    const double every_s = scene.control->every_s;
    if (!scene.probes) return clock.every(every_s);
    const auto rows = std::llround(every_s / scene.probes->every_s);
    return rows * clock.every(scene.probes->every_s);
}

coupler::ControlPlan plan_of(const scene::Control& control) {
    return {control.script, control.probes, control.every_s, control.timeout_s};
}

class Control : public coupler::Output {
  public:
    explicit Control(StructureRun& run);
    void begin() override {
        if (!run_.session.restart()) call();
    }
    void end_step() override {
        if (run_.session.clock().step() % every_ == 0) call();
    }
    void finish() override { controller_->end(); }

  private:
    void call();
    void save(coupler::StateWriter* file);
    std::vector<double> seen() const;

    StructureRun& run_;
    std::int64_t every_;
    // Columns of probes.csv that the controller sees; on the leading rank.
    std::vector<std::size_t> columns_;
    std::unique_ptr<coupler::Controller> controller_;
    // Present field and the one before the last call, as texts that the controller
    // returned; the step of the last call.
    std::string field_, field_before_;
    std::int64_t called_at_ = -1;
};

Control::Control(StructureRun& run)
    : run_(run), every_(steps_between_calls(run.scene, run.session.clock())) {
    const scene::Control& control = *run.scene.control;
    for (std::size_t i = 0; run.probes && i < control.probes.size(); ++i)
        columns_.push_back(bodies::column_of(run.probes->columns(), control, i));
    std::optional<std::vector<double>> state;
    if (run.session.restart()) {
        const auto file = run.session.open_restart();
        field_ = text_in(file, "field");
        state = file.table("controller");
    }
    controller_ = std::make_unique<coupler::Controller>(
        run.session.world(), plan_of(control), run.session.out().string(),
        run.scene.checkpoint.has_value(), state);
    run.save_control = [this](coupler::StateWriter* file) { save(file); };
    run.session.log(fmt::format("the controller {} is called every {} steps",
                                control.script, every_));
}

std::vector<double> Control::seen() const {
    std::vector<double> values;
    for (const std::size_t i : columns_) values.push_back(run_.probes->last_row()[i]);
    return values;
}

// Asks the controller and sets the field that it returns, unless it is the same text as
// before. Collective.
void Control::call() {
    const coupler::Clock& clock = run_.session.clock();
    field_before_ = field_;
    called_at_ = clock.step();
    std::string answer = controller_->ask(clock.step(), clock.time_s(), seen());
    if (answer == field_) return;
    field_ = std::move(answer);
    try {
        set_field(run_, scene::read_field(field_, "what step returned", run_.scene));
    } catch (const scene::SceneError& fault) {  // no fault of the scene
        throw std::runtime_error(fmt::format("the controller {}: {}",
                                             run_.scene.control->script, fault.what()));
    }
}

// Saves the state of the controller, its field, and the field of the last step: the
// forces at the end of that step, with which the next one begins, are of the field before
// the call. Collective.
void Control::save(coupler::StateWriter* file) {
    const std::vector<double> state = controller_->keep();
    if (!file) return;
    file->table("controller", state, {state.size()});
    save_text(*file, "field", field_);
    const bool now = called_at_ == run_.session.clock().step();
    save_text(*file, "field_of_step", now ? field_before_ : field_);
}

}  // namespace

extern const StructureOutput control_output{
    "control", "ask controller",
    [](StructureRun& run) -> std::unique_ptr<coupler::Output> {
        if (!run.scene.control) return nullptr;
        return std::make_unique<Control>(run);
    }};

}  // namespace magfsi::lammps
