// The structure rank's half of the immersed boundary: its markers, the force inside
// LAMMPS's steps, and the exchange with the fluid.
#pragma once

#include <memory>
#include <span>
#include <string>
#include <vector>

#include "adapters/bodies/marker_placement.h"
#include "adapters/lammps/engine.h"
#include "coupler/exchange/exchange.h"
#include "coupler/immersed_boundary/balance.h"
#include "coupler/immersed_boundary/direct_forcing.h"
#include "coupler/immersed_boundary/slip.h"
#include "coupler/output/summary.h"
#include "coupler/participants/session.h"

namespace magfsi::lammps {

class BodyCoupling {
  public:
    // After engine.set_up(), with the bodies where they start, also before a restart: a
    // rank takes the markers of the elements whose first node it
    // owns. first_node: atom id of each body's node 0.
    BodyCoupling(const scene::Scene& scene, const coupler::Session& session,
                 Engine& engine,
                 const std::vector<int>& first_node);
    ~BodyCoupling();

    // Velocities for the first step; after a checkpoint's arrays are in their places.
    void exchange_first();

    // The sampled velocities become the step's: held still; in a straight line through
    // the last two; or, parallel scheme, their mean, in which a response of the fluid
    // that alternates from step to step, as the late forces excite it, cancels.
    void begin_step();
    void begin_step_extrapolated();
    void begin_step_with_mean();
    void send_impulses();  // what was given since, where and where the markers are now
    // The fluid's slip under these impulses, answered until all iterations are done.
    bool iterates() const { return iterated_ != nullptr; }
    void iterate_forcing();
    void receive_velocities();

    // Implicit scheme (body_iterations.cpp). A step: keep_state; then begin_iteration,
    // LAMMPS's steps, send_impulses, receive_answer, repeat, as long as that says so;
    // then accept_answer.
    void keep_state();
    void begin_iteration();
    void receive_answer();
    bool repeat();
    void accept_answer();
    const output::IterationSummary* repetitions() const;  // null in other schemes

    // What this rank's markers carry from step to step, kept in checkpoints under its
    // name; each has three numbers a marker.
    struct MarkerArray {
        std::string name;
        std::span<double> values;
    };
    std::vector<MarkerArray> carried();
    // After they are back: the last coupled step was this part of what it was (a retry),
    // and the fluid's velocity then that much closer to the present one.
    void shorten_last_step(double part);
    // Numbers that are the same on all ranks; with them, after a restart, a fresh object
    // makes room for what is carried. Empty but in the implicit scheme.
    std::vector<double> carried_numbers() const;
    void make_room(std::span<const double> numbers);
    // Of each marker of this rank its number among all: body after body, in the order in
    // which they were placed.
    std::span<const int> placed_index() const { return placed_index_; }
    std::size_t placed() const { return placed_; }

    // What the markers of this rank told the fluid last and what it answered.
    struct Exchanged {
        std::span<const Vec3> position_m, impulse, velocity;
    };
    Exchanged exchanged() const { return {now_m_, force_->impulse(), fluid_velocity_}; }
    const coupler::Grid& grid() const { return grid_; }

    std::size_t bodies() const { return bodies_; }
    // Sum over the ranks of the force on each body in the last step [N]. Collective.
    std::vector<Vec3> force_on_bodies();
    // The same on each part of a body in probes.integrals, in their order.
    std::vector<Vec3> force_on_parts();
    // Adds the last step to the record, with the velocities sampled before it.
    void audit(coupler::BalanceRecord& record) const;
    // Null but with probes.energy_audit.
    const coupler::MarkerWork* work() const { return work_.get(); }

    // One sample of how well the boundary holds, with the velocities just received.
    void measure_slip();
    coupler::SlipReport slip() const;  // collective

  private:
    std::vector<coupler::Marker> own_markers(
        const std::vector<bodies::PlacedMarker>& placed,
        const std::vector<int>& first_node);
    std::vector<Vec3> marker_positions() const;
    void share_fluid_inside(std::vector<coupler::Marker>& markers);
    void note_velocities();
    void attach_force();
    void find_parts(const std::vector<bodies::PlacedMarker>& placed);
    Vec3 force_on(std::size_t marker) const;
    std::vector<coupler::MarkerArea> own_areas(
        const std::vector<bodies::PlacedMarker>& placed) const;
    void start_iterations();
    int current_iteration() const;
    void add_learnt(std::vector<MarkerArray>& all);

    const scene::Scene& scene_;
    const coupler::Session& session_;
    Engine& engine_;
    coupler::Grid grid_;
    std::size_t bodies_ = 0;
    std::vector<int> placed_index_;
    std::size_t placed_ = 0;
    std::vector<std::vector<std::size_t>> parts_;  // markers of this rank
    // Where probes ask for forces: of each marker the fluid inside that came off the
    // nodes, and its velocity at the start of the step. Else empty.
    bool notes_velocities_ = false;
    std::vector<double> off_nodes_kg_;
    std::vector<Vec3> start_velocity_;
    Vec3 gravity_m_s2_{};
    std::unique_ptr<coupler::PenaltyForce> force_;
    std::unique_ptr<coupler::SlipRecord> slip_;
    std::unique_ptr<coupler::IteratedForcing> iterated_;  // only with iterations
    std::unique_ptr<coupler::MarkerWork> work_;           // only with energy_audit
    std::unique_ptr<coupler::StructureExchange> exchange_;
    std::vector<Vec3> before_m_, now_m_, fluid_velocity_;
    // A step before fluid_velocity_; empty where the scheme looks at one sample only.
    std::vector<Vec3> last_velocity_;
    std::vector<Vec3> under_way_;  // parallel scheme: impulses, filled for checkpoints
    struct Iterations;
    std::unique_ptr<Iterations> iterations_;  // implicit scheme
};

}  // namespace magfsi::lammps
