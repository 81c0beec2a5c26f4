// SPDX-License-Identifier: GPL-2.0-or-later
// Materials that stiffen, for tests, and the roots by which their limits are found.
#pragma once

#include <functional>

#include "tests/unit/structure/elements.h"

namespace magfsi::structure::test {

inline Material rubber(const Stiffening& law) {
    Material material = test::soft_material();
    material.stiffening = law;
    return material;
}

// Root of a function that rises from below zero at `low` to above zero at `high`.
inline double root(const std::function<double(double)>& f, double low, double high) {
    for (int i = 0; i < 200; ++i) {
        const double middle = 0.5 * (low + high);
        (f(middle) < 0 ? low : high) = middle;
    }
    return 0.5 * (low + high);
}

}  // namespace magfsi::structure::test
