// SPDX-License-Identifier: GPL-2.0-or-later
// Speed of one kind of step beside the in-place copy of the same moment.
#pragma once

#include <mpi.h>

#include <array>
#include <cstddef>
#include <memory>
#include <string>
#include <vector>

#include "fluid_lbm/fluid.h"

namespace magfsi::bench {

struct Variant {
    fluid::Collision collision = fluid::Collision::automatic;
    fluid::Precision precision = fluid::Precision::double_;
    double forced_share = 0;  // of the rows
};

struct Settings {
    std::array<int, 3> cells{};
    double seconds = 0.3;  // of each measurement
    int repetitions = 7;
};

struct Spread {
    double median = 0, low = 0, high = 0;
};
Spread spread(std::vector<double> values);

struct Result {
    Variant variant;
    Spread mlups;           // million cells stepped per second, all ranks
    Spread copy_gb_s;       // read plus write
    Spread share_of_limit;  // of copy over 2 x 19 numbers a cell, pair by pair
    Spread exchange_share;  // of a step's time: the halo exchange, done alone
};

// Steps and copies in turn. Collective.
Result measure(MPI_Comm comm, const Settings& settings, const Variant& variant);

// What in-place streaming is held against: every number of an array read and written back
// changed, by the same ranks and threads, with the same prefetch.
class InPlaceCopy {
  public:
    // bytes: of this rank. Threads touch first what they will change.
    InPlaceCopy(MPI_Comm comm, std::size_t bytes);

    // Bytes read plus bytes written by all ranks, per second; about this long.
    // Collective.
    double bytes_per_second(double seconds);

  private:
    void pass();

    struct Free {
        void operator()(double* memory) const;
    };
    MPI_Comm comm_;
    std::ptrdiff_t lines_;
    std::unique_ptr<double[], Free> memory_;
};

// Another program on the same box, run by its own command: million cells stepped per
// second that it prints as its last number; called on one rank. Throws std::runtime_error
// if it cannot be run.
double peer_mlups(const std::string& program, const Settings& settings,
                  const std::string& kind, int ranks);

}  // namespace magfsi::bench
