// SPDX-License-Identifier: GPL-2.0-or-later
// Program magfsi-mesh: converts a mesh of Gmsh to the mesh file that the solvers read. It
// is a program of its own, so that no solver loads Gmsh's library and the ninety
// libraries that it needs.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <exception>
#include <string>

#include "structure/mesh/gmsh_mesh.h"
#include "structure/mesh/mesh_file.h"

namespace {

using namespace magfsi::structure;

// Contents of the mesh, for the user.
std::string report(const GmshMesh& read) {
    const Mesh& mesh = read.mesh;
    std::string out =
        fmt::format("{} hexahedra, {} nodes\n", mesh.elements.size(), mesh.nodes.size());
    for (std::size_t r = 0; r < mesh.region_names.size(); ++r) {
        out += fmt::format("region {}: {} elements\n", mesh.region_names[r],
                           std::count(mesh.region.begin(), mesh.region.end(), int(r)));
    }
    for (const auto& [name, nodes] : mesh.faces) {
        out += fmt::format("face {}: {} nodes\n", name, nodes.size());
    }
    for (const auto& [name, nodes] : mesh.points) {
        out += fmt::format("point {}: {} nodes\n", name, nodes.size());
    }
    if (read.unused_nodes > 0) {
        out +=
            fmt::format("note: {} nodes of no hexahedron dropped\n", read.unused_nodes);
    }
    if (read.part_elements.size() > 1) {
        out +=
            fmt::format("note: {} parts that nothing joins, of {} elements\n",
                        read.part_elements.size(), fmt::join(read.part_elements, ", "));
    }
    return out;
}

}  // namespace

int main(int argc, char** argv) {
    CLI::App app("Turns a Gmsh mesh of hexahedra into a mesh file of magfsi.");
    std::string input, output;
    double metres_per_unit = 1;
    app.add_option("input", input, "Gmsh .msh file, version 2.2 or 4.1")->required();
    app.add_option("output", output, "mesh file to write")->required();
    app.add_option("--unit", metres_per_unit, "metres in one unit of the input")
        ->capture_default_str();
    CLI11_PARSE(app, argc, argv);
    try {
        const GmshMesh read = read_gmsh_mesh(input, metres_per_unit);
        write_mesh_file(read.mesh, output);
        fmt::print("{}", report(read));
    } catch (const std::exception& error) {
        fmt::print(stderr, "magfsi-mesh: {}\n", error.what());
        return 2;  // bad input
    }
    return 0;
}
