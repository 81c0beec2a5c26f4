// Text files of nodes and elements, line by line, past comments and blank lines.
#pragma once

#include <cstddef>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "structure/mesh/mesh.h"

namespace magfsi::structure {

// Knows where it is: every error is a std::runtime_error with the kind of file, its name,
// the line and what was expected there.
class NumberedLines {
  public:
    // kind: for the errors, such as "mesh file".
    NumberedLines(std::string kind, const std::filesystem::path& file);

    std::istringstream next(const std::string& expected);

    // The N of a line "keyword N", at least `least`.
    std::size_t count(const std::string& keyword, std::size_t least);

    // A line "nodes N", N at least `least`, and three coordinates [m] on each of N lines.
    std::vector<Vec3> nodes(std::size_t least);

    [[noreturn]] void fail(const std::string& expected) const;

  private:
    std::string kind_;
    std::filesystem::path file_;
    std::ifstream stream_;
    int number_ = 0;
};

}  // namespace magfsi::structure
