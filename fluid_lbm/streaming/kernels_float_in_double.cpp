// Compiled once for each instruction set (cmake/IsaVariants.cmake).
#include "fluid_lbm/streaming/kernel_table.h"

namespace magfsi::fluid::MAGFSI_ISA {

extern const KernelTable<float> on_float_in_double;
constinit const KernelTable<float> on_float_in_double =
    kernel_table<float, double>(RegisteredCollisions{});

}  // namespace magfsi::fluid::MAGFSI_ISA
