#include "coupler/output/file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <system_error>
#include <utility>

namespace magfsi::output {

FileError::FileError(const std::filesystem::path& path, int system_errno)
    : std::runtime_error(fmt::format("cannot write {}: {}", path.string(),
                                     std::generic_category().message(system_errno))) {}

File::File(std::filesystem::path path, Open how) : path_(std::move(path)) {
    const int start = how == Open::append ? 0 : O_TRUNC;
    descriptor_ = ::open(path_.c_str(), O_WRONLY | O_CREAT | start | O_CLOEXEC, 0666);
    if (descriptor_ < 0) throw FileError(path_, errno);
    const off_t end = how == Open::append ? ::lseek(descriptor_, 0, SEEK_END) : 0;
    if (end > 0) size_bytes_ = static_cast<std::size_t>(end);
}

File::~File() {
    if (descriptor_ >= 0) ::close(descriptor_);
}

void File::write(std::span<const std::byte> bytes) {
    while (!bytes.empty()) {
        const ssize_t written = ::write(descriptor_, bytes.data(), bytes.size());
        if (written < 0 && errno == EINTR) continue;
        if (written < 0) throw FileError(path_, errno);
        size_bytes_ += static_cast<std::size_t>(written);
        bytes = bytes.subspan(static_cast<std::size_t>(written));
    }
}

void File::write(std::string_view text) {
    write(std::as_bytes(std::span(text.data(), text.size())));
}

void File::write_record(std::string_view record) {
    const std::size_t before = size_bytes_;
    try {
        write(record);
    } catch (const FileError&) {
        const auto end = static_cast<off_t>(before);
        // Fails on what cannot be cut (a device); the first error is the one to report.
        if (::ftruncate(descriptor_, end) == 0 &&
            ::lseek(descriptor_, end, SEEK_SET) == end)
            size_bytes_ = before;
        throw;
    }
}

void File::sync() {
    if (::fsync(descriptor_) != 0) throw FileError(path_, errno);
}

void File::close() {
    const int descriptor = std::exchange(descriptor_, -1);
    // Network file systems report a full quota only here.
    if (descriptor >= 0 && ::close(descriptor) != 0) throw FileError(path_, errno);
}

}  // namespace magfsi::output
