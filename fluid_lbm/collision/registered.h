// The collisions that exist, one line each. A new one is a file like bgk.h, an enumerator
// in collision.h and its line here.
#pragma once

#include "fluid_lbm/collision/bgk.h"
#include "fluid_lbm/collision/recursive_regularized.h"
#include "fluid_lbm/collision/trt.h"

namespace magfsi::fluid {

template <class... Kinds>
struct CollisionList {
    static constexpr int count = sizeof...(Kinds);
};

using RegisteredCollisions = CollisionList<Bgk,                 //
                                           TwoRelaxationTimes,  //
                                           RecursiveRegularized>;

}  // namespace magfsi::fluid
