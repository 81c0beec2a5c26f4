// SPDX-License-Identifier: GPL-2.0-or-later
// Folders for the files that a program needs while it runs.
#pragma once

#include <fmt/format.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <stdexcept>
#include <string>

namespace magfsi::files {

// Makes a folder in `above`; its name is `name` and six letters that no other has. Throws
// std::runtime_error with the system's reason.
inline std::filesystem::path make_folder(const std::filesystem::path& above,
                                         const std::string& name) {
    std::string made = (above / (name + "-XXXXXX")).string();  // mkdtemp's placeholder
    if (mkdtemp(made.data()) == nullptr)
        throw std::runtime_error(
            fmt::format("no folder can be made in {}: {}; make it writable, or, if it is "
                        "that of temporary files, set TMPDIR to another",
                        above.string(), std::strerror(errno)));
    return made;
}

// The system's folder of temporary files. Throws std::runtime_error if TMPDIR or its like
// names no folder.
inline std::filesystem::path temporary_files() {
    std::error_code fault;
    const auto found = std::filesystem::temp_directory_path(fault);
    if (!fault) return found;
    const char* const chosen = std::getenv("TMPDIR");
    throw std::runtime_error(fmt::format(
        "the folder of temporary files{} is not to be had: {}; set TMPDIR to a "
        "folder that can be written",
        chosen ? fmt::format(" ({})", chosen) : "", fault.message()));
}

// A folder that is removed with its contents at the end of its scope.
class TemporaryFolder {
  public:
    explicit TemporaryFolder(const std::string& name,
                             const std::filesystem::path& above = temporary_files())
        : path_(make_folder(above, name)) {}
    ~TemporaryFolder() {
        std::error_code ignored;
        std::filesystem::remove_all(path_, ignored);
    }
    TemporaryFolder(const TemporaryFolder&) = delete;
    TemporaryFolder& operator=(const TemporaryFolder&) = delete;

    const std::filesystem::path& path() const { return path_; }
    std::filesystem::path operator/(const std::filesystem::path& file) const {
        return path_ / file;
    }

  private:
    std::filesystem::path path_;
};

}  // namespace magfsi::files
