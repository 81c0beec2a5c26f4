// SPDX-License-Identifier: GPL-2.0-or-later
// What a fluid participant's outputs are made from.
#pragma once

#include "adapters/fluids/fluid_solver.h"
#include "coupler/immersed_boundary/balance.h"
#include "coupler/participants/session.h"
#include "coupler/step/task_list.h"

namespace magfsi::fluids {

struct FluidRun {
    const scene::Scene& scene;
    coupler::Session& session;
    FluidSolver& fluid;
    coupler::BalanceRecord* balance = nullptr;  // null where the scene has none
};

// An output of outputs.inc is an object of this type, called NAME_output.
using FluidOutput = coupler::OutputKind<FluidRun>;

}  // namespace magfsi::fluids
