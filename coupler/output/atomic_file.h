// A file that its readers see whole or not at all: written as NAME.tmp beside NAME, then
// renamed (POSIX: rename within one file system is atomic).
#pragma once

#include "coupler/output/file.h"

namespace magfsi::output {

// kill: what was committed survives the end of the process, the default for pictures and
// indices. power_cut: file and folder are synced too (milliseconds), for checkpoints.
enum class Survives { kill, power_cut };

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

}  // namespace magfsi::output
