// Triangles of an STL file.
#pragma once

#include <array>
#include <filesystem>
#include <vector>

namespace magfsi::fluid {

using Triangle = std::array<std::array<double, 3>, 3>;

// ASCII or binary, whichever the size of the file says: some binary files begin with the
// word "solid", too. Normals and attributes are ignored. Throws std::invalid_argument
// with the file's name if it cannot be read, is cut short or has no triangle.
std::vector<Triangle> read_stl(const std::filesystem::path& file);

}  // namespace magfsi::fluid
