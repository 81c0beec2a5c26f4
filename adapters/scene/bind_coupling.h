// The keys of coupling.h, for bind.h.
#pragma once

#include "adapters/scene/names.h"

namespace magfsi::scene {

template <class Io>
void bind_keys(Io& io, ImmersedBoundary& boundary) {
    io("kernel", boundary.kernel);
    io("markers", boundary.markers);
    io("marker_spacing", boundary.marker_spacing);
    io("retraction", boundary.retraction);
    io("rim_retraction", boundary.rim_retraction);
    io("strength", boundary.strength);
    io("iterations", boundary.iterations);
}

template <class Io>
void bind_keys(Io& io, Iteration& iteration) {
    io("acceleration", iteration.acceleration);
    io("velocity_tolerance", iteration.velocity_tolerance);
    io("max_iterations", iteration.max_iterations);
    io("on_no_convergence", iteration.on_no_convergence);
    io("initial_guess", iteration.initial_guess);
    io("relaxation", iteration.relaxation);
    io("max_used_iterations", iteration.max_used_iterations);
    io("reused_steps", iteration.reused_steps);
    io("filter", iteration.filter);
    io("filter_limit", iteration.filter_limit);
}

template <class Io>
void bind_keys(Io& io, Coupling& coupling) {
    io("scheme", coupling.scheme);
    io("sampled_velocity", coupling.sampled_velocity);
    io("iteration", coupling.iteration);
    io("substeps", coupling.substeps);
    io("timeout", coupling.timeout_s);
    io("immersed_boundary", coupling.immersed_boundary);
}

}  // namespace magfsi::scene
