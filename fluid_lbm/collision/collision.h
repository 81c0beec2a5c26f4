// Names of the collisions; collision/registered.h says which kernel each one is.
#pragma once

namespace magfsi::fluid {

enum class Collision { automatic, bgk, trt, recursive_regularized };

}  // namespace magfsi::fluid
