// Inputs on which the scene reader once crashed, hung or let another error out.
#include <gtest/gtest.h>
#include <unistd.h>

#include <sstream>

#include "tests/fuzz/read_input.h"

namespace magfsi::scene {
namespace {

std::string bytes_of(const std::filesystem::path& file) {
    std::ifstream stream(file, std::ios::binary);
    std::ostringstream bytes;
    bytes << stream.rdbuf();
    return bytes.str();
}

TEST(FuzzFindings, are_read_or_refused) {
    const auto folder = std::filesystem::temp_directory_path() /
                        ("magfsi-findings-" + std::to_string(getpid()));
    std::filesystem::create_directory(folder);
    int found = 0;
    for (const auto& entry : std::filesystem::directory_iterator(FINDINGS)) {
        EXPECT_NO_THROW(read_input(bytes_of(entry.path()), folder)) << entry.path();
        ++found;
    }
    EXPECT_GT(found, 0);
    std::filesystem::remove_all(folder);
}

}  // namespace
}  // namespace magfsi::scene
