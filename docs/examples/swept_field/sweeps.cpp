// SPDX-License-Identifier: GPL-2.0-or-later
// The swept field's law, and that its words read back: fix magttice/field understands it.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <sstream>

#include "structure/lammps/field_program.h"

namespace magfsi::structure {
namespace {

const FieldProgram sweep{{0, 2}, SweptField{0.01, 0.3, 2, 8}};

TEST(SweptField, TurnsFasterAndFaster) {
    // In half a second 2 * 0.5 + 8 * 0.125 = 2 turns; rounding of an angle of 13.
    const Vec3 b = field_at(sweep, 0.5);
    EXPECT_NEAR(b[0], 0.01 * std::cos(0.3), 1e-16);
    EXPECT_NEAR(b[2], 0.01 * std::sin(0.3), 1e-16);
}

TEST(SweptField, ReadsBackFromItsWords) {
    EXPECT_EQ(field_arguments(sweep), "xz swept 0.01 0.29999999999999999 2 8");
    std::istringstream text(field_arguments(sweep));
    std::vector<std::string> words;
    for (std::string word; text >> word;) words.push_back(word);
    EXPECT_EQ(field_at(parse_field_arguments(words), 0.7), field_at(sweep, 0.7));
}

}  // namespace
}  // namespace magfsi::structure
