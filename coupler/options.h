// SPDX-License-Identifier: GPL-2.0-or-later
// How bodies and fluid meet, as users choose it: the scheme and the immersed boundary.
// The scene file describes these types themselves (adapters/scene/keys_coupling.cpp). The
// words of an enumeration stand beside it, in its order.
#pragma once

#include <array>
#include <optional>
#include <string_view>

#include "words/name_of.h"

namespace magfsi::coupler {

// Regularised delta functions (immersed_boundary/marker_stencil.h).
enum class Kernel { two_point, three_point, four_point };
constexpr auto words_of(Kernel) {
    return std::to_array<std::string_view>({"2-point", "3-point", "4-point"});
}

enum class Markers { mid_surface, both_faces, volume };
constexpr auto words_of(Markers) {
    return std::to_array<std::string_view>({"mid_surface", "both_faces", "volume"});
}

// How a marker's slip becomes a force: eq. (13) with the fluid of its own volume; or so
// that the fluid which passes the body has its velocity (immersed_boundary/no_slip.h).
enum class Forcing { penalty, no_slip };
constexpr auto words_of(Forcing) {
    return std::to_array<std::string_view>({"penalty", "no_slip"});
}

struct ImmersedBoundary {
    std::optional<Forcing> forcing;  // absent: no_slip wherever it can be
    Kernel kernel = Kernel::three_point;
    std::optional<Markers> markers;  // absent: by the body's shape
    double marker_spacing = 0.5;     // in units of the fluid's spacing
    double retraction = 0.4;         // of markers below the surface, in fluid spacings
    double rim_retraction = 0.9;     // at the rim of a sheet, likewise
    double strength = 1;             // beta of eq. (13) as a fraction of 2 rho dV / dt
    int iterations = 1;  // of the forcing in a coupled step; 1: direct forcing
};

// Who works while the other waits: one after the other; both at once with the fluid one
// step behind in the forces; or one after the other until both agree on the end of the
// step.
enum class Scheme { serial, parallel, implicit };
constexpr auto words_of(Scheme) {
    return std::to_array<std::string_view>({"serial", "parallel", "implicit"});
}

// Of the fluid at the markers over the structure's substeps.
enum class SampledVelocity { frozen, linear };
constexpr auto words_of(SampledVelocity) {
    return std::to_array<std::string_view>({"frozen", "linear"});
}

enum class AccelerationMethod { under_relaxation, aitken, iqn_ils };
constexpr auto words_of(AccelerationMethod) {
    return std::to_array<std::string_view>({"under_relaxation", "aitken", "iqn_ils"});
}
enum class ColumnFilter { qr1, qr2 };
constexpr auto words_of(ColumnFilter) {
    return std::to_array<std::string_view>({"qr1", "qr2"});
}
enum class InitialGuess { constant, linear };
constexpr auto words_of(InitialGuess) {
    return std::to_array<std::string_view>({"constant", "linear"});
}
enum class OnNoConvergence { stop, continue_ };
constexpr auto words_of(OnNoConvergence) {
    return std::to_array<std::string_view>({"stop", "continue"});
}

// Of the implicit scheme: how a step is repeated.
struct Iteration {
    AccelerationMethod acceleration = AccelerationMethod::iqn_ils;
    double velocity_tolerance =
        1e-4;                 // residual over the fluid's velocity at the markers
    int max_iterations = 20;  // per step
    OnNoConvergence on_no_convergence = OnNoConvergence::stop;
    InitialGuess initial_guess = InitialGuess::linear;
    double relaxation = 0.5;
    int max_used_iterations = 40;  // IQN-ILS: columns of the least-squares model
    int reused_steps = 8;          // IQN-ILS: whose iterations are kept
    ColumnFilter filter = ColumnFilter::qr2;
    double filter_limit = 1e-2;
};

// Surfaces that pass through each other, an obstacle or a side of the box.
enum class OverlapRule { stop, allow };
constexpr auto words_of(OverlapRule) {
    return std::to_array<std::string_view>({"stop", "allow"});
}

// The scene's, or that of a program of the user's own.
enum class StructureSide { bodies, own };
constexpr auto words_of(StructureSide) {
    return std::to_array<std::string_view>({"bodies", "own"});
}

struct Coupling {
    Scheme scheme = Scheme::serial;
    StructureSide structure = StructureSide::bodies;
    std::optional<SampledVelocity> sampled_velocity;  // a read scene always has it
    std::optional<Iteration> iteration;  // always there in the implicit scheme
    std::optional<int> substeps;         // absent: from the structure's stable step
    std::optional<double> timeout_s;     // absent: a partner that lives is waited for
    OverlapRule overlap = OverlapRule::stop;
    ImmersedBoundary immersed_boundary;
};

}  // namespace magfsi::coupler
