// Everything at the six sides of this rank's box besides half-way bounce-back, which the
// sweep does itself: the effects of effects.inc that the scene asks for.
#pragma once

#include <memory>
#include <vector>

#include "fluid_lbm/boundary/side_effect.h"

namespace magfsi::fluid {

class Boundaries {
  public:
    // Throws std::invalid_argument on all ranks if one has an outlet but no cell behind
    // it, or if a side asks for what is not in this build.
    explicit Boundaries(const SideContext& context);

    // Outlets note what enters in the coming step.
    void before_sweep(const Populations& populations, Arrangement arrangement);
    // After the exchange, in this order: what leaves an edge of two sides is reflected,
    // then gains the terms of walls and inlets, and outlets see the result. Time: steps.
    // Collective.
    void enter(const Populations& populations, const RowLayout& layout, double time);
    // In the new arrangement: outlets rebuild their cells.
    void end_step(const Populations& populations, Arrangement arrangement);

  private:
    std::vector<std::unique_ptr<SideEffect>> effects_;  // in the order of the list
};

}  // namespace magfsi::fluid
