// SPDX-License-Identifier: GPL-2.0-or-later
// The two messages of a coupled step and both ends of their exchange.
//
// Everything is doubles; step numbers and counts are exact in them. Each message carries
// its step, and a receiver refuses any other. A structure rank sends only to the fluid
// ranks whose cells its markers can reach. That table is renewed every few coupled steps,
// with a margin that a marker cannot cross in between, so that in most steps nothing has
// to be announced. A grid that follows the bodies learns at the same time where they are,
// and says what its ranks own then.
#pragma once

#include <mpi.h>

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "coupler/immersed_boundary/grid.h"
#include "coupler/immersed_boundary/marker_stencil.h"
#include "coupler/immersed_boundary/no_slip.h"
#include "coupler/participants/world.h"

namespace magfsi::coupler {

constexpr int marker_tag = 81;    // structure -> fluid
constexpr int velocity_tag = 82;  // fluid -> structure
constexpr int place_tag = 83;     // both ways, where the grid follows

constexpr std::size_t message_header = 3;  // step, iteration, number of markers
constexpr std::size_t marker_values = 9;   // position now, impulse, position next
constexpr std::size_t velocity_values = 3;
// In forcing no_slip besides: the marker's volume; its NoSlipAnswer.
constexpr std::size_t marker_values_of(Forcing forcing) {
    return marker_values + (forcing == Forcing::no_slip ? 1 : 0);
}
constexpr std::size_t velocity_values_of(Forcing forcing) {
    return velocity_values + (forcing == Forcing::no_slip ? 4 : 0);
}

// Which exchange a message belongs to: the coupled step, -1 before the first, and within
// it the iteration of an implicit scheme or of iterated forcing.
struct Occasion {
    std::int64_t step = 0;
    int iteration = 0;
    Occasion(std::int64_t step_number, int repeated = 0)
        : step(step_number), iteration(repeated) {}
};

void write_header(std::vector<double>& message, const Occasion& when,
                  std::size_t markers);

// Throws PartnerLost when the message is of another step or iteration, or of another
// number of markers.
void check_header(std::span<const double> message, const Occasion& when,
                  std::size_t markers, const std::string& sender);

inline void put(double* at, const Vec3& v) {
    at[0] = v[0];
    at[1] = v[1];
    at[2] = v[2];
}
inline Vec3 get(const double* at) {
    return {at[0], at[1], at[2]};
}

// Whether the markers of this exchange are those of a new table; not when it is repeated.
inline bool renews_partners(const Occasion& when, const Renewal& renewal) {
    if (when.iteration > 0) return false;
    return when.step < 0 ||
           (when.step > 0 && (when.step + renewal.ahead) % renewal.every == 0);
}

// Whether a marker at point_m, moved by up to the margin, touches a cell of the box.
bool may_touch(const Grid& grid, Kernel kernel, const CellBox& box, const Vec3& point_m);

// For each fluid rank the markers it may meet, ascending. Throws Diverged when a point
// lies outside a box without periodic sides.
std::vector<std::vector<int>> partner_table(const Grid& grid, Kernel kernel,
                                            std::span<const Vec3> points_m);

// Throws Diverged when a marker moved further than the margin since the table was made.
void check_margin(const Grid& grid, std::span<const Vec3> then_m,
                  std::span<const Vec3> now_m, std::int64_t step);

// The structure rank's end.
class StructureExchange {
  public:
    // body_of: of each marker, of so many bodies in all; without it there is one.
    StructureExchange(const World& world, Grid grid, Kernel kernel, double timeout_s,
                      Forcing forcing = Forcing::penalty, std::size_t bodies = 1,
                      std::vector<int> body_of = {});

    // When an exception ends the run, messages still under way are kept.
    ~StructureExchange();
    StructureExchange(const StructureExchange&) = delete;
    StructureExchange& operator=(const StructureExchange&) = delete;

    // What the markers of this rank did: where they were (the impulse acts there), the
    // impulse given to the fluid [N s], where they are now. Step -1 asks for the
    // velocities at the first positions.
    // volume_m3: of each marker; in forcing no_slip only.
    void send(const Occasion& when, std::span<const Vec3> before_m,
              std::span<const Vec3> impulse, std::span<const Vec3> now_m,
              std::span<const double> volume_m3 = {});

    // The fluid's velocity [m/s] at the positions sent last: the sum of the ranks'
    // shares. In forcing no_slip what it says besides.
    void receive(const Occasion& when, std::span<Vec3> velocity,
                 NoSlipAnswer* more = nullptr);

    // Fluid ranks this rank exchanges messages with at present.
    int partners() const { return partners_.size(); }

  private:
    void renew(std::int64_t step, std::span<const Vec3> points_m);
    void let_follow(std::int64_t step, std::span<const Vec3> points_m);

    const World& world_;
    Grid grid_;  // its boxes change where it follows
    Kernel kernel_;
    double timeout_s_;
    Forcing forcing_;
    std::size_t bodies_;
    std::vector<int> body_of_;
    std::vector<std::vector<int>> table_;  // by fluid rank
    std::vector<int> partners_;            // fluid ranks that have any
    std::vector<Vec3> renewed_at_;
    std::vector<std::vector<double>> out_, in_;  // by fluid rank
    std::vector<MPI_Request> sending_;
};

// The markers that may touch this rank's cells, those of structure rank 0 first.
struct MarkerBatch {
    std::vector<Vec3> before_m;     // where the impulse acts
    std::vector<Vec3> impulse;      // given to the fluid [N s]
    std::vector<Vec3> now_m;        // where to sample next
    std::vector<double> volume_m3;  // in forcing no_slip
};

// The fluid rank's end.
class FluidExchange {
  public:
    // follower: a fluid whose grid follows, else null; outlives this.
    FluidExchange(const World& world, double timeout_s,
                  Forcing forcing = Forcing::penalty, GridFluid* follower = nullptr);

    // Waits until the last velocities are taken: MPI reads them from here. Not when an
    // exception ends the run, which the partner may have left already: then they are
    // kept.
    ~FluidExchange();
    FluidExchange(const FluidExchange&) = delete;
    FluidExchange& operator=(const FluidExchange&) = delete;

    // The structure's message of a coupled step; -1 is the one before the first. In it a
    // grid that stands as a checkpoint has it stays there.
    const MarkerBatch& receive(const Occasion& when, bool stays = false);

    // This rank's share of the velocities [m/s] at the batch's `now` positions, and in
    // forcing no_slip of what is said besides.
    void send(const Occasion& when, std::span<const Vec3> velocity,
              const NoSlipAnswer* more = nullptr);

    // Waits until the structure has them. A message too long for MPI's buffers moves only
    // while both sides are inside MPI: without this the structure may wait for a whole
    // step of a fluid that goes on to work.
    void finish_sending();

  private:
    void renew(std::int64_t step);
    void follow(std::int64_t step, bool stays);

    const World& world_;
    double timeout_s_;
    Forcing forcing_;
    GridFluid* follower_;
    std::vector<int> count_;     // markers by structure rank
    std::vector<int> partners_;  // structure ranks that have any
    std::vector<std::vector<double>> in_, out_;
    std::vector<MPI_Request> sending_;
    MarkerBatch batch_;
};

}  // namespace magfsi::coupler
