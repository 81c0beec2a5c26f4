// Scene files are UTF-8; what is not is refused with its place.
#include "adapters/scene/utf8.h"

#include <gtest/gtest.h>

namespace magfsi::scene {
namespace {

TEST(Utf8, takes_every_length) {
    for (const char* text :
         {"", "plain", "\x7F", "\xC2\x80", "\xE2\x82\xAC", "\xED\x9F\xBF", "\xEE\x80\x80",
          "\xF0\x9F\xA4\x96", "\xF4\x8F\xBF\xBF"})
        EXPECT_EQ(first_fault_in_utf8(text), std::string_view::npos) << text;
}

TEST(Utf8, finds_the_first_fault) {
    // A lone continuation, long forms, a surrogate, beyond the last character, cut short.
    for (const char* fault :
         {"\x80", "\xC0\x80", "\xC1\xBF", "\xE0\x80\x80", "\xED\xA0\x80",
          "\xF0\x80\x80\x80", "\xF4\x90\x80\x80", "\xF5", "\xFF", "\xE2\x82", "\xC2"})
        EXPECT_EQ(first_fault_in_utf8("\xC2\xB5m " + std::string(fault)), 4u);
}

}  // namespace
}  // namespace magfsi::scene
