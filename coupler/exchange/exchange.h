// SPDX-License-Identifier: GPL-2.0-or-later
// The two messages of a coupled step and both ends of their exchange.
//
// Messages consist of doubles, in which step numbers and counts are exact. Each message
// carries its step, and a receiver refuses any other. A structure rank sends only to the
// fluid ranks whose cells its markers can reach. This partner table is renewed every few
// coupled steps, with a margin that no marker may cross in between, so that most steps
// need no further messages. With a grid that follows the bodies, the fluid learns the
// bodies' positions at each renewal and replies with the boxes of cells that its ranks
// then own.
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

constexpr int marker_tag = 81;    // marker data, structure -> fluid
constexpr int velocity_tag = 82;  // sampled velocities, fluid -> structure
constexpr int place_tag = 83;     // both ways, only if the grid follows the bodies

// Numbers at the head of a message: step, iteration, number of markers.
constexpr std::size_t message_header = 3;
// Numbers per marker: the position at t(n), the impulse and the position at t(n+1); the
// sampled velocity in the answer.
constexpr std::size_t marker_values = 9;
constexpr std::size_t velocity_values = 3;
// Numbers per marker with forcing no_slip, which adds the marker's volume to the message
// and its NoSlipAnswer (row sum and q) to the answer.
constexpr std::size_t marker_values_of(Forcing forcing) {
    return marker_values + (forcing == Forcing::no_slip ? 1 : 0);
}
constexpr std::size_t velocity_values_of(Forcing forcing) {
    return velocity_values + (forcing == Forcing::no_slip ? 4 : 0);
}

// The exchange that a message belongs to: the coupled step, -1 for the exchange before
// the first one, and the iteration of the implicit scheme within it.
struct Occasion {
    std::int64_t step = 0;
    int iteration = 0;
    Occasion(std::int64_t step_number, int repeated = 0)
        : step(step_number), iteration(repeated) {}
};

// Writes the three numbers at the head of a message.
void write_header(std::vector<double>& message, const Occasion& when,
                  std::size_t markers);

// Throws PartnerLost if the message is of another step, iteration or number of markers.
// sender: its name in the error text.
void check_header(std::span<const double> message, const Occasion& when,
                  std::size_t markers, const std::string& sender);

// Copies a vector into a message.
inline void put(double* at, const Vec3& v) {
    at[0] = v[0];
    at[1] = v[1];
    at[2] = v[2];
}

// True if this exchange starts with a new partner table; repetitions of a step keep it.
inline bool renews_partners(const Occasion& when, const Renewal& renewal) {
    if (when.iteration > 0) return false;
    return when.step < 0 ||
           (when.step > 0 && (when.step + renewal.ahead) % renewal.every == 0);
}

// True if a marker at point_m [m], moved by up to the margin along each axis, touches a
// cell of the box.
bool may_touch(const Grid& grid, Kernel kernel, const CellBox& box, const Vec3& point_m);

// For each fluid rank the indices of the markers that may touch its cells until the next
// renewal, ascending. Throws Diverged if a point lies outside the box along an axis that
// is not periodic.
std::vector<std::vector<int>> partner_table(const Grid& grid, Kernel kernel,
                                            std::span<const Vec3> points_m);

// Throws Diverged if a marker has moved further than the margin since the table was made;
// then_m and now_m: positions [m] by marker.
void check_margin(const Grid& grid, std::span<const Vec3> then_m,
                  std::span<const Vec3> now_m, std::int64_t step);

// The end of the exchange on a structure rank. Calls are made by every rank of the
// structure at the same occasions.
class StructureExchange {
  public:
    // body_of: the number of the body of each marker, below `bodies`; if empty all
    // markers are of one body. The bodies matter only to a grid that follows them. world
    // must outlive this object; timeout_s: longest wait for the fluid [s].
    StructureExchange(const World& world, Grid grid, Kernel kernel, double timeout_s,
                      Forcing forcing = Forcing::penalty, std::size_t bodies = 1,
                      std::vector<int> body_of = {});

    // Keeps the buffers of messages that are still under way, in case an exception ends
    // the run.
    ~StructureExchange();
    StructureExchange(const StructureExchange&) = delete;
    StructureExchange& operator=(const StructureExchange&) = delete;

    // Sends this rank's markers: positions [m] at the start of the step, where the
    // impulses act, the impulses given to the fluid [N s], and the positions [m] at its
    // end. Step -1 only asks for the velocities at the first positions. volume_m3: fluid
    // volume of each marker, in forcing no_slip only. Renews the partner table when due.
    // Throws Diverged if a marker has crossed the margin or left the box.
    void send(const Occasion& when, std::span<const Vec3> before_m,
              std::span<const Vec3> impulse, std::span<const Vec3> now_m,
              std::span<const double> volume_m3 = {});

    // Receives the fluid's velocity [m/s] at the positions now_m that were sent last: the
    // sum of the fluid ranks' shares. more: the answer of forcing no_slip, otherwise
    // null. Throws PartnerLost, TimedOut or Stopped.
    void receive(const Occasion& when, std::span<Vec3> velocity,
                 NoSlipAnswer* more = nullptr);

    // Number of fluid ranks with which this rank exchanges messages.
    int partners() const { return partners_.size(); }

  private:
    // Makes a new partner table and tells every fluid rank how many markers it gets.
    void renew(std::int64_t step, std::span<const Vec3> points_m);
    // Sends the bodies' bounding boxes to a grid that follows them and receives its new
    // boxes.
    void let_follow(std::int64_t step, std::span<const Vec3> points_m);

    const World& world_;
    Grid grid_;  // boxes change if the grid follows the bodies
    Kernel kernel_;
    double timeout_s_;
    Forcing forcing_;
    std::size_t bodies_;
    std::vector<int> body_of_;
    std::vector<std::vector<int>> table_;  // marker indices by fluid rank
    std::vector<int> partners_;            // fluid ranks with at least one marker
    // Marker positions [m] when the table was made.
    std::vector<Vec3> renewed_at_;
    std::vector<std::vector<double>> out_, in_;  // messages by fluid rank
    // Requests of sends that receive() completes.
    std::vector<MPI_Request> sending_;
};

// Markers that may touch this rank's cells, in the order of the structure ranks.
struct MarkerBatch {
    std::vector<Vec3> before_m;     // positions where the impulses act [m]
    std::vector<Vec3> impulse;      // given to the fluid [N s]
    std::vector<Vec3> now_m;        // positions to sample next [m]
    std::vector<double> volume_m3;  // filled in forcing no_slip only
};

// The end of the exchange on a fluid rank. Calls are made by every rank of the fluid at
// the same occasions.
class FluidExchange {
  public:
    // follower: the fluid if its grid follows the bodies, else null. world and follower
    // must outlive this object.
    FluidExchange(const World& world, double timeout_s,
                  Forcing forcing = Forcing::penalty, GridFluid* follower = nullptr);

    // Waits until the structure has received the last velocities, because MPI reads them
    // from this object's buffers. If an exception ends the run the partner may be gone
    // already: the buffers are kept then, without waiting.
    ~FluidExchange();
    FluidExchange(const FluidExchange&) = delete;
    FluidExchange& operator=(const FluidExchange&) = delete;

    // Receives the markers of a coupled step; step -1 is the exchange before the first
    // one. stays: the grid keeps its place in this exchange, as after a restart, when it
    // stands as the checkpoint has it. The batch is valid until the next call. Throws
    // PartnerLost, TimedOut or Stopped.
    const MarkerBatch& receive(const Occasion& when, bool stays = false);

    // Sends this rank's share of the velocities [m/s] at the batch's now_m, and in
    // forcing no_slip its share of the answer.
    void send(const Occasion& when, std::span<const Vec3> velocity,
              const NoSlipAnswer* more = nullptr);

  private:
    // Receives the number of markers from every structure rank and sizes the buffers.
    void renew(std::int64_t step);
    // Moves a grid that follows the bodies (unless it stays) and sends its boxes back.
    void follow(std::int64_t step, bool stays);

    const World& world_;
    double timeout_s_;
    Forcing forcing_;
    GridFluid* follower_;
    std::vector<int> count_;     // number of markers by structure rank
    std::vector<int> partners_;  // structure ranks with at least one marker
    std::vector<std::vector<double>> in_, out_;  // messages by structure rank
    std::vector<MPI_Request> sending_;
    MarkerBatch batch_;
};

}  // namespace magfsi::coupler
