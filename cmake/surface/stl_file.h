// SPDX-License-Identifier: GPL-2.0-or-later
// The triangles of an STL file as they stand there.
#pragma once

#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "surface/triangles.h"

namespace magfsi::surface {

template <class... What>
[[noreturn]] void refuse_file(const std::string& file, const What&... what) {
    std::ostringstream text;
    text << "is the STL file " << file << ", which ";
    (text << ... << what);
    throw std::invalid_argument(text.str());
}

// ASCII or binary, whichever the size of the file says: some binary files begin with the
// word "solid", too. Normals and attributes are ignored. Throws as read_closed.
std::vector<Triangle> read_stl(const std::string& file);

}  // namespace magfsi::surface
