// SPDX-License-Identifier: GPL-2.0-or-later
// Ownership of a run folder, and the handling of results that an earlier run left there.
#pragma once

#include <filesystem>
#include <stdexcept>
#include <string>
#include <vector>

namespace magfsi::output {

// Another run owns the folder: "the run folder X belongs to process 12 of host a, ...".
class FolderTaken : public std::runtime_error {
  public:
    using std::runtime_error::runtime_error;
};

// A process's lock on the run folder, on one of three bytes of run.lock. The locks of the
// launcher and of the leading process are exclusive, that of the other processes of a job
// is shared among them. The kernel releases a lock when its process is gone, however it
// ended, so that a folder is free when all processes of a job are gone. On file systems
// without locks (some network ones) nothing is locked and held() is false.
class FolderLock {
  public:
    enum class Holder { launcher, leader, member };

    // Waits up to patience_s [s] for a lock that is in the way. Throws FolderTaken after
    // that, FileError if run.lock cannot be opened.
    FolderLock(const std::filesystem::path& folder, Holder holder, double patience_s);
    ~FolderLock();
    FolderLock(const FolderLock&) = delete;
    FolderLock& operator=(const FolderLock&) = delete;

    bool held() const { return held_; }

    // Waits up to patience_s [s] until all processes of the job are gone, and returns
    // true if they are. Called by the launcher. `waiting` is called once if this takes
    // longer than a second.
    bool wait_for_job(double patience_s, void (*waiting)() = nullptr) const;

    // Writes this process into run.lock as the owner that others are told about; what:
    // its name, such as "magfsi run". A leading process leaves the entry to the launcher,
    // if one holds its lock. Throws FileError.
    void sign(const std::string& what);
    std::string owner() const;  // description of the last signer

  private:
    // Takes or releases a lock on `count` bytes from `first` on; false if the file system
    // has no locks.
    bool take(short kind, long first, long count, double patience_s);

    std::filesystem::path path_;
    Holder holder_;
    int descriptor_ = -1;
    bool held_ = false;
};

// Time [s] that a run waits for the processes of a job whose launcher was killed.
constexpr double patience_with_the_ending_s = 8;

// Moves what an earlier run left in the folder into earlier-1, earlier-2 ... in it, or
// deletes it if it has no results or is to be overwritten. Files that are not a run's
// stay. solver_folders: names of what solvers leave in the folder. Returns the new place
// of the results; empty if there were none.
std::filesystem::path set_aside(const std::filesystem::path& folder,
                                const std::vector<std::string>& solver_folders,
                                bool overwrite);

// Throws std::invalid_argument if one of the files that a run continues is a symbolic
// link, through which it would write outside the folder.
void refuse_links(const std::filesystem::path& folder,
                  const std::vector<std::string>& solver_folders);

}  // namespace magfsi::output
