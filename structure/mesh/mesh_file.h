// SPDX-License-Identifier: GPL-2.0-or-later
// A mesh as text, as the solvers read it: numbers read back exactly. Meshes of other
// programs are converted to it once, so that no solver loads their libraries.
//
//   # magfsi mesh [m]
//   nodes N                 N lines: x y z
//   regions R               R lines: a name (may be 0: one piece without a name)
//   elements M              M lines: n0 ... n7 region; -1 without regions
//   faces F                 F times: "COUNT NAME", then a line of COUNT node numbers
//   points P                the same for named points and lines
#pragma once

#include <fmt/format.h>
#include <fmt/os.h>

#include <cstddef>
#include <filesystem>
#include <fstream>
#include <span>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "structure/mesh/mesh.h"

namespace magfsi::structure {

// Writes all but the centre line; reading takes it from the line named "centre_line",
// where there is one. Both throw std::runtime_error that names the file; reading also the
// line and what was expected in it.
void write_mesh_file(const Mesh& mesh, const std::filesystem::path& file);
Mesh read_mesh_file(const std::filesystem::path& file);

// Nodes as material points, in the order of the coordinate in which they extend farthest
// (x before y before z): the centre line, which does not turn back. Throws
// std::invalid_argument for a node of no element.
std::vector<MaterialPoint> line_through(const Mesh& mesh, std::span<const int> nodes);

// Writes a text file by print(out), out as of fmt::output_file. Throws std::runtime_error
// that names the kind of file, such as "mesh file", and the file.
template <class Print>
void write_text_file(const char* kind, const std::filesystem::path& file,
                     const Print& print) {
    try {
        auto out = fmt::output_file(file.string());
        print(out);
    } catch (const std::system_error& error) {
        throw std::runtime_error(
            fmt::format("cannot write the {} {}: {}", kind, file.string(), error.what()));
    }
}

// "nodes N" and a line of three coordinates each, which read back exactly.
void write_nodes(fmt::ostream& out, const std::vector<Vec3>& nodes_m);

// Text files of nodes and elements, line by line, without comments and blank lines. Every
// error is a std::runtime_error with the kind of file, its name, the line and what was
// expected there.
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
