// A message of another step, or of other markers, is refused.
#include <gtest/gtest.h>

#include "coupler/exchange/message.h"
#include "coupler/participants/errors.h"

namespace magfsi::coupler {
namespace {

TEST(MessageHeader, the_same_step_and_markers_pass) {
    std::vector<double> message(velocity_message_size(3));
    for (const std::int64_t step : {-1LL, 0LL, 8LL, 4'000'000'000LL}) {
        write_header(message, step, 3);
        EXPECT_NO_THROW(check_header(message, step, 3, "fluid rank 0"));
    }
}

TEST(MessageHeader, another_step_is_refused_with_both_numbers) {
    std::vector<double> message(marker_message_size(2));
    write_header(message, 41, 2);
    EXPECT_THROW(check_header(message, 40, 2, "structure rank 1"), PartnerLost);
    EXPECT_THROW(check_header(message, 41, 3, "structure rank 1"), PartnerLost);
    EXPECT_THROW(check_header(message, {40, 1}, 3, "structure rank 1"), PartnerLost);
    try {
        check_header(message, 42, 2, "structure rank 1");
        ADD_FAILURE() << "no exception";
    } catch (const PartnerLost& e) {
        const std::string text = e.what();
        EXPECT_NE(text.find("structure rank 1"), std::string::npos) << text;
        EXPECT_NE(text.find("step 41 with 2 markers"), std::string::npos) << text;
        EXPECT_NE(text.find("expected step 42"), std::string::npos) << text;
    }
}

}  // namespace
}  // namespace magfsi::coupler
