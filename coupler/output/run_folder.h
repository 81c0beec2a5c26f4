// SPDX-License-Identifier: GPL-2.0-or-later
// Who owns a run folder, and what becomes of the results that an earlier run left there.
#pragma once

#include <filesystem>
#include <stdexcept>
#include <string>
#include <vector>

namespace magfsi::output {

// Another run has the folder: "the run folder X belongs to process 12 of host a, ...".
class FolderTaken : public std::runtime_error {
  public:
    using std::runtime_error::runtime_error;
};

// Locks on three bytes of run.lock: the launcher's and the leading process's exclude
// their like, the others of a job share theirs. The kernel releases a lock when its
// process is gone, however it ended; so a folder is free when all of a job are gone. On a
// file system without locks (some network ones) nothing is locked: held() is false.
class FolderLock {
  public:
    enum class Holder { launcher, leader, member };

    // Waits up to patience_s for a lock in the way. Throws FolderTaken, FileError.
    FolderLock(const std::filesystem::path& folder, Holder holder, double patience_s);
    ~FolderLock();
    FolderLock(const FolderLock&) = delete;
    FolderLock& operator=(const FolderLock&) = delete;

    bool held() const { return held_; }

    // Whether all processes of the job are gone, after at most patience_s; the launcher
    // asks. Calls `waiting` once when that takes longer than a second.
    bool wait_for_job(double patience_s, void (*waiting)() = nullptr) const;

    // Who turns others away from here on, such as "magfsi run": this process. A leading
    // process leaves that to the launcher that holds its lock, if there is one.
    void sign(const std::string& what);
    std::string owner() const;  // who signed last

  private:
    bool take(short kind, long first, long count, double patience_s);

    std::filesystem::path path_;
    Holder holder_;
    int descriptor_ = -1;
    bool held_ = false;
};

// How long a run waits for the processes of one whose launcher was killed.
constexpr double patience_with_the_ending_s = 8;

// What an earlier run left in the folder goes to earlier-1 in it, or earlier-2 ...; or
// away, if it has no results or is to be overwritten. solver_folders: names of what
// solvers leave there. Returns where the results are now; empty if there were none.
std::filesystem::path set_aside(const std::filesystem::path& folder,
                                const std::vector<std::string>& solver_folders,
                                bool overwrite);

// Throws std::invalid_argument if one of the files that a run goes on with is a link:
// what it writes there would go elsewhere.
void refuse_links(const std::filesystem::path& folder,
                  const std::vector<std::string>& solver_folders);

}  // namespace magfsi::output
