// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupler/output/run_folder.h"

#include <fcntl.h>
#include <fmt/chrono.h>
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <ctime>
#include <fstream>
#include <stdexcept>
#include <thread>
#include <utility>

#include "coupler/output/file.h"

namespace magfsi::output {

namespace fs = std::filesystem;
using std::chrono::steady_clock;

namespace {

constexpr long launcher_byte = 0, leader_byte = 1, member_byte = 2;
constexpr auto between_tries = std::chrono::milliseconds(20);

// A request to the kernel for a lock on a range of bytes.
struct flock request(short kind, long first, long count) {
    struct flock lock {};
    lock.l_type = kind;
    lock.l_whence = SEEK_SET;
    lock.l_start = first;
    lock.l_len = count;
    return lock;
}

double seconds_since(steady_clock::time_point start) {
    return std::chrono::duration<double>(steady_clock::now() - start).count();
}

std::string host_name() {
    std::array<char, 256> name{};
    return ::gethostname(name.data(), name.size() - 1) == 0 ? name.data() : "unknown";
}

// Age of a time of the day's clock, in words.
std::string age_of(long since) {
    const long seconds = std::max(0L, static_cast<long>(std::time(nullptr)) - since);
    if (seconds < 120) return fmt::format("{} s", seconds);
    if (seconds < 7200) return fmt::format("{} min", seconds / 60);
    return fmt::format("{} h", seconds / 3600);
}

}  // namespace

// Open file description locks belong to the descriptor: unlike POSIX locks they survive
// the closing of another descriptor of the same file, which a library might do.
bool FolderLock::take(short kind, long first, long count, double patience_s) {
    const auto start = steady_clock::now();
    while (true) {
        struct flock lock = request(kind, first, count);
        if (::fcntl(descriptor_, F_OFD_SETLK, &lock) == 0) return true;
        if (errno == EINTR) continue;
        // The file system has no locks.
        if (errno != EAGAIN && errno != EACCES) return false;
        if (seconds_since(start) >= patience_s)
            throw FolderTaken(fmt::format(
                "the run folder {} belongs to a run that goes on: {}; wait for its end, "
                "or take another folder with --out",
                path_.parent_path().string(), owner()));
        std::this_thread::sleep_for(between_tries);
    }
}

FolderLock::FolderLock(const fs::path& folder, Holder holder, double patience_s)
    : path_(folder / "run.lock"), holder_(holder) {
    descriptor_ = ::open(path_.c_str(), O_RDWR | O_CREAT | O_CLOEXEC | O_NOFOLLOW, 0666);
    if (descriptor_ < 0) throw FileError(path_, errno);
    try {
        if (holder == Holder::launcher)
            held_ = take(F_WRLCK, launcher_byte, 1, patience_s);
        else if (holder == Holder::member)
            held_ = take(F_RDLCK, member_byte, 1, patience_s);
        else
            // The leader waits for members of another job, too, then lets its own members
            // in.
            held_ = take(F_WRLCK, leader_byte, 2, patience_s) &&
                    take(F_UNLCK, member_byte, 1, 0);
    } catch (...) {
        ::close(descriptor_);
        throw;
    }
}

void FolderLock::sign(const std::string& what) {
    struct flock launcher = request(F_WRLCK, launcher_byte, 1);
    if (holder_ == Holder::leader && ::fcntl(descriptor_, F_OFD_GETLK, &launcher) == 0 &&
        launcher.l_type != F_UNLCK)
        return;
    const std::string text =
        fmt::format("{} {} {}\n{}\n", ::getpid(), std::time(nullptr), host_name(), what);
    if (::ftruncate(descriptor_, 0) != 0 ||
        ::pwrite(descriptor_, text.data(), text.size(), 0) !=
            static_cast<ssize_t>(text.size()))
        throw FileError(path_, errno);
}

FolderLock::~FolderLock() {
    ::close(descriptor_);
}

bool FolderLock::wait_for_job(double patience_s, void (*waiting)()) const {
    const auto start = steady_clock::now();
    while (held_) {
        struct flock lock = request(F_WRLCK, leader_byte, 2);
        if (::fcntl(descriptor_, F_OFD_GETLK, &lock) != 0 || lock.l_type == F_UNLCK)
            return true;
        if (seconds_since(start) >= patience_s) return false;
        if (waiting && seconds_since(start) >= 1) std::exchange(waiting, nullptr)();
        std::this_thread::sleep_for(between_tries);
    }
    return true;
}

std::string FolderLock::owner() const {
    std::ifstream in(path_);
    long pid = 0, since = 0;
    std::string host, what;
    if (!(in >> pid >> since >> host) || !std::getline(in >> std::ws, what))
        return "process unknown";
    return fmt::format("{}, process {} on {}, begun {} ago", what, pid, host,
                       age_of(since));
}

namespace {

// Files whose presence makes a folder hold results, and other files of a run.
constexpr const char* results[] = {"summary.json", "probes.csv", "structure.pvd",
                                   "fluid.pvd"};
constexpr const char* other_files[] = {
    "fields",      "run.log",    "run.json",    "scene.yaml", "scene_as_given.yaml",
    "scene_files", "scene.json", "report.html", "trace.json", "lammps.in",
    "lammps.log",  "bodies.data"};

bool is_checkpoint(const std::string& name) {
    return name.starts_with("checkpoint_") && name.ends_with(".h5");
}

bool is_trace(const std::string& name) {
    return name.starts_with("trace_") && name.ends_with(".json");
}

bool is_result(const std::string& name) {
    return std::ranges::find(results, name) != std::end(results) || is_checkpoint(name);
}

// True for files of a run, complete or unfinished; others, such as figures and notes of
// the user, are left alone.
bool is_ours(const std::string& name, const std::vector<std::string>& solver_folders) {
    constexpr std::string_view unfinished = ".tmp";
    if (name.ends_with(unfinished))
        return is_ours(name.substr(0, name.size() - unfinished.size()), solver_folders);
    return is_result(name) || is_trace(name) || name.ends_with(".lattice") ||
           std::ranges::find(other_files, name) != std::end(other_files) ||
           std::ranges::find(solver_folders, name) != solver_folders.end();
}

fs::path next_place(const fs::path& folder) {
    for (int n = 1;; ++n) {
        fs::path place = folder / fmt::format("earlier-{}", n);
        if (!fs::exists(fs::symlink_status(place))) return place;
    }
}

}  // namespace

fs::path set_aside(const fs::path& folder, const std::vector<std::string>& solver_folders,
                   bool overwrite) {
    std::vector<fs::path> left;
    bool has_results = false;
    for (const auto& entry : fs::directory_iterator(folder)) {
        const std::string name = entry.path().filename().string();
        if (!is_ours(name, solver_folders)) continue;
        left.push_back(entry.path());
        has_results = has_results || is_result(name);
    }
    if (overwrite || !has_results) {
        for (const fs::path& path : left) fs::remove_all(path);
        return {};
    }
    fs::path place = next_place(folder);
    fs::create_directory(place);
    // Results are moved last: a kill in between leaves a folder that the next start sets
    // aside.
    std::stable_partition(left.begin(), left.end(), [](const fs::path& path) {
        return !is_result(path.filename().string());
    });
    for (const fs::path& path : left) fs::rename(path, place / path.filename());
    return place;
}

void refuse_links(const fs::path& folder,
                  const std::vector<std::string>& solver_folders) {
    const auto check = [](const fs::directory_entry& entry) {
        if (entry.is_symlink())
            throw std::invalid_argument(fmt::format(
                "--restart: {} is a link; a run goes on with files of its own: "
                "put what it leads to in its place",
                entry.path().string()));
    };
    for (const auto& entry : fs::directory_iterator(folder)) {
        const std::string name = entry.path().filename().string();
        if (!is_ours(name, solver_folders) || is_checkpoint(name)) continue;
        check(entry);
        if (!entry.is_directory()) continue;
        for (const auto& inner : fs::recursive_directory_iterator(entry)) check(inner);
    }
}

}  // namespace magfsi::output
