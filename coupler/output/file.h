// SPDX-License-Identifier: GPL-2.0-or-later
// Writing of files in the run folder, with errors reported and atomic replacement, and
// numbers as text.
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>

namespace magfsi::output {

// A file cannot be written: "cannot write /run/probes.csv: No space left on device".
class FileError : public std::runtime_error {
  public:
    FileError(const std::filesystem::path& path, int system_errno);
};

// Treatment of a file that exists: emptied or appended to.
enum class Open { empty, append };

// A file that is only written to. Every failure throws FileError, also that of a late
// flush or close.
class File {
  public:
    // Creates the file, or empties it unless appended to. The folder must exist.
    explicit File(std::filesystem::path path, Open how = Open::empty);
    ~File();
    File(const File&) = delete;
    File& operator=(const File&) = delete;

    const std::filesystem::path& path() const { return path_; }

    // Unbuffered: on return the bytes are with the kernel and survive this process.
    void write(std::span<const std::byte> bytes);
    void write(std::string_view text);

    // Writes the whole record or nothing of it: what a failing disk took is cut off
    // again.
    void write_record(std::string_view record);

    // Reports the failure of a late write, which the destructor would have to swallow.
    void close();

  private:
    std::filesystem::path path_;
    int descriptor_ = -1;
    std::size_t size_bytes_ = 0;
};

// Events that a committed file survives. kill: the end of the process, enough for
// pictures and indices. power_cut: file and folder are synced, too, which takes
// milliseconds; for checkpoints.
enum class Survives { kill, power_cut };

// A file that its readers see complete or not at all: it is written as NAME.tmp beside
// NAME and then renamed (POSIX: rename within one file system is atomic).
class AtomicFile {
  public:
    // Throws FileError if the folder is missing or not writable, as all calls do on a
    // failing disk.
    explicit AtomicFile(std::filesystem::path path, Survives survives = Survives::kill);
    ~AtomicFile();  // removes NAME.tmp unless committed
    AtomicFile(const AtomicFile&) = delete;
    AtomicFile& operator=(const AtomicFile&) = delete;

    void write(std::span<const std::byte> bytes) { temporary_.write(bytes); }
    void write(std::string_view text) { temporary_.write(text); }
    void commit();

  private:
    std::filesystem::path path_;
    Survives survives_;
    File temporary_;
    bool committed_ = false;
};

// Writes a whole file atomically. Throws FileError.
void write_atomically(const std::filesystem::path& path, std::string_view text,
                      Survives survives = Survives::kill);

// Copies a file, unless both names are the same file's; makes the folder of the copy.
// Throws FileError.
void copy_atomically(const std::filesystem::path& from, const std::filesystem::path& to);

// The same for a file that another library writes: it writes and closes
// temporary_of(path), then publish(path) renames it. publish throws FileError.
std::filesystem::path temporary_of(std::filesystem::path path);
void publish(const std::filesystem::path& path, Survives survives);

// The name by which one file of the run folder refers to another, so that the folder can
// be moved: `file` relative to the folder of `index`. Both arguments are paths as this
// process would open them.
std::string relative_to(const std::filesystem::path& file,
                        const std::filesystem::path& index);

// The shortest decimal that reads back to the same double: the same bytes on every
// machine and in every locale. NaN of either sign is "nan", infinities are "inf" and
// "-inf".
std::string to_text(double value);

}  // namespace magfsi::output
