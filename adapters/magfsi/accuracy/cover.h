// Which study covers a scene, and what its runs say for the scene's own lengths.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "adapters/magfsi/accuracy/law.h"
#include "adapters/scene/accuracy.h"

namespace magfsi::launch {

struct Cover {
    std::string study;       // docs/accuracy/NAME
    std::string because;     // what of the scene it has studied
    std::string error_of;    // "the tip's displacement, ..."
    std::string resolution;  // "elements along the beam"
    ErrorLaw law;
    double least_error = 0;           // what the study's own reference is good for
    std::vector<double> resolutions;  // that the scene can have, from coarse to fine
    std::function<std::vector<std::string>(double)> settings;  // for --set
};

// found: what the scene has; allowed: what the study has.
struct NotCovered {
    std::string study, found, allowed;
};

// Nothing if the scene is of another kind. Throws NotCovered where it is of the kind but
// outside of what was studied.
std::optional<Cover> cover_beams(const scene::Unresolved& unresolved);
std::optional<Cover> cover_taylor_green(const scene::Unresolved& unresolved);

}  // namespace magfsi::launch
