// The fluid's grid as text, for the partner at start-up.
#pragma once

#include <string>

#include "coupler/immersed_boundary/grid.h"

namespace magfsi::coupler {

std::string to_text(const Grid& grid);
Grid grid_from_text(const std::string& text);

}  // namespace magfsi::coupler
