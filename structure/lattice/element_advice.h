// What a choice of elements does to a plate's stiffness, before anything is run.
#pragma once

#include <string>

#include "structure/body.h"

namespace magfsi::structure {

// Stiffness of the mesh over the exact one, less 1, in small deformation: negative is too
// soft. Where a mode has two directions, the worse one.
struct ElementAdvice {
    double bending_error = 0;  // of plates and of narrow beams, about both in-plane axes
    double twist_error = 0;
    double dome_error = 0;    // both curvatures alike
    double saddle_error = 0;  // of opposite sign
    std::string text;  // what is wrong and what helps; empty where no error is above 5 %
    double worst() const;  // of largest magnitude
};

// For bricks with these edges in that many layers along the thickness axis (0, 1, 2).
// Throws std::invalid_argument on edges or a number of layers that are not positive.
ElementAdvice element_advice(ElementVariant variant, const Vec3& edges_m,
                             int thickness_axis, int layers, const Material& material);

}  // namespace magfsi::structure
