// The collision that automatic stands for follows the relaxation time, and the reason
// names it.
#include <gtest/gtest.h>

#include "fluid_lbm/collision/choice.h"
#include "fluid_lbm/units.h"
#include "tests/unit/fluid_lbm/lattice_fluid.h"

namespace magfsi::fluid {
namespace {

TEST(CollisionChoice, FollowsTheRelaxationTime) {
    const auto chosen = [](double tau) {
        return choose_collision(lattice_fluid({4, 4, 4}, tau, Collision::automatic));
    };
    EXPECT_EQ(chosen(0.5015), Collision::recursive_regularized);
    EXPECT_EQ(chosen(0.53), Collision::recursive_regularized);
    EXPECT_EQ(chosen(0.6), Collision::trt);
    EXPECT_EQ(chosen(1.5), Collision::trt);
}

TEST(CollisionChoice, FollowsMovingWalls) {
    FluidConfig config = lattice_fluid({4, 4, 4}, 0.52, Collision::automatic);
    set_walls(config, 1);
    EXPECT_EQ(choose_collision(config), Collision::recursive_regularized);
    config.boundaries[3].wall_velocity_m_s = {0.1, 0, 0};
    EXPECT_EQ(choose_collision(config), Collision::trt);
}

TEST(CollisionChoice, KeepsTheOddRateFromVanishing) {
    const auto odd = [](double tau) {
        const auto config = lattice_fluid({4, 4, 4}, tau, Collision::trt);
        return 1 / (0.5 + choose_magic_number(config) / (tau - 0.5));
    };
    EXPECT_NEAR(odd(0.5015), 1, 1e-12);
    EXPECT_NEAR(odd(0.549), 1, 1e-12);
    EXPECT_NEAR(odd(0.55), 1 / (0.5 + 0.1875 / 0.05), 1e-12);
}

TEST(CollisionChoice, GivesItsReason) {
    FluidConfig config = lattice_fluid({4, 4, 4}, 0.5015, Collision::automatic);
    const std::string low = collision_reason(config);
    EXPECT_EQ(low.find("recursive_regularized: relaxation time 0.5015"), 0u) << low;
    config.collision = Collision::bgk;
    EXPECT_EQ(collision_reason(config), "bgk: asked for");
    config.collision = Collision::trt;
    config.magic_number = 0.1875;
    EXPECT_EQ(collision_reason(config),
              "trt (magic number 0.1875, odd rate 0.007968): asked for");
}

TEST(CollisionChoice, RefusesConstantsWithoutMeaning) {
    FluidConfig config = lattice_fluid({4, 4, 4}, 0.6, Collision::trt);
    config.magic_number = 0;
    EXPECT_THROW(check(config), std::invalid_argument);
    config.magic_number = 0.25;
    config.smagorinsky_constant = -0.1;
    EXPECT_THROW(check(config), std::invalid_argument);
    config.smagorinsky_constant = 0.17;
    EXPECT_NO_THROW(check(config));
}

}  // namespace
}  // namespace magfsi::fluid
