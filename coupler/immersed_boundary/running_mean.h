// SPDX-License-Identifier: GPL-2.0-or-later
// A running mean M of samples, one a coupled step, and the running mean N of M. Where the
// samples change slowly M lags by (1 - w) / w steps, w the weight of the last one, N by
// twice that, 2 M - N not at all.
#pragma once

namespace magfsi::coupler {

inline void add_to_means(double sample, double weight, double& mean,
                         double& mean_of_mean) {
    mean += weight * (sample - mean);
    mean_of_mean += weight * (mean - mean_of_mean);
}

}  // namespace magfsi::coupler
