// SPDX-License-Identifier: GPL-2.0-or-later
// Running means of samples, one per coupled step: M is the mean of the samples, N the
// mean of M. With w the weight of the last sample and samples that change slowly, M lags
// by (1 - w) / w steps, N by twice that, and 2 M - N not at all.
#pragma once

namespace magfsi::coupler {

// Adds a sample to M (mean) and N (mean_of_mean).
inline void add_to_means(double sample, double weight, double& mean,
                         double& mean_of_mean) {
    mean += weight * (sample - mean);
    mean_of_mean += weight * (mean - mean_of_mean);
}

}  // namespace magfsi::coupler
