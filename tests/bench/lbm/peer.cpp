#include "tests/bench/lbm/peer.h"

#include <fmt/format.h>

#include <array>
#include <cstdio>
#include <cstdlib>
#include <stdexcept>

namespace magfsi::bench {

namespace {

// Without the variables by which a program under mpirun finds its own job, or the peer's
// mpirun would join it.
constexpr const char* clean_environment =
    "env -i PATH=\"$PATH\" HOME=\"$HOME\" OMPI_ALLOW_RUN_AS_ROOT=1 "
    "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 OMPI_MCA_rmaps_base_oversubscribe=1 "
    "OMPI_MCA_hwloc_base_binding_policy=none OMP_NUM_THREADS=1 ";

}  // namespace

double peer_mlups(const std::string& program, const Settings& settings,
                  const std::string& kind, int ranks) {
    const std::string command = fmt::format(
        "{} mpirun -n {} '{}' {} {} {} {} {}", clean_environment, ranks, program, kind,
        settings.cells[0], settings.cells[1], settings.cells[2], settings.seconds);
    FILE* pipe = popen(command.c_str(), "r");
    if (pipe == nullptr) throw std::runtime_error("cannot run " + command);
    std::string last;
    std::array<char, 256> line{};
    while (std::fgets(line.data(), line.size(), pipe) != nullptr) last = line.data();
    const int status = pclose(pipe);
    char* end = nullptr;
    const double mlups = std::strtod(last.c_str(), &end);
    if (status != 0 || end == last.c_str()) {
        throw std::runtime_error("peer program failed: " + command);
    }
    return mlups;
}

}  // namespace magfsi::bench
