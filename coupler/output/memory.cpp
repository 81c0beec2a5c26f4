#include "coupler/output/memory.h"

#include <fstream>
#include <string>

namespace magfsi::output {

std::int64_t peak_resident_bytes() {
    std::ifstream status("/proc/self/status");
    for (std::string key; status >> key; std::getline(status, key)) {
        std::int64_t kibibytes = 0;
        if (key == "VmHWM:" && status >> kibibytes) return 1024 * kibibytes;
    }
    return 0;
}

}  // namespace magfsi::output
