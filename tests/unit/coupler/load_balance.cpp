// What a coupled run says about its own balance: the share that coupling costs, and the
// advice that it gives only where it pays.
#include "coupler/step/load_balance.h"

#include <gtest/gtest.h>

namespace magfsi::coupler {
namespace {

using coupler::Scheme;

SideLoad side(int ranks, double working_s, double waiting_s, int max_ranks) {
    SideLoad load;
    load.ranks = ranks;
    load.working_s = load.solver_s = working_s;
    load.waiting_s = waiting_s;
    load.max_ranks = max_ranks;
    return load;
}

std::string said(Scheme scheme, const SideLoad& structure, const SideLoad& fluid,
                 double wall_s, int cores) {
    return advice(scheme, structure, fluid, wall_s, cores).value_or("");
}

TEST(LoadBalance, overhead_is_what_neither_solver_needs) {
    SideLoad structure = side(1, 3, 6, 1);
    SideLoad fluid = side(1, 6, 3, 1);
    structure.steps_s = 12;  // two of them before the fluid's first step
    fluid.steps_s = 10;
    // 10 s in turns: 9 s of solvers. At once the slower one alone would need 6.
    EXPECT_NEAR(coupling_overhead(Scheme::serial, structure, fluid), 0.1, 1e-12);
    EXPECT_NEAR(coupling_overhead(Scheme::parallel, structure, fluid), 0.4, 1e-12);
    // Both write at the same time: the longer output counts.
    structure.output_s = 0.2;
    fluid.output_s = 0.5;
    EXPECT_NEAR(coupling_overhead(Scheme::serial, structure, fluid), 0.05, 1e-12);
    // Markers and cells are work that the method asks for.
    fluid.immersed_boundary_s = 0.4;
    EXPECT_NEAR(coupling_overhead(Scheme::serial, structure, fluid), 0.01, 1e-12);
    EXPECT_NEAR(immersed_boundary_share(structure, fluid), 0.04, 1e-12);
    fluid.steps_s = 5;
    EXPECT_EQ(coupling_overhead(Scheme::serial, structure, fluid), 0);
}

TEST(LoadBalance, a_waiting_structure_is_told_to_give_the_fluid_more_ranks) {
    EXPECT_EQ(said(Scheme::serial, side(1, 1, 9, 1), side(1, 9, 1, 50), 10, 4),
              "the structure waited 90 % of the time for the fluid: "
              "--ranks structure=1,fluid=4 may be 3.1 times as fast");
    // At once the two may not share cores.
    EXPECT_EQ(said(Scheme::parallel, side(1, 3, 6, 1), side(1, 9, 0, 50), 9, 4),
              "the structure waited 67 % of the time for the fluid: "
              "--ranks structure=1,fluid=3 may be 3.0 times as fast");
}

TEST(LoadBalance, two_equal_sides_are_told_to_work_at_once) {
    EXPECT_EQ(said(Scheme::serial, side(1, 5, 5, 1), side(1, 5, 5, 1), 10, 2),
              "the fluid waited 50 % of the time for the structure: "
              "--set coupling.scheme=parallel --ranks structure=1,fluid=1 may be 2.0 "
              "times as fast");
}

TEST(LoadBalance, silent_where_nothing_pays) {
    // Every core is in use.
    EXPECT_EQ(said(Scheme::serial, side(1, 1, 9, 1), side(4, 9, 1, 50), 10, 4), "");
    // More ranks would have too little to do.
    EXPECT_EQ(said(Scheme::serial, side(1, 1, 9, 1), side(1, 9, 1, 1), 10, 4), "");
    // A tenth more is not worth it: the rest of the time is no side's work.
    EXPECT_EQ(said(Scheme::serial, side(1, 0, 9, 1), side(1, 2, 1, 50), 10, 2), "");
    // Too short to tell.
    EXPECT_EQ(said(Scheme::serial, side(1, .05, .4, 1), side(1, .4, .05, 50), 0.5, 4),
              "");
}

}  // namespace
}  // namespace magfsi::coupler
