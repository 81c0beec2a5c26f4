// SPDX-License-Identifier: GPL-2.0-or-later
// libFuzzer's target on the scene reader: tests/fuzz/run.sh.
#include <unistd.h>

#include <cstdint>

#include "tests/fuzz/read_input.h"

namespace {

const std::filesystem::path& folder() {
    static const std::filesystem::path made = [] {
        auto path = std::filesystem::temp_directory_path() /
                    ("magfsi-fuzz-" + std::to_string(getpid()));
        std::filesystem::create_directory(path);
        return path;
    }();
    return made;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    magfsi::scene::read_input({reinterpret_cast<const char*>(data), size}, folder());
    return 0;
}
