// SPDX-License-Identifier: GPL-2.0-or-later
// The objects that the outputs of a fluid participant read and write.
#pragma once

#include "adapters/solvers/fluids/fluid_solver.h"
#include "coupler/immersed_boundary/balance.h"
#include "coupler/participants/session.h"
#include "coupler/step/task_list.h"

namespace magfsi::fluids {

// Passed to every output of a fluid participant; all members outlive the outputs.
struct FluidRun {
    const scene::Scene& scene;
    coupler::Session& session;
    FluidSolver& fluid;
    coupler::BalanceRecord* balance = nullptr;  // set only with probes.interface_balance
};

// An output listed in outputs.inc is an object of this type, called NAME_output.
using FluidOutput = coupler::OutputKind<FluidRun>;

}  // namespace magfsi::fluids
