// SPDX-License-Identifier: GPL-2.0-or-later
// Notifications that wake a process for its partner's message.
#include "coupler/participants/notifier.h"

#include <gtest/gtest.h>

namespace magfsi::coupler {
namespace {

using std::chrono::milliseconds;

TEST(Notifier, what_came_before_the_wait_ends_one_wait) {
    const Notifier mine(this_process());
    EXPECT_FALSE(mine.wait(milliseconds(1)));
    // More than the system keeps for a socket.
    for (int n = 0; n < 1000; ++n) ASSERT_TRUE(mine.notify(this_process())) << n;
    EXPECT_TRUE(mine.wait(milliseconds(1000)));
    EXPECT_FALSE(mine.wait(milliseconds(1)));
}

TEST(Notifier, who_is_not_there_is_not_notified) {
    ProcessId other = this_process();
    ++other.started;
    const Notifier mine(this_process());
    EXPECT_FALSE(mine.notify(other));
    {
        const Notifier its(other);
        EXPECT_TRUE(mine.notify(other));
        EXPECT_TRUE(its.wait(milliseconds(1000)));
        EXPECT_FALSE(mine.wait(milliseconds(1)));
    }
    EXPECT_FALSE(mine.notify(other));
}

// A second one of the same name gets no socket.
TEST(Notifier, without_a_socket_there_are_none) {
    const Notifier first(this_process()), second(this_process());
    EXPECT_FALSE(second.notify(this_process()));
    EXPECT_TRUE(first.notify(this_process()));
}

}  // namespace
}  // namespace magfsi::coupler
