#include "coupler/output/memory.h"

#include <gtest/gtest.h>

#include <cstring>
#include <vector>

using magfsi::output::peak_resident_bytes;

TEST(Memory, the_peak_grows_by_what_is_touched_and_stays) {
    const auto before = peak_resident_bytes();
    ASSERT_GT(before, 0) << "/proc/self/status has no VmHWM";
    constexpr std::size_t size = 64u << 20;
    {
        std::vector<char> block(size);
        std::memset(block.data(), 1, size);
        volatile char sink = block[size / 2];
        static_cast<void>(sink);
    }
    const auto after = peak_resident_bytes();
    // Pages freed earlier may be used again, and the kernel counts in batches: a quarter.
    EXPECT_GE(after - before, static_cast<std::int64_t>(size - size / 4));
    EXPECT_GE(peak_resident_bytes(), after);
}
