// SPDX-License-Identifier: GPL-2.0-or-later
// The bell that wakes a process for its partner's message.
#include "coupler/participants/bell.h"

#include <gtest/gtest.h>

namespace magfsi::coupler {
namespace {

using std::chrono::milliseconds;

TEST(Bell, what_has_rung_before_the_wait_is_heard_once) {
    const Bell bell(this_process());
    EXPECT_FALSE(bell.wait(milliseconds(1)));
    // More than the system keeps for a socket.
    for (int stroke = 0; stroke < 1000; ++stroke)
        ASSERT_TRUE(bell.ring(this_process())) << stroke;
    EXPECT_TRUE(bell.wait(milliseconds(1000)));
    EXPECT_FALSE(bell.wait(milliseconds(1)));
}

TEST(Bell, who_is_not_there_does_not_hear_it) {
    ProcessId other = this_process();
    ++other.started;
    const Bell bell(this_process());
    EXPECT_FALSE(bell.ring(other));
    {
        const Bell its(other);
        EXPECT_TRUE(bell.ring(other));
        EXPECT_TRUE(its.wait(milliseconds(1000)));
        EXPECT_FALSE(bell.wait(milliseconds(1)));
    }
    EXPECT_FALSE(bell.ring(other));
}

// A second one of the same name gets no socket.
TEST(Bell, without_a_socket_nobody_hears) {
    const Bell first(this_process()), second(this_process());
    EXPECT_FALSE(second.ring(this_process()));
    EXPECT_TRUE(first.ring(this_process()));
}

}  // namespace
}  // namespace magfsi::coupler
