// How bodies and fluid meet: the scheme and the immersed boundary.
#pragma once

#include <optional>

namespace magfsi::scene {

enum class Kernel { two_point, three_point, four_point };
enum class Markers { mid_surface, both_faces, volume };

struct ImmersedBoundary {
    Kernel kernel = Kernel::three_point;
    std::optional<Markers> markers;  // absent: by the body's shape
    double marker_spacing = 0.5;     // in units of the fluid's spacing
    double retraction = 0.4;         // of markers below the surface, in fluid spacings
    double rim_retraction = 0.9;     // at the rim of a sheet, likewise
    double strength = 1.0;           // beta of eq. (13) as a fraction of 2 rho dV / dt
    int iterations = 1;  // of the forcing in a coupled step; 1: direct forcing
};

// Who works while the other waits: in turns, both at once with the fluid one step behind
// in the forces, or in turns until both agree on the end of the step.
enum class Scheme { serial, parallel, implicit };

// Of the fluid at the markers over the structure's substeps.
enum class SampledVelocity { frozen, linear };

enum class Acceleration { under_relaxation, aitken, iqn_ils };
enum class ColumnFilter { qr1, qr2 };
enum class FirstGuess { constant, linear };
enum class Unconverged { stop, go_on };

struct Iteration {
    Acceleration acceleration = Acceleration::iqn_ils;
    double velocity_tolerance =
        1e-4;       // residual over the fluid's velocity at the markers
    int most = 20;  // iterations a step
    Unconverged unconverged = Unconverged::stop;
    FirstGuess first_guess = FirstGuess::linear;
    double relaxation = 0.5;
    int columns = 40;      // IQN-ILS: at most
    int reused_steps = 8;  // IQN-ILS: whose columns are kept
    ColumnFilter filter = ColumnFilter::qr2;
    double filter_limit = 1e-2;
};

struct Coupling {
    Scheme scheme = Scheme::serial;
    std::optional<SampledVelocity> sampled_velocity;  // never absent: by the scheme
    std::optional<Iteration> iteration;  // always there in the implicit scheme
    std::optional<int> substeps;         // absent: from the structure's stable step
    ImmersedBoundary immersed_boundary;
    double timeout_s = 60;
};

}  // namespace magfsi::scene
