// SPDX-License-Identifier: GPL-2.0-or-later
// Files of the run folder, and numbers as they stand in them.
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>

namespace magfsi::output {

// "cannot write /run/probes.csv: No space left on device".
class FileError : public std::runtime_error {
  public:
    FileError(const std::filesystem::path& path, int system_errno);
};

enum class Open { empty, append };

// A file that is only written to. Every failure, also of a late flush or close, throws.
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

    // All of the record or nothing of it: what a failing disk took is cut off again.
    void write_record(std::string_view record);

    void close();  // reports what the destructor would have to swallow

  private:
    std::filesystem::path path_;
    int descriptor_ = -1;
    std::size_t size_bytes_ = 0;
};

// kill: what was committed survives the end of the process, the default for pictures and
// indices. power_cut: file and folder are synced too (milliseconds), for checkpoints.
enum class Survives { kill, power_cut };

// A file that its readers see whole or not at all: written as NAME.tmp beside NAME, then
// renamed (POSIX: rename within one file system is atomic).
class AtomicFile {
  public:
    // Throws FileError where the folder is missing or may not be written to.
    explicit AtomicFile(std::filesystem::path path, Survives survives = Survives::kill);
    ~AtomicFile();  // removes NAME.tmp unless committed; NAME stays as it was
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

void write_atomically(const std::filesystem::path& path, std::string_view text,
                      Survives survives = Survives::kill);

// For a file that another library writes: let it write and close temporary_of(path), then
// publish(path).
std::filesystem::path temporary_of(std::filesystem::path path);
void publish(const std::filesystem::path& path, Survives survives);

// How one file of the run folder names another, so that the folder can be moved: `file`
// as seen from the folder of `index`; both as this process would open them.
std::string relative_to(const std::filesystem::path& file,
                        const std::filesystem::path& index);

// The shortest decimal that reads back to the same double, the same bytes on every
// machine and in every locale; "nan" whatever its sign, "inf", "-inf".
std::string to_text(double value);

}  // namespace magfsi::output
