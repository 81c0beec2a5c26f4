// SPDX-License-Identifier: GPL-2.0-or-later
// libFuzzer's targets on the readers of files: tests/fuzz/run.sh. MAGFSI_FUZZ_READER: the
// reader's name. Either a file is read, or it is refused with std::invalid_argument or,
// of a mesh, std::runtime_error; whatever else happens is a finding.
#include <unistd.h>

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <stdexcept>

#include "tests/fuzz/readers.h"

namespace {

std::filesystem::path file() {
    static const std::filesystem::path made =
        std::filesystem::temp_directory_path() /
        ("magfsi-fuzz-" + std::to_string(getpid()) + "." MAGFSI_FUZZ_ENDING);
    return made;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    std::ofstream(file(), std::ios::binary)
        .write(reinterpret_cast<const char*>(data), static_cast<std::streamsize>(size));
    try {
        magfsi::fuzz::MAGFSI_FUZZ_READER(file());
    } catch (const std::invalid_argument&) {
    } catch (const std::runtime_error&) {
    }
    return 0;
}
