// SPDX-License-Identifier: GPL-2.0-or-later
// Choice of mpirun and of its options, by what the environment tells of the machine.
#include "adapters/app/mpirun.h"

#include <fmt/format.h>
#include <pwd.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <numeric>
#include <optional>
#include <regex>
#include <stdexcept>

#include "adapters/run_scene.h"

namespace magfsi::launch {

namespace {

// PATH for environments that have none.
constexpr const char* default_path = "/usr/local/bin:/usr/bin:/bin";

// First line of the output of "NAME --version"; nullopt if the shell does not find the
// program.
std::optional<std::string> version_line(const std::string& name) {
    const std::string command =
        fmt::format("command -v {0} >/dev/null && timeout 5 {0} --version 2>&1", name);
    const std::unique_ptr<FILE, int (*)(FILE*)> pipe(popen(command.c_str(), "r"),
                                                     &pclose);
    char line[256] = "";
    if (!pipe || !std::fgets(line, sizeof line, pipe.get())) return std::nullopt;
    std::string text = line;
    if (text.ends_with('\n')) text.pop_back();
    return text;
}

// True for MPICH and the libraries derived from it.
bool is_of_another_mpi(const std::string& version) {
    for (const char* name : {"HYDRA", "MPICH", "MVAPICH", "Intel"})
        if (version.find(name) != std::string::npos) return true;
    return false;
}

// Major version from text such as "mpirun (Open MPI) 4.1.4"; 0 if it is not there.
int version_number(const std::string& version) {
    std::smatch found;
    static const std::regex pattern(R"(\(Open MPI\) (\d+))");
    return std::regex_search(version, found, pattern) ? std::stoi(found[1]) : 0;
}

// An mpirun that is missing or tells no version is returned as well: the start of the job
// then shows the fault.
Mpirun look_for_mpirun() {
    setenv("PATH", default_path, 0);
    std::string passed_over;
    for (const char* name : {"mpirun", "mpirun.openmpi"}) {
        const auto version = version_line(name);
        if (!version || !is_of_another_mpi(*version)) {
            // mpirun.openmpi is tried only where mpirun belongs to another MPI.
            if (!version && !passed_over.empty()) continue;
            return {name, version_number(version.value_or("")), passed_over};
        }
        passed_over = fmt::format("{} ({})", name, *version);
    }
    throw std::runtime_error(fmt::format(
        "{} belongs to another MPI than these programs, which are built with Open MPI; "
        "install Open MPI's (Debian: apt-get install openmpi-bin) or put the folder of "
        "its mpirun first on PATH",
        passed_over));
}

// Number of processes of the whole job.
int all_ranks(const std::vector<Program>& programs) {
    return std::accumulate(programs.begin(), programs.end(), 0,
                           [](int sum, const Program& p) { return sum + p.ranks; });
}

}  // namespace

// Variables of Slurm, PBS, LSF, Grid Engine, and Open MPI's host files.
bool has_more_machines() {
    return std::ranges::any_of(
        std::to_array({"SLURM_JOB_ID", "PBS_JOBID", "LSB_JOBID", "JOB_ID",
                       "OMPI_MCA_orte_default_hostfile", "OMPI_MCA_hostfile",
                       "PRTE_MCA_prte_default_hostfile"}),
        [](const char* name) { return std::getenv(name) != nullptr; });
}

const Mpirun& find_mpirun() {
    static const Mpirun found = look_for_mpirun();
    return found;
}

std::vector<std::string> mpirun_command(const std::vector<Program>& programs) {
    std::vector<std::string> words{find_mpirun().program};
    if (geteuid() == 0) words.emplace_back("--allow-run-as-root");
    const bool crowded = all_ranks(programs) > available_cores();
    // Open MPI binds the ranks of every job to cores counted from the first one, so that
    // jobs side by side would share cores while others idle. Without binding the system
    // distributes them.
    if (crowded || (!std::getenv("OMPI_MCA_hwloc_base_binding_policy") &&
                    !std::getenv("PRTE_MCA_hwloc_default_binding_policy"))) {
        words.emplace_back("--bind-to");
        words.emplace_back("none");
    }
    // An allocation of a batch system may count fewer slots than there are cores.
    const bool allocated = std::getenv("SLURM_JOB_ID") != nullptr;
    if (crowded || allocated) {
        words.emplace_back("--map-by");
        words.emplace_back(":OVERSUBSCRIBE");
        // A waiting rank must give its core to the partner that it waits for.
        for (const char* word : {"--mca", "mpi_yield_when_idle", crowded ? "1" : "0"})
            words.emplace_back(word);
    }
    for (const Program& p : programs) {
        if (&p != &programs.front()) words.emplace_back(":");
        words.emplace_back("-n");
        words.push_back(std::to_string(p.ranks));
        words.insert(words.end(), p.command.begin(), p.command.end());
    }
    return words;
}

void set_mpirun_environment() {
    setenv("PATH", default_path, 0);  // Open MPI needs one
    if (!std::getenv("HOME")) {       // and so does Open MPI 5
        const passwd* const user = getpwuid(geteuid());
        setenv("HOME", user ? user->pw_dir : "/", 0);
    }
    // Debian's PMIx 5 crashes on jobs of several programs in the plug-in that writes
    // variables about them (open-mpi/ompi#13303). Nothing in magfsi reads those
    // variables.
    if (find_mpirun().version >= 5) setenv("PMIX_MCA_pmdl", "^ompi", 0);
    // ob1 skips the search for drivers of fast networks, which takes half of MPI's
    // start-up time and is of no use on a single machine.
    if (!has_more_machines()) setenv("OMPI_MCA_pml", "ob1", 0);
    // OpenBLAS falls back to kernels without AVX on processors newer than itself.
    if (__builtin_cpu_supports("avx2")) setenv("OPENBLAS_CORETYPE", "Haswell", 0);
}

}  // namespace magfsi::launch
