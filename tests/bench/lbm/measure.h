// Speed of one kind of step beside the in-place copy of the same moment.
#pragma once

#include <mpi.h>

#include <array>
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

}  // namespace magfsi::bench
