#include "adapters/magfsi/accuracy/law.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace magfsi::launch {

namespace {

// Beyond these a study says nothing: errors that hardly fall, or fall by chance.
constexpr double least_order = 0.3, most_order = 4, step_of_order = 0.01;

double shape(double resolution, double order, double compared_with) {
    const double own = compared_with > 0 ? std::pow(compared_with, -order) : 0;
    return std::pow(resolution, -order) - own;
}

// Of the logarithms of the errors around C (n^-p - ...), with the C that makes it least.
double variance(const std::vector<StudiedRun>& runs, double order, double compared_with) {
    double sum = 0, squares = 0;
    for (const StudiedRun& run : runs) {
        const double off =
            std::log(run.error / shape(run.resolution, order, compared_with));
        sum += off;
        squares += off * off;
    }
    const double mean = sum / static_cast<double>(runs.size());
    return squares / static_cast<double>(runs.size()) - mean * mean;
}

}  // namespace

double ErrorLaw::error(double resolution) const {
    return constant * std::pow(resolution, -order);
}

double ErrorLaw::resolution(double error) const {
    return std::pow(constant / error, 1 / order);
}

ErrorLaw fit_law(const std::vector<StudiedRun>& runs, double compared_with) {
    const auto [coarse, fine] =
        std::ranges::minmax_element(runs, {}, &StudiedRun::resolution);
    if (runs.empty() || coarse->resolution == fine->resolution)
        throw std::invalid_argument("a law of errors needs runs at two resolutions");
    ErrorLaw law;
    law.coarsest = coarse->resolution;
    law.finest = std::max(fine->resolution, compared_with);
    double least = std::numeric_limits<double>::infinity();
    for (double p = least_order; p <= most_order; p += step_of_order) {
        const double off = variance(runs, p, compared_with);
        if (off >= least) continue;
        least = off;
        law.order = p;
    }
    for (const StudiedRun& run : runs) {
        law.constant = std::max(
            law.constant, run.error / shape(run.resolution, law.order, compared_with));
    }
    return law;
}

}  // namespace magfsi::launch
