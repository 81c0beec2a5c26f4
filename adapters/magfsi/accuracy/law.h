// error = C n^-p: what a study's runs say about a resolution n, such as the cells across
// a length.
#pragma once

#include <vector>

namespace magfsi::launch {

struct StudiedRun {
    double resolution = 0;
    double error = 0;  // relative
};

struct ErrorLaw {
    double constant = 0, order = 0;
    double coarsest = 0, finest = 0;  // resolutions that were studied
    double error(double resolution) const;
    double resolution(double error) const;  // that has this error; not clipped
};

// compared_with: the resolution of the run that the errors were taken from, whose own
// error they lack: error = C (n^-p - n_compared^-p); 0 for an exact reference. Of p, the
// one that fits best in logarithms; of C, the least that no run exceeds. Throws
// std::invalid_argument on fewer than two resolutions.
ErrorLaw fit_law(const std::vector<StudiedRun>& runs, double compared_with = 0);

}  // namespace magfsi::launch
