// The scene's word for a kernel.
#pragma once

#include "adapters/scene/scene.h"
#include "coupler/immersed_boundary/marker_stencil.h"

namespace magfsi::coupler {

inline Kernel to_kernel(scene::Kernel kernel) {
    switch (kernel) {
        case scene::Kernel::two_point:
            return Kernel::two_point;
        case scene::Kernel::three_point:
            return Kernel::three_point;
        case scene::Kernel::four_point:
            return Kernel::four_point;
    }
    return Kernel::three_point;
}

}  // namespace magfsi::coupler
