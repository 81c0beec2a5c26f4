// Memory of this process.
#pragma once

#include <cstdint>

namespace magfsi::output {

// Most physical memory that this process ever held, in bytes (VmHWM of
// /proc/self/status). 0 where the kernel does not tell.
std::int64_t peak_resident_bytes();

}  // namespace magfsi::output
