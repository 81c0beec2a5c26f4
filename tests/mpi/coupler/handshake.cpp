// Both sides agree on what they run, or both say what differs; texts of any length pass.
#include "coupler/participants/world.h"

#include <gtest/gtest.h>

#include "coupler/participants/errors.h"
#include "tests/mpi/coupler/split.h"

namespace magfsi::coupler {
namespace {

using namespace testing;

Agreement usual() {
    return {1, 0x0123456789abcdef, 1000, 20'000'000};
}

// What each rank is told when the fluid's side brings another agreement.
std::string told(const World& world, const Agreement& of_the_fluid) {
    try {
        shake_hands(world, world.self() == Role::fluid ? of_the_fluid : usual(),
                    timeout_s);
    } catch (const PartnerLost& e) {
        return e.what();
    }
    return "agreed";
}

TEST(Handshake, the_same_scene_on_both_sides) {
    for (const int structure_ranks : splits()) {
        const World world(role_in(structure_ranks), true);
        EXPECT_EQ(told(world, usual()), "agreed");
    }
}

TEST(Handshake, another_scene_is_told_to_every_rank_with_both_hashes) {
    for (const int structure_ranks : splits()) {
        const World world(role_in(structure_ranks), true);
        Agreement other = usual();
        other.scene_hash = 0xfedcba9876543210;
        const std::string why = told(world, other);
        EXPECT_NE(why.find("scene"), std::string::npos) << why;
        EXPECT_NE(why.find("0123456789abcdef"), std::string::npos) << why;
        EXPECT_NE(why.find("fedcba9876543210"), std::string::npos) << why;
    }
}

TEST(Handshake, names_the_item_that_differs) {
    const World world(role_in(1), true);
    Agreement other = usual();
    other.steps = 1001;
    EXPECT_NE(told(world, other).find("number of coupled steps"), std::string::npos);
    other = usual();
    other.step_ps += 1;
    EXPECT_NE(told(world, other).find("20000001"), std::string::npos);
    other = usual();
    other.protocol = 2;
    other.scene_hash =
        0;  // a build of another protocol may hash otherwise: version first
    EXPECT_NE(told(world, other).find("protocol version"), std::string::npos);
}

TEST(Handshake, texts_of_any_length_reach_every_rank) {
    // Longer than what MPI sends eagerly; empty on either side and on both.
    const std::string texts[] = {"", "x", std::string(300'000, 'y') + "end"};
    for (const int structure_ranks : splits()) {
        const World world(role_in(structure_ranks), true);
        for (const std::string& from_structure : texts) {
            for (const std::string& from_fluid : texts) {
                const bool structure = world.self() == Role::structure;
                const std::string got = swap_text(
                    world, structure ? from_structure : from_fluid, timeout_s, "text");
                EXPECT_EQ(got, structure ? from_fluid : from_structure);
            }
        }
    }
}

// Only the roots' texts count.
TEST(Handshake, the_text_of_the_root_is_sent) {
    const World world(role_in(1), true);
    const std::string mine = to_string(world.self()) + std::to_string(world.rank());
    EXPECT_EQ(swap_text(world, mine, timeout_s, "text"), to_string(world.other()) + "0");
}

}  // namespace
}  // namespace magfsi::coupler
