// Who is who after the first act, and what a lonely participant says.
#include "coupler/participants/world.h"

#include <gtest/gtest.h>

#include "coupler/participants/errors.h"
#include "tests/mpi/coupler/split.h"

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
    try {
        const World world(role, partner_expected);
    } catch (const PartnerLost& e) {
        return e.what();
    }
    return "joined";
}

TEST(World, a_partner_that_was_not_started_is_missed_on_every_rank) {
    const std::string why = refusal(Role::fluid, true);
    EXPECT_NE(why.find("fluid was started without its partner"), std::string::npos)
        << why;
    EXPECT_NE(why.find("no structure process"), std::string::npos) << why;
}

TEST(World, a_partner_that_the_scene_lacks_is_refused_on_every_rank) {
    const std::string why = refusal(role_in(1), false);
    EXPECT_NE(why.find("was started beside the"), std::string::npos) << why;
}

}  // namespace
}  // namespace magfsi::coupler
