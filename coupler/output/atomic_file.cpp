#include "coupler/output/atomic_file.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <utility>

namespace magfsi::output {
namespace {

void sync(const std::filesystem::path& path) {
    const int descriptor = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
    if (descriptor < 0) throw FileError(path, errno);
    const int error = ::fsync(descriptor) == 0 ? 0 : errno;
    ::close(descriptor);
    if (error != 0) throw FileError(path, error);
}

// A rename is durable only when the folder's own entry is on the disk.
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
    if (survives_ == Survives::power_cut) temporary_.sync();
    temporary_.close();
    if (std::rename(temporary_.path().c_str(), path_.c_str()) != 0)
        throw FileError(path_, errno);
    committed_ = true;
    if (survives_ == Survives::power_cut) sync_folder(path_);
}

void write_atomically(const std::filesystem::path& path, std::string_view text,
                      Survives survives) {
    AtomicFile file(path, survives);
    file.write(text);
    file.commit();
}

}  // namespace magfsi::output
