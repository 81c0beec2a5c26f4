// A file that is only written to. Every failure, also of a late flush or close, throws.
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <stdexcept>
#include <string_view>

namespace magfsi::output {

// "cannot write /run/probes.csv: No space left on device".
class FileError : public std::runtime_error {
  public:
    FileError(const std::filesystem::path& path, int system_errno);
};

enum class Open { empty, append };

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

    void sync();   // on return the bytes survive a power cut
    void close();  // reports what the destructor would have to swallow

  private:
    std::filesystem::path path_;
    int descriptor_ = -1;
    std::size_t size_bytes_ = 0;
};

}  // namespace magfsi::output
