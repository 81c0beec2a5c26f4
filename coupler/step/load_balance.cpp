// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupler/step/load_balance.h"

#include <fmt/format.h>

#include <algorithm>

namespace magfsi::coupler {

namespace {

// Smallest predicted gain that is advised: less is lost in effects that the model leaves
// out, memory bandwidth and messages.
constexpr double least_gain = 1.15;
// Gain that justifies a further rank.
constexpr double worth_a_rank = 1.02;
// Duration [s] below which a run is dominated by start-up and chance.
constexpr double shortest_run_s = 1;

// A division of the ranks, and its predicted speed over the present one.
struct Choice {
    int structure = 1;
    int fluid = 1;
    double gain = 1;
};

struct Run {
    SideLoad structure, fluid;
    double wall_s = 0;
    int cores = 1;
};

// Time of the steps with other numbers of ranks; the sides take turns.
double predicted_s(const Choice& choice, const Run& run) {
    return run.structure.working_s * run.structure.ranks / choice.structure +
           run.fluid.working_s * run.fluid.ranks / choice.fluid;
}

// Each side may use every core.
Choice best_ranks(const Run& run, const Choice& now) {
    // The time that the model does not explain is assumed to stay as it is.
    const double rest_s = std::max(0.0, run.wall_s - predicted_s(now, run));
    Choice best = now;
    for (int a = 1; a <= std::min(run.cores, run.structure.max_ranks); ++a) {
        for (int b = 1; b <= std::min(run.cores, run.fluid.max_ranks); ++b) {
            Choice c{a, b};
            c.gain = run.wall_s / (rest_s + predicted_s(c, run));
            if (c.gain > worth_a_rank * best.gain) best = c;
        }
    }
    return best;
}

std::string in_words(const Choice& best, const Run& run) {
    const bool structure_waits = run.structure.waiting_s > run.fluid.waiting_s;
    const SideLoad& idle = structure_waits ? run.structure : run.fluid;
    return fmt::format(
        "the {} waited {:.0f} % of the time for the {}: --ranks structure={},fluid={} "
        "may be {:.1f} times as fast",
        structure_waits ? "structure" : "fluid", 100 * idle.waiting_s / run.wall_s,
        structure_waits ? "fluid" : "structure", best.structure, best.fluid, best.gain);
}

double steps_of_both_s(const SideLoad& structure, const SideLoad& fluid) {
    return std::min(structure.steps_s, fluid.steps_s);
}

}  // namespace

double coupling_overhead(const SideLoad& structure, const SideLoad& fluid) {
    const double steps_s = steps_of_both_s(structure, fluid);
    if (steps_s <= 0) return 0;
    // Outputs of the two sides overlap.
    const double needed_s = structure.solver_s + structure.immersed_boundary_s +
                            fluid.solver_s + fluid.immersed_boundary_s +
                            std::max(structure.output_s, fluid.output_s);
    return std::max(0.0, 1 - needed_s / steps_s);
}

double immersed_boundary_share(const SideLoad& structure, const SideLoad& fluid) {
    const double steps_s = steps_of_both_s(structure, fluid);
    if (steps_s <= 0) return 0;
    return (structure.immersed_boundary_s + fluid.immersed_boundary_s) / steps_s;
}

std::optional<std::string> advice(const SideLoad& structure, const SideLoad& fluid,
                                  double wall_s, int cores) {
    if (wall_s < shortest_run_s) return std::nullopt;
    const Run run{structure, fluid, wall_s, cores};
    const Choice best = best_ranks(run, {structure.ranks, fluid.ranks});
    if (best.gain < least_gain) return std::nullopt;
    return in_words(best, run);
}

}  // namespace magfsi::coupler
