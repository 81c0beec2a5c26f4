// SPDX-License-Identifier: GPL-2.0-or-later
// Who is who after the first act, and what a lonely participant says.
#include "coupler/participants/world.h"
#include <gtest/gtest.h>
#include "coupler/participants/errors.h"
#include "coupler/participants/handshake.h"
#include "tests/mpi/coupler/split.h"
#include "tests/support/checks.h"

namespace magfsi::coupler {
namespace {

using namespace testing;

TEST(World, roles_and_sizes) {
    for (const int structure_ranks : splits()) {
        const World world(role_in(structure_ranks), true);
        const bool structure = world_rank() < structure_ranks;
        const int fluid_ranks = world_size() - structure_ranks;
        EXPECT_EQ(world.self(), structure ? Role::structure : Role::fluid);
        EXPECT_EQ(world.other(), structure ? Role::fluid : Role::structure);
        EXPECT_EQ(world.size(), structure ? structure_ranks : fluid_ranks);
        EXPECT_EQ(world.partner_size(), structure ? fluid_ranks : structure_ranks);
        EXPECT_EQ(world.rank(),
                  structure ? world_rank() : world_rank() - structure_ranks);
        EXPECT_TRUE(world.coupled());
        EXPECT_EQ(world.root(), world.rank() == 0);
        EXPECT_EQ(world.leads(), world_rank() == 0);
    }
}

// Roles need not come in order: mpirun lists the programs as it likes.
TEST(World, the_fluid_may_come_first) {
    const Role role = world_rank() == world_size() - 1 ? Role::structure : Role::fluid;
    const World world(role, true);
    EXPECT_EQ(world.leads(), world_rank() == world_size() - 1);
    EXPECT_EQ(world.partner_size(), role == Role::structure ? world_size() - 1 : 1);
}

// A message along the intercommunicator reaches the rank it names on the other side.
TEST(World, the_two_sides_are_joined) {
    for (const int structure_ranks : splits()) {
        const World world(role_in(structure_ranks), true);
        const int mine = 100 * static_cast<int>(world.self()) + world.rank();
        std::vector<int> theirs(static_cast<std::size_t>(world.partner_size()));
        MPI_Allgather(&mine, 1, MPI_INT, theirs.data(), 1, MPI_INT, world.partner());
        for (int r = 0; r < world.partner_size(); ++r) {
            EXPECT_EQ(theirs[static_cast<std::size_t>(r)],
                      100 * static_cast<int>(world.other()) + r);
        }
    }
}

TEST(World, alone_as_the_scene_wants) {
    for (const Role role : {Role::structure, Role::fluid}) {
        const World world(role, false);
        EXPECT_FALSE(world.coupled());
        EXPECT_EQ(world.size(), world_size());
        EXPECT_EQ(world.partner_size(), 0);
        EXPECT_EQ(world.leads(), world_rank() == 0);
    }
}

std::string refusal(Role role, bool partner_expected) {
    return test::message_of<PartnerLost>([&] { World(role, partner_expected); });
}

TEST(World, a_partner_that_was_not_started_is_missed_on_every_rank) {
    const std::string why = refusal(Role::fluid, true);
    test::expect_says(why,
                      {"fluid was started without its partner", "no structure process"});
}

TEST(World, a_partner_that_the_scene_lacks_is_refused_on_every_rank) {
    const std::string why = refusal(role_in(1), false);
    test::expect_says(why, {"was started beside the"});
}

// Both sides agree on what they run, or both say what differs; texts of any length pass.
Agreement usual() {
    return {1, 0x0123456789abcdef, 1000, 20'000'000};
}

// What each rank is told when the fluid's side brings another agreement.
std::string told(const World& world, const Agreement& of_the_fluid) {
    return test::message_of<PartnerLost>([&] {
        shake_hands(world, world.self() == Role::fluid ? of_the_fluid : usual(),
                    timeout_s);
    });
}

TEST(Handshake, the_same_scene_on_both_sides) {
    for (const int structure_ranks : splits()) {
        const World world(role_in(structure_ranks), true);
        EXPECT_EQ(told(world, usual()), "");
    }
}

TEST(Handshake, another_scene_is_told_to_every_rank_with_both_hashes) {
    for (const int structure_ranks : splits()) {
        const World world(role_in(structure_ranks), true);
        Agreement other = usual();
        other.scene_hash = 0xfedcba9876543210;
        const std::string why = told(world, other);
        test::expect_says(why, {"scene", "0123456789abcdef", "fedcba9876543210"});
    }
}

TEST(Handshake, names_the_item_that_differs) {
    const World world(role_in(1), true);
    Agreement other = usual();
    other.steps = 1001;
    test::expect_says(told(world, other), {"number of coupled steps"});
    other = usual();
    other.step_ps += 1;
    test::expect_says(told(world, other), {"20000001"});
    other = usual();
    other.protocol = 2;
    other.scene_hash =
        0;  // a build of another protocol may hash otherwise: version first
    test::expect_says(told(world, other), {"protocol version"});
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
