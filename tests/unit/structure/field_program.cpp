#include "structure/lammps/field_program.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace magfsi::structure {
namespace {

constexpr double pi = std::numbers::pi;
constexpr double roundoff = 1e-17;  // of fields of 0.02 T

FieldProgram strokes() {
    return {
        {0, 2},
        FieldTable{{0, 0.02, 0.03, 0.04}, {-0.017, 0.017, -0.017, -0.017}, {0.3}, true}};
}

void expect_polar(const FieldProgram& program, double t, double magnitude, double angle) {
    const Vec3 b = field_at(program, t);
    EXPECT_NEAR(b[program.plane[0]], magnitude * std::cos(angle), roundoff) << t;
    EXPECT_NEAR(b[program.plane[1]], magnitude * std::sin(angle), roundoff) << t;
    EXPECT_EQ(b[3 - program.plane[0] - program.plane[1]], 0);
}

TEST(FieldProgram, ConstantKeepsItsDirectionInItsPlane) {
    expect_polar({{1, 0}, ConstantField{0.02, 2.0}}, 5, 0.02, 2.0);
}

TEST(FieldProgram, TableIsLinearBetweenItsRowsAndRepeats) {
    const FieldProgram program = strokes();
    expect_polar(program, 0, -0.017, 0.3);
    expect_polar(program, 0.01, 0, 0.3);
    expect_polar(program, 0.0275, -0.0085, 0.3);
    expect_polar(program, 0.035, -0.017, 0.3);
    // Ten periods later; 0.41 is rounded by 1e-17 s, the slope is 1.7 T/s.
    const Vec3 later = field_at(program, 0.415);
    EXPECT_NEAR(later[0], 0.0085 * std::cos(0.3), 1e-15);
}

TEST(FieldProgram, TableHoldsItsEndsAndJumps) {
    const FieldProgram program{
        {0, 2},
        FieldTable{{1, 2, 2, 3}, {0.01, 0.02, 0.005, 0.005}, {0, 1, 1, 2}, false}};
    expect_polar(program, -1, 0.01, 0);
    expect_polar(program, 1.5, 0.015, 0.5);
    expect_polar(program, 2, 0.005, 1);
    expect_polar(program, 2.5, 0.005, 1.5);
    expect_polar(program, 9, 0.005, 2);
}

TEST(FieldProgram, RotationTurnsFromTheFirstAxisToTheSecond) {
    const FieldProgram program{{0, 1}, RotatingField{0.01, pi / 2, 4}};
    expect_polar(program, 0.0625, 0.01, pi / 2 + pi / 2);
}

TEST(FieldProgram, ArgumentsReadBackExactly) {
    const FieldProgram rotating{{2, 1}, RotatingField{0.01 / 3, pi / 7, -25}};
    const FieldProgram constant{{0, 2}, ConstantField{-0.02, 1.0 / 3}};
    for (const FieldProgram& program : {strokes(), rotating, constant}) {
        std::vector<std::string> words;
        std::istringstream text(field_arguments(program));
        for (std::string word; text >> word;) words.push_back(word);
        const FieldProgram back = parse_field_arguments(words);
        for (double t : {0.0, 0.0123, 0.0377, 1.1111}) {
            EXPECT_EQ(field_at(back, t), field_at(program, t));
        }
    }
}

TEST(FieldProgram, RefusesWhatIsNoProgram) {
    using Words = std::vector<std::string>;
    for (const Words& words :
         {Words{}, Words{"xz"}, Words{"xx", "constant", "1", "2"},
          Words{"xw", "constant", "1", "2"}, Words{"xz", "constant", "1"},
          Words{"xz", "constant", "1", "2mT"}, Words{"xz", "table", "0", "1"},
          Words{"xz", "table", "1", "0", "0", "0", "0", "0"},
          Words{"xz", "repeat", "1", "0", "0"}, Words{"xz", "spiral", "1", "0", "0"}}) {
        EXPECT_THROW(parse_field_arguments(words), std::invalid_argument);
    }
    EXPECT_THROW(field_arguments({{0, 2}, FieldTable{{0, 1}, {1, 1}, {0, 1, 2}, false}}),
                 std::invalid_argument);
}

}  // namespace
}  // namespace magfsi::structure
