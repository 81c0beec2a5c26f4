// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupler/output/file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <cstdio>
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
    if (end > 0) size_bytes_ = end;
}

File::~File() {
    if (descriptor_ >= 0) ::close(descriptor_);
}

void File::write(std::span<const std::byte> bytes) {
    while (!bytes.empty()) {
        const ssize_t written = ::write(descriptor_, bytes.data(), bytes.size());
        if (written < 0 && errno == EINTR) continue;
        if (written < 0) throw FileError(path_, errno);
        size_bytes_ += written;
        bytes = bytes.subspan(written);
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
        // Fails for what cannot be truncated (a device); the first error is the one to
        // report.
        if (::ftruncate(descriptor_, end) == 0 &&
            ::lseek(descriptor_, end, SEEK_SET) == end)
            size_bytes_ = before;
        throw;
    }
}

void File::close() {
    const int descriptor = std::exchange(descriptor_, -1);
    // Network file systems report a full quota only here.
    if (descriptor >= 0 && ::close(descriptor) != 0) throw FileError(path_, errno);
}

namespace {

// Writes a file or folder through to the disk.
void sync(const std::filesystem::path& path) {
    const int descriptor = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
    if (descriptor < 0) throw FileError(path, errno);
    const int error = ::fsync(descriptor) == 0 ? 0 : errno;
    ::close(descriptor);
    if (error != 0) throw FileError(path, error);
}

// Syncs the folder of a file: a rename is durable only when the folder's entry is on the
// disk.
void sync_folder(const std::filesystem::path& file) {
    sync(file.has_parent_path() ? file.parent_path() : ".");
}

}  // namespace

std::filesystem::path temporary_of(std::filesystem::path path) {
    return path += ".tmp";
}

void publish(const std::filesystem::path& path, Survives survives) {
    const auto temporary = temporary_of(path);
    if (survives == Survives::power_cut) sync(temporary);
    if (std::rename(temporary.c_str(), path.c_str()) != 0) throw FileError(path, errno);
    if (survives == Survives::power_cut) sync_folder(path);
}

AtomicFile::AtomicFile(std::filesystem::path path, Survives survives)
    : path_(std::move(path)), survives_(survives), temporary_(temporary_of(path_)) {}

AtomicFile::~AtomicFile() {
    if (!committed_) ::unlink(temporary_.path().c_str());
}

void AtomicFile::commit() {
    temporary_.close();
    publish(path_, survives_);
    committed_ = true;
}

void write_atomically(const std::filesystem::path& path, std::string_view text,
                      Survives survives) {
    AtomicFile file(path, survives);
    file.write(text);
    file.commit();
}

void copy_atomically(const std::filesystem::path& from, const std::filesystem::path& to) {
    namespace fs = std::filesystem;
    std::error_code error;
    if (fs::equivalent(from, to, error)) return;
    error.clear();
    fs::create_directories(to.parent_path(), error);
    if (!error)
        fs::copy_file(from, temporary_of(to), fs::copy_options::overwrite_existing,
                      error);
    if (error) throw FileError(to, error.value());
    publish(to, Survives::kill);
}

std::string relative_to(const std::filesystem::path& file,
                        const std::filesystem::path& index) {
    const auto full = std::filesystem::absolute(file).lexically_normal();
    const auto folder = std::filesystem::absolute(index).lexically_normal().parent_path();
    return full.lexically_relative(folder).generic_string();
}

std::string to_text(double value) {
    if (std::isnan(value)) return "nan";
    std::array<char, 32> text{};  // the longest such decimal has 24 characters
    const auto end = std::to_chars(text.data(), text.data() + text.size(), value).ptr;
    return {text.data(), end};
}

}  // namespace magfsi::output
