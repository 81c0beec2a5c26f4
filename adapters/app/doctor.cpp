// SPDX-License-Identifier: GPL-2.0-or-later
// One function look_at_... for each check: it returns what it found, or throws a Fault
// with the cure.
#include "adapters/app/doctor.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/resource.h>
#include <unistd.h>

#include <array>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <functional>
#include <stdexcept>
#include <string>

#include "adapters/app/host_name.h"
#include "adapters/app/job.h"
#include "adapters/run_scene.h"
#include "adapters/solvers/openfoam/explain.h"
#include "base/files/temporary_folder.h"
#include "coupler/output/file.h"
#include "coupler/output/run_folder.h"
#include "coupler/participants/errors.h"

namespace magfsi::launch {

namespace fs = std::filesystem;

namespace {

// A failed check; its message says what is wrong and how to cure it.
using Fault = std::runtime_error;

// A small fluid that exchanges populations between two ranks for a few steps.
constexpr auto small_scene = R"(time: {end: 2 ms}
fluid: {box: [8 mm, 8 mm, 8 mm], spacing: 1 mm, density: 1000 kg/m3,
        viscosity: 10 mm2/s, expected_speed: 0.1 m/s}
)";

// The names of the folders that it makes begin with this.
constexpr const char* own_name = "magfsi-doctor";

// Decimal megabytes, rounded down.
std::string megabytes(std::uintmax_t bytes) {
    return fmt::format("{} MB", bytes / 1'000'000);
}

// The number of cores is that of this process's affinity mask.
std::string look_at_cores() {
    return fmt::format("{}, {} to this process", processor(), available_cores());
}

// need_stack raises the limit as far as it may, and throws where that is not enough.
std::string look_at_stack() {
    need_stack();
    struct rlimit stack {};
    getrlimit(RLIMIT_STACK, &stack);
    return stack.rlim_cur == RLIM_INFINITY ? "unlimited"
                                           : fmt::format("{} kB", stack.rlim_cur / 1024);
}

// A slow look-up of the host's name delays every start of MPI.
std::string look_at_name() {
    const std::string fault = fault_of_host_name();
    if (!fault.empty()) throw Fault(fault);
    return host_name();
}

// Checks that the folder is writable and has `least` bytes left. /dev/shm carries the
// messages between ranks of one machine.
std::string look_at_space(const fs::path& where, std::uintmax_t least) {
    const files::TemporaryFolder folder(own_name, where);  // a proof that it is writable
    const fs::space_info space = fs::space(where);
    if (space.available < least)
        throw Fault(fmt::format("{} has {} left, at least {} are needed; make room",
                                where.string(), megabytes(space.available),
                                megabytes(least)));
    return fmt::format("{}, {} left", where.string(), megabytes(space.available));
}

// Run folders are protected by file locks, which some network file systems lack.
std::string look_at_locks() {
    const files::TemporaryFolder folder(own_name, fs::current_path());
    const output::FolderLock lock(folder.path(), output::FolderLock::Holder::launcher, 0);
    if (!lock.held())
        throw Fault(
            "the file system here has no locks: two runs in one folder would not "
            "be noticed; see docs/run_folder.md");
    return fs::current_path().string();
}

// Discards what a job prints on stdout during its scope; stderr stays visible.
class WithoutOutput {
  public:
    WithoutOutput() : kept_(dup(STDOUT_FILENO)) {
        std::fflush(stdout);
        const int nothing = open("/dev/null", O_WRONLY | O_CLOEXEC);
        dup2(nothing, STDOUT_FILENO);
        close(nothing);
    }
    ~WithoutOutput() {
        dup2(kept_, STDOUT_FILENO);
        close(kept_);
    }
    WithoutOutput(const WithoutOutput&) = delete;
    WithoutOutput& operator=(const WithoutOutput&) = delete;

  private:
    int kept_;
};

// Throws if every mpirun on PATH belongs to another MPI.
std::string look_at_mpirun() {
    const Mpirun& mpirun = find_mpirun();
    const std::string version =
        mpirun.version > 0 ? fmt::format(", Open MPI {}", mpirun.version) : "";
    if (mpirun.passed_over.empty()) return mpirun.program + version;
    return fmt::format("{}{}; passed over: {}, of another MPI", mpirun.program, version,
                       mpirun.passed_over);
}

// Starts mpirun with two ranks of the fluid solver, the only check that shows a broken
// MPI.
std::string look_at_mpi() {
    const files::TemporaryFolder folder(own_name);
    const fs::path scene = folder / "scene.yaml";
    output::write_atomically(scene, small_scene);
    const fs::path program =
        fs::read_symlink("/proc/self/exe").parent_path() / "magfsi-fluid-lbm";
    const auto start = std::chrono::steady_clock::now();
    const WithoutOutput quiet;
    const JobEnd end = run_job({{"fluid",
                                 2,
                                 {program.string(), scene.string(), "--out",
                                  (folder / "run").string(), "--progress", "off"}}},
                               OnStop::end);
    if (end.exit_code != 0 || !fs::exists(folder / "run" / "summary.json"))
        throw Fault(
            fmt::format("two ranks of mpirun ended with code {}; what it said is "
                        "above",
                        end.exit_code));
    return fmt::format(
        "two ranks started, talked and ended in {:.1f} s",
        std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
}

// A missing OpenFOAM is no fault: only scenes with fluid.solver: openfoam need it.
std::string look_at_openfoam() {
    const std::string fault = openfoam::missing();
    return fault.empty() ? "there"
                         : "not there, which only --fluid openfoam needs: " + fault;
}

}  // namespace

// Every check runs even if an earlier one has failed.
int doctor() {
    struct Item {
        const char* name;
        std::function<std::string()> look;
    };
    const Item items[] = {
        {"cores", look_at_cores},
        {"stack", look_at_stack},
        {"host", look_at_name},
        {"memory", [] { return look_at_space("/dev/shm", 50'000'000); }},
        {"temporary",
         [] { return look_at_space(fs::temp_directory_path(), 50'000'000); }},
        {"disk", [] { return look_at_space(fs::current_path(), 500'000'000); }},
        {"locks", look_at_locks},
        {"mpirun", look_at_mpirun},
        {"MPI", look_at_mpi},
        {"OpenFOAM", look_at_openfoam},
    };
    int faults = 0;
    for (const Item& item : items) {
        try {
            const std::string found = item.look();
            fmt::print("{:<10} good: {}\n", item.name, found);
        } catch (const std::exception& fault) {
            ++faults;
            fmt::print("{:<10} FAULT: {}\n", item.name, fault.what());
        }
        std::fflush(stdout);
    }
    if (faults == 0) return coupler::exit_done;
    fmt::print(stderr, "magfsi: this machine has {} fault(s), named above\n", faults);
    return coupler::exit_error;
}

}  // namespace magfsi::launch
