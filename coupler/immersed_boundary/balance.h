// The audit of the interface: what the body gave in a coupled step against what the
// fluid's cells received. Exists only when the scene asks for it
// (probes.interface_balance).
#pragma once

#include <mpi.h>

#include <span>
#include <vector>

#include "coupler/immersed_boundary/grid.h"

namespace magfsi::coupler {

// One side's sums over one coupled step.
struct InterfaceBalance {
    Vec3 impulse_n_s{};
    double work_j = 0;             // impulse times sampled fluid velocity
    double impulse_scale_n_s = 0;  // sum of magnitudes: the scale of rounding
    double work_scale_j = 0;
};

// Adds a marker's share.
void add_marker(InterfaceBalance& sum, const Vec3& impulse, const Vec3& fluid_velocity);

// One side's balances of the steps since it was last asked.
class BalanceRecord {
  public:
    void add(const InterfaceBalance& step) { steps_.push_back(step); }

    // Sums over the ranks of comm (valid on its root), six numbers a step; starts anew.
    std::vector<double> collect(MPI_Comm comm);

    // This rank's sums of those steps, six numbers a step, for a checkpoint, and back.
    std::vector<double> values() const;
    void set(std::span<const double> values);

  private:
    std::vector<InterfaceBalance> steps_;
};

constexpr std::size_t balance_values = 6;

struct Mismatch {
    double momentum = 0;  // |given - received| / sum of |impulse|
    double power = 0;     // |given - received| / sum of |impulse . velocity|
};

// The worst step. given carries the scales. Infinite where something was received though
// nothing was given, and where a number is not finite.
Mismatch worst_mismatch(std::span<const double> given, std::span<const double> received);

}  // namespace magfsi::coupler
