// Compiled once for each instruction set (cmake/IsaVariants.cmake).
#include "fluid_lbm/streaming/kernel_table.h"

namespace magfsi::fluid::MAGFSI_ISA {

extern const KernelTable<double> on_double;
constinit const KernelTable<double> on_double =
    kernel_table<double, double>(RegisteredCollisions{});

}  // namespace magfsi::fluid::MAGFSI_ISA
