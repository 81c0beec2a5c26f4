// SPDX-License-Identifier: GPL-2.0-or-later
// Checks of what a scene names outside itself, its run folder and its files. A scene may
// come from a stranger, so nothing here may lead to code being run or files being
// overwritten.
#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <string_view>
#include <utility>

#include "adapters/scene/checks.h"
#include "adapters/scene/effective.h"
#include "adapters/scene/named_files.h"

namespace magfsi::scene {

namespace fs = std::filesystem;

namespace {

// Limits of the scene's name [bytes] and of any file that it names.
constexpr std::size_t longest_name = 64;
constexpr std::uintmax_t largest_file_bytes = 200'000'000;

// Checks the scene's name, which becomes a folder of runs/ and is written into the
// generated LAMMPS script.
void check_name(const std::string& name, const Origin& where) {
    const auto allowed = [](char c) {
        return std::isalnum(static_cast<unsigned char>(c)) != 0 ||
               std::string_view(" _-+=:,.()").find(c) != std::string_view::npos;
    };
    require(
        name.size() <= longest_name && std::ranges::all_of(name, allowed) &&
            name.front() != '.' && name.front() != '-' && name.front() != ' ',
        where, fmt::format("the name {}", in_quotes(name)),
        fmt::format(
            "at most {} bytes of letters a to z, digits, blanks and _ - + = : , . ( ), a "
            "letter or a digit first",
            longest_name),
        "it names the run folder, runs/NAME; another place is --out's");
}

// Gmsh chooses its reader by the ending and runs the commands of a file FILE.opt beside
// FILE.
void check_mesh_file(const fs::path& file, const Origin& where) {
    require_regular_file(file, where);
    require(file.extension() == ".msh", where,
            fmt::format("the mesh file {}", in_quotes(file.string())),
            "the ending .msh, for Gmsh takes other endings for programs and archives");
    fs::path options = file;
    options += ".opt";
    std::error_code none;
    require(!fs::exists(fs::symlink_status(options, none)), where,
            fmt::format("{} beside the mesh", in_quotes(options.string())),
            "meshes without it: Gmsh would run the commands in it", "remove it");
}

}  // namespace

// Reading a pipe or a device could block or never end.
void require_regular_file(const fs::path& file, const Origin& where) {
    std::error_code none;
    const fs::file_status status = fs::status(file, none);
    if (!fs::exists(status)) return;  // reported by its reader
    require(fs::is_regular_file(status), where,
            fmt::format("{}, which is {}", in_quotes(file.string()),
                        fs::is_directory(status) ? "a folder" : "a pipe or a device"),
            "regular files");
    const std::uintmax_t bytes = fs::file_size(file, none);
    require(none || bytes <= largest_file_bytes, where,
            fmt::format("{} of {} bytes", in_quotes(file.string()), bytes),
            fmt::format("files of at most {} bytes", largest_file_bytes));
}

// The script runs with the user's rights, so that only a regular file with the ending .py
// is accepted.
void check_script(const fs::path& file, const Origin& where) {
    std::error_code none;
    require(fs::exists(fs::status(file, none)), where,
            fmt::format("no file {}", in_quotes(file.string())),
            "a Python file with a class Controller");
    require_regular_file(file, where);
    require(file.extension() == ".py", where,
            fmt::format("the script {}", in_quotes(file.string())), "the ending .py");
}

// Goes through all files that bodies, sources and obstacles name.
void check_files(const Scene& scene, const Marks& marks) {
    check_name(scene.name, marks.value({"name"}));
    for (const Body& body : scene.bodies) {
        if (const auto* mesh = std::get_if<MeshFile>(&body.mesh))
            check_mesh_file(mesh->file,
                            marks.value({"bodies", body.name, "mesh", "gmsh", "file"}));
        if (const auto* mesh = std::get_if<VoxelMesh>(&body.mesh))
            require_regular_file(
                mesh->file, marks.value({"bodies", body.name, "mesh", "voxels", "file"}));
        if (!body.magnetization) continue;
        if (const auto* table = std::get_if<TableMagnetization>(&*body.magnetization))
            require_regular_file(
                table->file,
                marks.value({"bodies", body.name, "magnetization", "table", "file"}));
    }
    if (scene.magnetic_field) {
        for (const FieldSource& source : scene.magnetic_field->sources) {
            if (const auto* grid = std::get_if<GridField>(&source.shape))
                require_regular_file(
                    grid->file, marks.value({"magnetic_field", "sources", source.name,
                                             "grid", "file"}));
        }
    }
    if (!scene.fluid) return;
    if (const auto& openfoam = scene.fluid->openfoam) {
        for (const auto& [key, file] : {std::pair{"schemes", openfoam->schemes},
                                        std::pair{"solution", openfoam->solution},
                                        std::pair{"functions", openfoam->functions}})
            if (file)
                require_regular_file(*file, marks.value({"fluid", "openfoam", key}));
    }
    for (const Obstacle& obstacle : scene.fluid->obstacles) {
        if (const auto* surface = std::get_if<StlSurface>(&obstacle.shape))
            require_regular_file(
                surface->file,
                marks.value({"fluid", "obstacles", obstacle.name, "stl", "file"}));
    }
}

std::vector<fs::path> files_of(const Scene& scene) {
    std::vector<fs::path> files;
    const auto add = [&](const std::string& file) { files.emplace_back(file); };
    for_each_named_file(scene, add);
    const auto add_rows = [&](const auto* table) {
        if (table && !table->source.empty()) add(table->source);
    };
    if (scene.magnetic_field) {
        if (scene.magnetic_field->uniform)
            add_rows(std::get_if<VectorTable>(&scene.magnetic_field->course));
        for (const FieldTerm& term : scene.magnetic_field->plus)
            add_rows(std::get_if<VectorTable>(&term.law));
    }
    for (const Boundary& side : scene.fluid.value_or(Fluid{}).boundaries)
        if (side.inlet.course) add_rows(std::get_if<InletTable>(&*side.inlet.course));
    for (fs::path& file : files) file = fs::weakly_canonical(fs::absolute(file));
    std::ranges::sort(files);
    const auto twice = std::ranges::unique(files);
    files.erase(twice.begin(), twice.end());
    return files;
}

std::vector<fs::path> files_elsewhere(const Scene& scene) {
    std::vector<fs::path> files = files_of(scene);
    const fs::path folder = fs::weakly_canonical(fs::absolute(scene.folder / "."));
    std::erase_if(files, [&](const fs::path& file) {
        return !file.lexically_relative(folder).string().starts_with("..");
    });
    return files;
}

}  // namespace magfsi::scene
