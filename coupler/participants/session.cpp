#include "coupler/participants/session.h"

#include <fmt/format.h>

#include <cmath>

#include "coupler/output/log.h"
#include "coupler/participants/errors.h"
#include "coupler/participants/wait.h"
#include "coupler/scene/reader.h"

namespace magfsi::coupler {

namespace {

const scene::Scene& read(const ParticipantArguments& arguments, RunState& state) {
    state.scene = scene::read_scene(arguments.scene, arguments.overrides);
    state.out = arguments.out.empty() ? default_out(state.scene.name) : arguments.out;
    return state.scene;
}

bool coupled(const scene::Scene& scene) {
    return scene.fluid && !scene.bodies.empty();
}

}  // namespace

Session::Session(Role role, const ParticipantArguments& arguments, RunState& state)
    : state_(state), world_(role, coupled(read(arguments, state))) {}

double Session::timeout_s() const {
    return state_.scene.coupling ? state_.scene.coupling->timeout_s : startup_timeout_s;
}

void Session::begin(double step_s) {
    clock_ = std::make_unique<Clock>(step_s, state_.scene.time.end_s);
    if (world_.coupled()) {
        Agreement mine;
        mine.scene_hash = state_.scene.hash;
        mine.steps = clock_->steps();
        mine.step_ps = std::llround(step_s * 1e12);
        shake_hands(world_, mine, startup_timeout_s);
    }
    if (world_.root()) std::filesystem::create_directories(state_.out / "fields");
    if (world_.leads()) std::filesystem::remove(state_.out / "summary.json");
    MPI_Barrier(world_.local());
    state_.started = true;
    if (world_.leads()) logger_ = output::open_log(state_.out / "run.log", "magfsi");
}

void Session::log(const std::string& line) const {
    if (logger_) logger_->info(line);
}

void Session::complete_step() {
    clock_->tick();
    state_.step = clock_->step();
    state_.time_s = clock_->time_s();
    if (stop_requested() != 0) {
        throw Stopped(fmt::format("told to end by signal {}", stop_requested()));
    }
}

}  // namespace magfsi::coupler
