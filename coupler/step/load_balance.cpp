// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupler/step/load_balance.h"

#include <fmt/format.h>

#include <algorithm>

namespace magfsi::coupler {

namespace {

// Smallest predicted gain that is advised: less is lost in effects that the model leaves
// out, memory bandwidth and messages.
constexpr double least_gain = 1.15;
// The other scheme gives slightly different results: it must gain more than ranks alone.
constexpr double least_gain_of_scheme = 1.25;
// Gain that justifies a further rank.
constexpr double worth_a_rank = 1.02;
// Duration [s] below which a run is dominated by start-up and chance.
constexpr double shortest_run_s = 1;

// A division of the ranks, and its predicted speed over the present one.
struct Choice {
    Scheme scheme = Scheme::serial;
    int structure = 1;
    int fluid = 1;
    double gain = 1;
};

bool in_turns(Scheme scheme) {
    return scheme != Scheme::parallel;
}

// Time of two sides that take turns or work at the same time.
double together(Scheme scheme, double a, double b) {
    return in_turns(scheme) ? a + b : std::max(a, b);
}

// Time of the steps with other numbers of ranks.
double predicted_s(const Choice& choice, const SideLoad& structure,
                   const SideLoad& fluid) {
    return together(choice.scheme,
                    structure.working_s * structure.ranks / choice.structure,
                    fluid.working_s * fluid.ranks / choice.fluid);
}

bool fits(const Choice& c, int cores) {
    // Sides that take turns may share cores.
    return in_turns(c.scheme) ? std::max(c.structure, c.fluid) <= cores
                              : c.structure + c.fluid <= cores;
}

struct Run {
    SideLoad structure, fluid;
    double wall_s = 0;
    int cores = 1;
};

Choice best_ranks(Scheme scheme, const Run& run, const Choice& now) {
    // The time that the model does not explain is assumed to stay as it is.
    const double rest_s =
        std::max(0.0, run.wall_s - predicted_s(now, run.structure, run.fluid));
    Choice best = now;
    for (int a = 1; a <= std::min(run.cores, run.structure.max_ranks); ++a) {
        for (int b = 1; b <= std::min(run.cores, run.fluid.max_ranks); ++b) {
            Choice c{scheme, a, b};
            c.gain = run.wall_s / (rest_s + predicted_s(c, run.structure, run.fluid));
            if (fits(c, run.cores) && c.gain > worth_a_rank * best.gain) best = c;
        }
    }
    return best;
}

std::string in_words(const Choice& now, const Choice& best, const Run& run) {
    const bool structure_waits = run.structure.waiting_s > run.fluid.waiting_s;
    const SideLoad& idle = structure_waits ? run.structure : run.fluid;
    std::string text = fmt::format("the {} waited {:.0f} % of the time for the {}:",
                                   structure_waits ? "structure" : "fluid",
                                   100 * idle.waiting_s / run.wall_s,
                                   structure_waits ? "fluid" : "structure");
    if (best.scheme != now.scheme)
        text += fmt::format(" --set coupling.scheme={}", name_of(best.scheme));
    return text +
           fmt::format(" --ranks structure={},fluid={} may be {:.1f} times as fast",
                       best.structure, best.fluid, best.gain);
}

double steps_of_both_s(const SideLoad& structure, const SideLoad& fluid) {
    return std::min(structure.steps_s, fluid.steps_s);
}

}  // namespace

double coupling_overhead(Scheme scheme, const SideLoad& structure,
                         const SideLoad& fluid) {
    const double steps_s = steps_of_both_s(structure, fluid);
    if (steps_s <= 0) return 0;
    const double structure_s = structure.solver_s + structure.immersed_boundary_s;
    const double fluid_s = fluid.solver_s + fluid.immersed_boundary_s;
    // Outputs of the two sides overlap in every scheme.
    const double needed_s =
        in_turns(scheme)
            ? structure_s + fluid_s + std::max(structure.output_s, fluid.output_s)
            : std::max(structure_s + structure.output_s, fluid_s + fluid.output_s);
    return std::max(0.0, 1 - needed_s / steps_s);
}

double immersed_boundary_share(const SideLoad& structure, const SideLoad& fluid) {
    const double steps_s = steps_of_both_s(structure, fluid);
    if (steps_s <= 0) return 0;
    return (structure.immersed_boundary_s + fluid.immersed_boundary_s) / steps_s;
}

std::optional<std::string> advice(Scheme scheme, const SideLoad& structure,
                                  const SideLoad& fluid, double wall_s, int cores) {
    if (wall_s < shortest_run_s) return std::nullopt;
    const Run run{structure, fluid, wall_s, cores};
    const Choice now{scheme, structure.ranks, fluid.ranks};
    Choice best = best_ranks(scheme, run, now);
    // Users choose the implicit scheme for other reasons.
    if (scheme != Scheme::implicit) {
        const Scheme other = scheme == Scheme::serial ? Scheme::parallel : Scheme::serial;
        const Choice changed = best_ranks(other, run, now);
        if (changed.gain > least_gain_of_scheme * best.gain) best = changed;
    }
    if (best.gain < least_gain) return std::nullopt;
    return in_words(now, best, run);
}

}  // namespace magfsi::coupler
