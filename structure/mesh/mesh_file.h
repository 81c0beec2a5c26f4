// SPDX-License-Identifier: GPL-2.0-or-later
// Mesh as a text file for the solvers; numbers are exact when read back. Meshes of other
// programs are converted to it once, so that no solver loads their libraries.
//
//   # magfsi mesh [m]
//   nodes N                 N lines: x y z
//   regions R               R lines: a name (R = 0: one piece without a name)
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

// Write and read a mesh file. The centre line is not written; reading takes it from the
// line named "centre_line" if there is one. Both throw std::runtime_error with the file,
// reading also with the line and what was expected in it.
void write_mesh_file(const Mesh& mesh, const std::filesystem::path& file);
Mesh read_mesh_file(const std::filesystem::path& file);

// Nodes as material points, sorted by the coordinate in which they extend farthest (x
// before y before z): a centre line that does not turn back. Throws std::invalid_argument
// if a node belongs to no element.
std::vector<MaterialPoint> line_through(const Mesh& mesh, std::span<const int> nodes);

// Writes a text file by print(out), where out is the result of fmt::output_file. Throws
// std::runtime_error with the kind of the file, such as "mesh file", and its path.
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

// Writes "nodes N" and a line of three coordinates for each node.
void write_nodes(fmt::ostream& out, const std::vector<Vec3>& nodes_m);

// Reader of text files of nodes and elements, line by line, without comments and blank
// lines. Every error is a std::runtime_error with the kind of file, its path, the line
// and what was expected there.
class NumberedLines {
  public:
    // kind: name of the kind for messages, such as "mesh file".
    NumberedLines(std::string kind, const std::filesystem::path& file);

    // The next line. expected: description of its contents, for the message if there is
    // none.
    std::istringstream next(const std::string& expected);

    // The next line as it stands, for a name that may be blank or begin with #.
    std::string verbatim(const std::string& expected);

    // The number N of a line "keyword N". Throws if it is less than `least`.
    std::size_t count(const std::string& keyword, std::size_t least);

    // Nodes from a line "nodes N", with N at least `least`, and N lines of three
    // coordinates [m].
    std::vector<Vec3> nodes(std::size_t least);

    // Throws the error of the line read last.
    [[noreturn]] void fail(const std::string& expected) const;

  private:
    std::string kind_;
    std::filesystem::path file_;
    std::ifstream stream_;
    int number_ = 0;    // number of the line read last
    std::string last_;  // that line
};

}  // namespace magfsi::structure
