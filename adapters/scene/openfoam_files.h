// SPDX-License-Identifier: GPL-2.0-or-later
// fluid.openfoam: files that a user of OpenFOAM adds to the generated case, or wants of
// it. The lattice has none of them.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>

namespace magfsi::scene {

// Time folders in OpenFOAM's own format, for paraFoam and postProcess.
enum class FoamFormat { ascii, binary };
constexpr auto words_of(FoamFormat) {
    return std::to_array<std::string_view>({"ascii", "binary"});
}
struct FoamWrite {
    double every_s = 0;
    FoamFormat format = FoamFormat::ascii;
};

// The dictionaries, given as names of files, are merged into fvSchemes, fvSolution and
// controlDict.
struct OpenFoam {
    std::optional<std::string> schemes, solution, functions;
    std::optional<FoamWrite> write;
};

}  // namespace magfsi::scene
