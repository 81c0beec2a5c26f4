// SPDX-License-Identifier: GPL-2.0-or-later
// Dictionaries of a user's that are merged into the generated case: fluid.openfoam's
// schemes, solution and functions. The case keeps a copy of each, which the generated
// file includes at its end, so that OpenFOAM itself merges them: groups are joined,
// entries overridden.
#pragma once

#include <optional>
#include <string>

#include "adapters/scene/scene.h"

namespace magfsi::openfoam {

// Texts of the user's files.
struct UserFiles {
    std::optional<std::string> schemes, solution, functions;
    // The function objects stand within functions {} of their file.
    bool functions_are_grouped = false;
    // The user relaxes; magfsi's entry for the last corrector must come after it.
    bool has_relaxation = false;
};

// Reads the files of the scene and refuses entries that break the coupling, stop the run
// or run code: std::invalid_argument with the key, the place in the file, what was found
// and what to write instead.
UserFiles read_user_files(const scene::Fluid& fluid);

}  // namespace magfsi::openfoam
