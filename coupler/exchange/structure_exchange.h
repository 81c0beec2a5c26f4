// The structure rank's end of the marker exchange.
#pragma once

#include <mpi.h>

#include <cstdint>
#include <span>
#include <vector>

#include "coupler/exchange/partner_table.h"
#include "coupler/participants/world.h"

namespace magfsi::coupler {

class StructureExchange {
  public:
    StructureExchange(const World& world, const Grid& grid, Kernel kernel,
                      double timeout_s);

    // What is still under way, when an exception ends the run, is kept.
    ~StructureExchange();
    StructureExchange(const StructureExchange&) = delete;
    StructureExchange& operator=(const StructureExchange&) = delete;

    // What the markers of this rank did in coupled step `step`: where they were (the
    // impulse acts there), the impulse given to the fluid [N s], where they are now.
    void send(const Occasion& when, std::span<const Vec3> before_m,
              std::span<const Vec3> impulse, std::span<const Vec3> now_m);

    // Further impulses of the markers sent last, in the same step; answered like the
    // first.
    void send_more(std::int64_t step, std::span<const Vec3> before_m,
                   std::span<const Vec3> impulse, std::span<const Vec3> now_m) {
        post(step, before_m, impulse, now_m);
    }

    // Before the first step: asks for the velocities at the first positions.
    void send_first(std::span<const Vec3> points_m);
    // After a restart, with what was under way between the two sides.
    void send_first(std::span<const Vec3> before_m, std::span<const Vec3> impulse,
                    std::span<const Vec3> now_m);

    // The fluid's velocity [m/s] at the positions sent last: the sum of the ranks'
    // shares.
    void receive(const Occasion& when, std::span<Vec3> velocity);

    // Fluid ranks this rank talks to at present.
    int partners() const;

  private:
    void renew(std::int64_t step, std::span<const Vec3> points_m);
    void post(const Occasion& when, std::span<const Vec3> before_m,
              std::span<const Vec3> impulse, std::span<const Vec3> now_m);

    const World& world_;
    const Grid& grid_;
    Kernel kernel_;
    double timeout_s_;
    std::vector<std::vector<int>> table_;  // by fluid rank
    std::vector<Vec3> renewed_at_;
    std::vector<std::vector<double>> out_, in_;  // by fluid rank
    std::vector<MPI_Request> sending_;
};

}  // namespace magfsi::coupler
