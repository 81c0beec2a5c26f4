// SPDX-License-Identifier: GPL-2.0-or-later
// Options of the coupling that users choose: the scheme and the immersed boundary. The
// scene file describes these types (adapters/scene/keys_coupling.cpp). words_of returns
// the words of an enumeration in the order of its values.
#pragma once

#include <array>
#include <optional>
#include <string_view>

#include "base/words/name_of.h"

namespace magfsi::coupler {

// Kernels: regularised delta functions (immersed_boundary/marker_stencil.h).
enum class Kernel { two_point, three_point, four_point };
constexpr auto words_of(Kernel) {
    return std::to_array<std::string_view>({"2-point", "3-point", "4-point"});
}

// The law that turns a marker's slip into a force. penalty: eq. (13) with the fluid of
// the marker's own volume. no_slip: the force that gives the fluid passing the body the
// body's velocity (immersed_boundary/no_slip.h).
enum class Forcing { penalty, no_slip };
constexpr auto words_of(Forcing) {
    return std::to_array<std::string_view>({"penalty", "no_slip"});
}

// Options of the immersed boundary.
struct ImmersedBoundary {
    std::optional<Forcing> forcing;  // absent: no_slip where possible
    Kernel kernel = Kernel::three_point;
    double strength = 1;  // kappa of eq. (13) over 2 rho dV / dt
};

// Steps of the two solvers, which take turns. serial: one step each. implicit: both
// repeat the step until the fluid's velocity at the markers has converged.
enum class Scheme { serial, implicit };
constexpr auto words_of(Scheme) {
    return std::to_array<std::string_view>({"serial", "implicit"});
}

// The fluid's velocity at the markers during the structure's substeps: held, or
// extrapolated linearly from the last two samples.
enum class SampledVelocity { frozen, linear };
constexpr auto words_of(SampledVelocity) {
    return std::to_array<std::string_view>({"frozen", "linear"});
}

// Methods that make the next guess of an implicit step (scheme/acceleration.h).
enum class AccelerationMethod { aitken, iqn_ils };
constexpr auto words_of(AccelerationMethod) {
    return std::to_array<std::string_view>({"aitken", "iqn_ils"});
}
// First guess of an implicit step: the velocities at its start, or extrapolated from the
// step before.
enum class InitialGuess { constant, linear };
constexpr auto words_of(InitialGuess) {
    return std::to_array<std::string_view>({"constant", "linear"});
}
// Reaction when max_iterations do not suffice: the run diverges, or goes on and counts
// the step.
enum class OnNoConvergence { stop, continue_ };
constexpr auto words_of(OnNoConvergence) {
    return std::to_array<std::string_view>({"stop", "continue"});
}

// The iterations of an implicit step.
struct Iteration {
    AccelerationMethod acceleration = AccelerationMethod::iqn_ils;
    // Largest residual, relative to the fluid's velocity at the markers (both as norms).
    double velocity_tolerance = 1e-4;
    int max_iterations = 20;  // limit per coupled step
    OnNoConvergence on_no_convergence = OnNoConvergence::stop;
    InitialGuess initial_guess = InitialGuess::linear;
    // Factor of the residual in the first iteration of aitken, and in iterations of
    // iqn_ils without a column.
    double relaxation = 0.5;
    int max_used_iterations = 40;  // IQN-ILS: columns in the least-squares model
    int reused_steps = 8;          // IQN-ILS: steps whose columns are kept
    // IQN-ILS: independent part of a column, relative to the column, below which it is
    // dropped (scheme/least_squares.h).
    double filter_limit = 1e-2;
};

// Reaction to surfaces that pass through each other, an obstacle or a side of the box.
enum class OverlapRule { stop, allow };
constexpr auto words_of(OverlapRule) {
    return std::to_array<std::string_view>({"stop", "allow"});
}

// The program of the structure: the scene's bodies, or a program of the user's own.
enum class StructureSide { bodies, own };
constexpr auto words_of(StructureSide) {
    return std::to_array<std::string_view>({"bodies", "own"});
}

// All options of the coupling.
struct Coupling {
    Scheme scheme = Scheme::serial;
    StructureSide structure = StructureSide::bodies;
    // Always set in a scene that was read.
    std::optional<SampledVelocity> sampled_velocity;
    std::optional<Iteration> iteration;  // always set for the implicit scheme
    std::optional<int> substeps;         // absent: from the stable step
    // Longest wait for the partner [s]; absent: as long as it lives.
    std::optional<double> timeout_s;
    OverlapRule overlap = OverlapRule::stop;
    ImmersedBoundary immersed_boundary;
};

}  // namespace magfsi::coupler
