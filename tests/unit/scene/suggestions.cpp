// Near names are found; far ones are not forced upon anyone.
#include <gtest/gtest.h>

#include "adapters/scene/suggestion.h"

namespace magfsi::scene {
namespace {

const std::vector<std::string> keys = {"spacing", "density", "viscosity",
                                       "box",     "m",       "mT"};

TEST(Suggestion, finds_a_letter_missing_added_changed_or_swapped) {
    EXPECT_EQ(nearest("spacin", keys), "spacing");
    EXPECT_EQ(nearest("denssity", keys), "density");
    EXPECT_EQ(nearest("viscozity", keys), "viscosity");
    EXPECT_EQ(nearest("bxo", keys), "box");
}

TEST(Suggestion, prefers_a_difference_of_case) {
    EXPECT_EQ(nearest("MT", keys), "mT");
    EXPECT_EQ(nearest("Density", keys), "density");
}

TEST(Suggestion, is_silent_when_nothing_is_near) {
    EXPECT_EQ(nearest("turbulence", keys), "");
    EXPECT_EQ(nearest("", keys), "");
    EXPECT_EQ(nearest("q", keys), "");
    EXPECT_EQ(did_you_mean("turbulence", keys), "");
    EXPECT_EQ(did_you_mean("spacin", keys), "did you mean \"spacing\"?");
}

}  // namespace
}  // namespace magfsi::scene
