// SPDX-License-Identifier: GPL-2.0-or-later
// The two forcings (options.h) on a structure rank: the force between markers and fluid,
// each with its own state and its own tasks in the coupled step. The schemes put these
// tasks in their places (schemes.cpp).
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "coupler/immersed_boundary/direct_forcing.h"
#include "coupler/immersed_boundary/layer_inertia.h"
#include "coupler/immersed_boundary/no_slip.h"
#include "coupler/immersed_boundary/slip.h"
#include "coupler/scheme/structure_solver.h"
#include "coupler/step/task_list.h"

namespace magfsi::coupler {

// An array that this rank's markers carry from step to step, under its name in
// checkpoints, with three numbers per marker.
struct MarkerArray {
    std::string name;
    std::span<double> values;
};

// The coupled step at this rank's markers, which forcing, scheme and audits share.
struct MarkerStep {
    StructureSolver& solver;
    double duration_s;
    // Positions of the markers at the start and the end of the last step [m], and the
    // fluid's velocities there [m/s].
    std::vector<Vec3> before_m{}, now_m{};
    std::vector<Vec3> last_velocity{}, fluid_velocity{};

    // Mean velocity of the markers in the last step [m/s].
    std::vector<Vec3> mean_velocity() const;
};

// Forcing penalty: eq. (13). The fluid is given the impulses of the markers, and beside
// its velocities it has nothing to answer.
class PenaltyForcing : public PenaltyForce {
  public:
    // step must outlive this object.
    PenaltyForcing(std::vector<Marker> markers, const PenaltyScale& scale,
                   const Vec3& gravity_m_s2, const MarkerStep& step);

    // Numbers that this forcing adds to the messages (exchange.h): the markers' volumes
    // [m3], and the place of the fluid's answer, null if there is none.
    virtual std::span<const double> volumes_m3() const { return {}; }
    virtual NoSlipAnswer* answer() { return nullptr; }

    // Called once after the exchange before the first step. fresh: the run does not
    // continue a checkpoint, and the state follows from the fluid's velocities.
    virtual void start(bool fresh);

    // Add the tasks of this forcing that follow the structure's advance, and those that
    // need the velocities of the fluid after its advance.
    virtual void add_to_advance(TaskList& /*tasks*/) {}
    virtual void add_to_answer(TaskList& /*tasks*/) {}

    // Impulses that the fluid is given in the step [N s].
    virtual std::span<const Vec3> given() const { return impulse(); }

    // Adds a sample at the end of a step. Collective over the structure.
    virtual void measure(SlipRecord& record) const;

    // State from step to step, from which a step can be repeated, too.
    virtual std::vector<MarkerArray> carried();

  protected:
    const MarkerStep& step_;
};

// Forcing no_slip (immersed_boundary/no_slip.h): in the force U is replaced by U - p with
// the memory p of the slip, and the coefficients are divided by the row sums. A layer of
// markers along a thin sheet gives the fluid more than its force (LayerInertia).
class NoSlipForcing final : public PenaltyForcing {
  public:
    struct Setting {
        SlipRates rates{};
        Vec3 body_force_n_m3{};  // on all of the fluid
        // True if a marker on any rank stands for a layer of fluid outside its body;
        // areas: pieces of surface of this rank's markers.
        bool carries_layers = false;
        std::span<const MarkerArea> areas{};
        // True if the fluid's pressure answers a force within the step. The scheme then
        // finds the force by repeating the step, and the memory stays zero.
        bool incompressible = false;
    };
    NoSlipForcing(std::vector<Marker> markers, const PenaltyScale& scale,
                  const Vec3& gravity_m_s2, const MarkerStep& step,
                  const Setting& setting);

    void begin_step(std::span<const Vec3> fluid_velocity) override;
    void let_change(std::span<const Vec3> start, std::span<const Vec3> end) override;
    void hold(std::span<const Vec3> fluid_velocity) override;

    std::span<const double> volumes_m3() const override { return volume_m3_; }
    NoSlipAnswer* answer() override { return &answer_; }
    void start(bool fresh) override;
    void add_to_advance(TaskList& tasks) override;
    void add_to_answer(TaskList& tasks) override;
    std::span<const Vec3> given() const override;
    void measure(SlipRecord& record) const override;
    std::vector<MarkerArray> carried() override;

  private:
    // Updates memory and coefficients from the answer.
    void take_answer();
    // Sets the coefficients to their own values times fitted::no_slip_strength, over the
    // row sums or fitted::least_row_sum, whichever is larger.
    void divide_by_row_sums();

    PenaltyScale scale_;
    Vec3 body_force_n_m3_;
    bool incompressible_;
    std::vector<double> volume_m3_;
    NoSlipAnswer answer_;
    SlipMemory memory_;
    std::optional<LayerInertia> layer_;
};

}  // namespace magfsi::coupler
