// The case that OpenFOAM reads: what is to be solved and how. The engine makes its mesh
// in memory; stock_case.h has what the stock programs need besides.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>

#include "adapters/scene/scene.h"

namespace magfsi::openfoam {

struct CaseTimes {
    double step_s = 0;
    std::int64_t steps = 1;
    std::int64_t steps_between_files = 1;  // of a stock run; the engine writes none
};

// Writes system/, constant/ and 0/ into folder. Throws output::FileError.
void write_case(const std::filesystem::path& folder, const scene::Fluid& fluid,
                const CaseTimes& times);

// 0/U alone, with a boundary condition for each inlet.
void write_velocity(const std::filesystem::path& folder, const scene::Fluid& fluid,
                    const std::function<std::string(std::size_t side)>& at_inlet);

// A file with OpenFOAM's header.
void write_foam_file(const std::filesystem::path& folder, const char* location,
                     const char* name, const char* type, const std::string& text);

}  // namespace magfsi::openfoam
