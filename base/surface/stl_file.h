// SPDX-License-Identifier: GPL-2.0-or-later
// Reading of an STL file, without any check of the surface.
#pragma once

#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "base/surface/triangles.h"

namespace magfsi::surface {

// Throws std::invalid_argument with "is the STL file FILE, which WHAT"; the caller puts
// the name of the obstacle before it.
template <class... What>
[[noreturn]] void refuse_file(const std::string& file, const What&... what) {
    std::ostringstream text;
    text << "is the STL file " << file << ", which ";
    (text << ... << what);
    throw std::invalid_argument(text.str());
}

// The triangles of an STL file, ASCII or binary. The size of the file decides which,
// because some binary files begin with the word "solid", too. Normals and attributes are
// ignored. Throws std::invalid_argument by refuse_file() if the file cannot be read, is
// cut short, or has no triangle or a vertex that is not finite.
std::vector<Triangle> read_stl(const std::string& file);

}  // namespace magfsi::surface
