// SPDX-License-Identifier: GPL-2.0-or-later
// Inputs on which the scene reader once crashed, hung or let another error out.
#include <gtest/gtest.h>

#include "tests/fuzz/read_input.h"
#include "tests/support/checks.h"

namespace magfsi::scene {
namespace {

TEST(FuzzFindings, are_read_or_refused) {
    const test::TemporaryFolder folder;
    int found = 0;
    for (const auto& entry : std::filesystem::directory_iterator(FINDINGS)) {
        EXPECT_NO_THROW(read_input(test::read(entry.path()), folder.path()))
            << entry.path();
        ++found;
    }
    EXPECT_GT(found, 0);
}

}  // namespace
}  // namespace magfsi::scene
