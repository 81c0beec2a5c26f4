// The structure rank's half of a step that is repeated until the fluid answers to a guess
// of its velocities with the same velocities.
#include "adapters/lammps/body_iterations.h"

#include <fmt/format.h>

#include <algorithm>

namespace magfsi::lammps {

namespace {

// Cells a step: a hundred-millionth of the lattice's largest speeds is rounding.
constexpr double rest_lattice_speed = 1e-9;

// A velocity that alternates from step to step has no mean over a step: the body would
// not feel it, the fluid not be held, and at low viscosity it grows (the small swimmer's
// by 4 % a step at strength 1). So both ends of the straight line from U(n) to the guess
// are drawn back by an eighth of the second difference; in the mean,
//   (3 U(n+1) + 6 U(n) - U(n-1)) / 8,
// half of what alternates is left, and the rest is the line's to second order. Beside a
// body at rest that takes back s times the slip in a step, the amplification of
//   U(n+1) - U(n) = -2 s mean(U)
// is above -1 for s < 1 / (4 drawn_back) = 2.
constexpr double drawn_back = 0.125;

struct Line {
    std::vector<Vec3> start, end;
};

Line line_to(std::span<const Vec3> guess, std::span<const Vec3> now,
             std::span<const Vec3> before) {
    Line line{{now.begin(), now.end()}, {guess.begin(), guess.end()}};
    for (std::size_t m = 0; m < now.size(); ++m) {
        for (std::size_t d = 0; d < 3; ++d) {
            const double back = drawn_back * (guess[m][d] - 2 * now[m][d] + before[m][d]);
            line.start[m][d] -= back;
            line.end[m][d] -= back;
        }
    }
    return line;
}

// Held at its end the fluid would lead the body by half a step, which is a negative added
// mass of kappa dt / 2 a marker, as large as the fluid that it moves: light sheets
// diverge.
std::vector<Vec3> mean(std::span<const Vec3> a, std::span<const Vec3> b) {
    std::vector<Vec3> all(a.size());
    for (std::size_t m = 0; m < all.size(); ++m) {
        for (std::size_t d = 0; d < 3; ++d) all[m][d] = 0.5 * (a[m][d] + b[m][d]);
    }
    return all;
}

}  // namespace

BodyCoupling::~BodyCoupling() = default;

void BodyCoupling::start_iterations() {
    const coupler::Coupling& coupling = *scene_.coupling;
    const double rest_m_s =
        rest_lattice_speed * grid_.spacing_m / session_.clock().step_s();
    iterations_.reset(new Iterations{
        coupler::FixedPoint(session_.world(),
                            {*coupling.iteration, rest_m_s, session_.timeout_s()},
                            force_->markers().size()),
        coupling.sampled_velocity == coupler::SampledVelocity::linear,
        {},
        force_->enclosed(),
        {},
        std::vector<Vec3>(force_->markers().size()),
        coupler::MarkerWork(0)});
}

int BodyCoupling::current_iteration() const {
    return iterations_->fixed_point.iteration();
}

void BodyCoupling::keep_state() {
    engine_.keep(iterations_->bodies);
    iterations_->enclosed = force_->enclosed();
    if (work_) iterations_->work = *work_;
    iterations_->markers_m = now_m_;
    iterations_->fixed_point.begin_step(fluid_velocity_, last_velocity_);
}

void BodyCoupling::begin_iteration() {
    note_velocities();
    const auto guess = iterations_->fixed_point.guess();
    force_->begin_step(guess);
    const Line line = line_to(guess, fluid_velocity_, last_velocity_);
    if (iterations_->linear)
        force_->let_change(line.start, line.end);
    else
        force_->hold(mean(line.start, line.end));
}

void BodyCoupling::receive_answer() {
    exchange_->receive({session_.clock().step(), current_iteration()},
                       iterations_->answer);
}

bool BodyCoupling::repeat() {
    const bool again =
        iterations_->fixed_point.repeat(session_.clock().step(), iterations_->answer);
    if (!again) return false;
    engine_.go_back(iterations_->bodies);
    force_->enclosed() = iterations_->enclosed;
    if (work_) *work_ = iterations_->work;
    now_m_ = iterations_->markers_m;
    return true;
}

void BodyCoupling::accept_answer() {
    last_velocity_ = fluid_velocity_;
    fluid_velocity_ = iterations_->answer;
    // It took the guess for the velocity at the step's end.
    std::ranges::copy(fluid_velocity_, force_->enclosed().last_velocity().begin());
}

const output::IterationSummary* BodyCoupling::repetitions() const {
    return iterations_ ? &iterations_->fixed_point.record() : nullptr;
}

void BodyCoupling::add_learnt(std::vector<MarkerArray>& all) {
    int number = 0;
    for (const auto& vector : iterations_->fixed_point.acceleration().vectors())
        all.push_back({fmt::format("iteration_{:03d}", number++), vector});
}

std::vector<double> BodyCoupling::carried_numbers() const {
    if (!iterations_) return {};
    return iterations_->fixed_point.acceleration().numbers();
}

void BodyCoupling::make_room(std::span<const double> numbers) {
    iterations_->fixed_point.acceleration().make_room(numbers,
                                                      3 * force_->markers().size());
}

}  // namespace magfsi::lammps
