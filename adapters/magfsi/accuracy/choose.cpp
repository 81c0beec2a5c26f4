#include "adapters/magfsi/accuracy/choose.h"

#include <fmt/format.h>

#include <algorithm>

namespace magfsi::launch {

namespace {

constexpr const char* remedy =
    "give fluid.spacing and the elements of blocks in place of accuracy, or make a study "
    "of this scene (docs/accuracy)";

Cover covering(const scene::Unresolved& unresolved) {
    try {
        for (const auto cover : {cover_beams, cover_taylor_green}) {
            if (auto found = cover(unresolved)) return *found;
        }
    } catch (const NotCovered& not_covered) {
        refuse(unresolved.mark,
               fmt::format("{}, which docs/accuracy/{} does not cover", not_covered.found,
                           not_covered.study),
               not_covered.allowed, remedy);
    }
    refuse(unresolved.mark, "accuracy in a scene that none of the studies covers",
           "cantilevers without fluid, and the Taylor-Green vortex alone", remedy);
}

std::string percent(double share) {
    return fmt::format("{:.2g} %", 100 * share);
}

// The coarsest with at most this error; nothing beyond what was studied.
std::optional<double> resolution_for(const Cover& cover, double error) {
    if (error < cover.least_error) return std::nullopt;
    const auto found = std::ranges::find_if(
        cover.resolutions, [&](double n) { return cover.law.error(n) <= error; });
    return found == cover.resolutions.end() ? std::nullopt : std::optional(*found);
}

double by_error(const Cover& cover, const scene::Unresolved& unresolved) {
    if (const auto n = resolution_for(cover, *unresolved.wanted.error)) return *n;
    const double least =
        cover.resolutions.empty()
            ? cover.least_error
            : std::max(cover.least_error, cover.law.error(cover.resolutions.back()));
    refuse(unresolved.mark,
           fmt::format("an error of {}, of {}", percent(*unresolved.wanted.error),
                       cover.error_of),
           fmt::format("{} and more: as far as docs/accuracy/{} goes",
                       percent(least * 1.005), cover.study));
}

double by_time(const Cover& cover, const scene::Unresolved& unresolved,
               const WallTime& wall_s) {
    const double most_s = *unresolved.wanted.time_s;
    double coarsest_s = 0;
    std::optional<double> chosen;
    for (const double n : cover.resolutions) {
        const auto time_s = wall_s(cover.settings(n));
        if (!time_s) {
            refuse(unresolved.mark, "a time, on a machine that is not calibrated",
                   "accuracy.error", "run ./magfsi bench --calibrate, half a minute");
        }
        if (n == cover.resolutions.front()) coarsest_s = *time_s;
        if (*time_s > most_s) break;
        chosen = n;
    }
    if (chosen) return *chosen;
    refuse(unresolved.mark, fmt::format("a time of {:.3g} s", most_s),
           fmt::format("{:.3g} s and more: what the coarsest of docs/accuracy/{} takes",
                       coarsest_s, cover.study));
}

std::string price(const std::optional<double>& wall_s) {
    return wall_s ? fmt::format("{:.2g} s", *wall_s)
                  : "an unknown time (./magfsi bench --calibrate tells)";
}

std::string halved(const Cover& cover, double error, const WallTime& wall_s) {
    const auto finer = resolution_for(cover, error / 2);
    if (!finer) return "half of that error is more than the study promises";
    return fmt::format("half of that error: {:.4g}, {}", *finer,
                       price(wall_s(cover.settings(*finer))));
}

Choice describe(const Cover& cover, double n, const WallTime& wall_s) {
    Choice choice;
    choice.settings = cover.settings(n);
    const double error = cover.law.error(n);
    const auto time_s = wall_s(choice.settings);
    choice.words = {
        fmt::format("accuracy: by docs/accuracy/{}, which has studied {}", cover.study,
                    cover.because),
        fmt::format("accuracy: the error of {} is {:.3g} n^-{:.3g} for n {} ({:.3g} to "
                    "{:.3g} studied)",
                    cover.error_of, cover.law.constant, cover.law.order, cover.resolution,
                    cover.law.coarsest, cover.law.finest),
        fmt::format("accuracy: {:.4g} {}: {} to expect in {}; {}", n, cover.resolution,
                    percent(error), price(time_s), halved(cover, error, wall_s)),
        fmt::format("accuracy: chosen {}", fmt::join(choice.settings, ", "))};
    choice.json = {{"study", cover.study},
                   {"error_of", cover.error_of},
                   {"expected_error", error},
                   {"resolution", n},
                   {"resolution_is", cover.resolution},
                   {"settings", choice.settings}};
    return choice;
}

}  // namespace

Choice choose(const scene::Unresolved& unresolved, const WallTime& wall_s) {
    const Cover cover = covering(unresolved);
    const double n = unresolved.wanted.error ? by_error(cover, unresolved)
                                             : by_time(cover, unresolved, wall_s);
    return describe(cover, n, wall_s);
}

}  // namespace magfsi::launch
