// The keys of prescribed motions, for bind.h.
#pragma once

#include "adapters/scene/names.h"

namespace magfsi::scene {

template <class Io>
void bind_keys(Io& io, Oscillation& oscillation) {
    io("amplitude", oscillation.amplitude_m);
    io("frequency", oscillation.frequency_hz);
    io("phase", oscillation.phase_rad);
}

template <class Io>
void bind_keys(Io& io, DisplacementRamp& ramp) {
    io("displacement", ramp.displacement_m);
    io("duration", ramp.duration_s);
}

template <class Io>
void bind_keys(Io& io, PrescribedMotion& motion) {
    io("face", motion.faces);
    io.alternatives(motion.course, {"oscillation", "ramp"});
}

}  // namespace magfsi::scene
