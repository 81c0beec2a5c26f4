// SPDX-License-Identifier: GPL-2.0-or-later
// The ranks of a test in two roles: the first are the structure, the others the fluid.
#pragma once

#include <mpi.h>

#include <vector>

#include "coupler/exchange/exchange.h"
#include "coupler/participants/world.h"
#include "tests/support/checks.h"

namespace magfsi::coupler::testing {

// Far more than any message of these tests takes, far less than CTest's patience.
constexpr double timeout_s = 30;

inline int world_rank() {
    int rank = 0;
    MPI_Comm_rank(MPI_COMM_WORLD, &rank);
    return rank;
}

inline int world_size() {
    int size = 0;
    MPI_Comm_size(MPI_COMM_WORLD, &size);
    return size;
}

// Numbers of structure ranks to try: 1+1, 1+2 and 2+1, 2+2, 2+3 and 3+2.
inline std::vector<int> splits() {
    const int size = world_size();
    if (size == 2) return {1};
    if (size == 3) return {1, 2};
    if (size == 4) return {2};
    return {2, size - 2};
}

inline Role role_in(int structure_ranks) {
    return world_rank() < structure_ranks ? Role::structure : Role::fluid;
}

// The message before the first step.
inline void send_first(StructureExchange& exchange, const std::vector<Vec3>& points_m) {
    exchange.send(-1, points_m, std::vector<Vec3>(points_m.size()), points_m);
}

}  // namespace magfsi::coupler::testing
