// Compiled once for each instruction set (cmake/IsaVariants.cmake).
#include "fluid_lbm/streaming/kernel_table.h"

namespace magfsi::fluid::MAGFSI_ISA {

extern const KernelTable<float> on_float;
constinit const KernelTable<float> on_float =
    kernel_table<float, float>(RegisteredCollisions{});

}  // namespace magfsi::fluid::MAGFSI_ISA
