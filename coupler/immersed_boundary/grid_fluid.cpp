#include "coupler/immersed_boundary/grid_fluid.h"

#include <stdexcept>

namespace magfsi::coupler {

namespace {

[[noreturn]] void refuse() {
    throw std::invalid_argument(
        "coupling.scheme: implicit repeats steps, and this fluid cannot go back to the "
        "start of one; take serial or parallel, or fluid.solver: lbm");
}

}  // namespace

void GridFluid::keep() {
    refuse();
}
void GridFluid::go_back() {
    refuse();
}

}  // namespace magfsi::coupler
