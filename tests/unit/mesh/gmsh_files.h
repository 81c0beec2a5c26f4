// Meshes that Gmsh itself makes and saves, for the tests of reading them.
#pragma once

#include <gmsh.h>

#include <filesystem>
#include <fstream>
#include <functional>
#include <string>

namespace magfsi::structure::test {

struct Format {
    double version = 4.1;
    bool binary = false;
};

inline std::filesystem::path file_in_folder(const std::string& name) {
    const auto folder = std::filesystem::temp_directory_path() / "magfsi_gmsh_tests";
    std::filesystem::create_directories(folder);
    return folder / name;
}

// Runs `build` in an empty model of Gmsh, meshes and saves it.
inline std::filesystem::path gmsh_file(const std::string& name, const Format& format,
                                       const std::function<void()>& build,
                                       int dimension = 3) {
    const auto file = file_in_folder(name);
    gmsh::initialize(0, nullptr, false);
    gmsh::option::setNumber("General.Terminal", 0);
    gmsh::option::setNumber("Mesh.MshFileVersion", format.version);
    gmsh::option::setNumber("Mesh.Binary", format.binary ? 1 : 0);
    build();
    gmsh::model::mesh::generate(dimension);
    gmsh::write(file.string());
    gmsh::finalize();
    return file;
}

// Block of hexahedra by extrusion, sizes in the mesh's unit. Returns the volume's tag;
// gives the tags of its top and of its point at (x, y, 0).
struct Block {
    int volume = 0, top = 0, bottom = 0, corner = 0;
};
inline Block add_block(double x, double y, double z, double lx, double ly, double lz,
                       int nx, int ny, int nz) {
    const int p0 = gmsh::model::geo::addPoint(x, y, z);
    const int p1 = gmsh::model::geo::addPoint(x + lx, y, z);
    const int l = gmsh::model::geo::addLine(p0, p1);
    gmsh::model::geo::mesh::setTransfiniteCurve(l, nx + 1);
    gmsh::vectorpair face, body;
    gmsh::model::geo::extrude({{1, l}}, 0, ly, 0, face, {ny}, {}, true);
    gmsh::model::geo::extrude({face[1]}, 0, 0, lz, body, {nz}, {}, true);
    return {body[1].second, body[0].second, face[1].second, p0};
}

inline std::filesystem::path text_file(const std::string& name, const std::string& text) {
    const auto file = file_in_folder(name);
    std::ofstream(file) << text;
    return file;
}

}  // namespace magfsi::structure::test
