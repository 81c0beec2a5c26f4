// SPDX-License-Identifier: GPL-2.0-or-later
// Files that a scene names and leaves to its solvers: meshes, surfaces, grids, a body's
// table, scripts, dictionaries. Tables over time are read with the scene.
#pragma once

#include <string>
#include <variant>

#include "adapters/scene/scene.h"

namespace magfsi::scene {

// Calls use(name) for each grid of field values.
template <class Field, class Use>
void for_each_grid(Field& field, const Use& use) {
    for (auto& source : field.sources)
        if (auto* grid = std::get_if<GridField>(&source.shape)) use(grid->file);
}

// Calls use(name) for each name; scenes may be constant.
template <class SceneType, class Use>
void for_each_named_file(SceneType& scene, const Use& use) {
    for (auto& body : scene.bodies) {
        if (auto* mesh = std::get_if<MeshFile>(&body.mesh)) use(mesh->file);
        if (auto* mesh = std::get_if<VoxelMesh>(&body.mesh)) use(mesh->file);
        if (!body.magnetization) continue;
        if (auto* table = std::get_if<TableMagnetization>(&*body.magnetization))
            use(table->file);
    }
    if (scene.magnetic_field) for_each_grid(*scene.magnetic_field, use);
    if (scene.control) use(scene.control->script);
    if (!scene.fluid) return;
    for (auto& obstacle : scene.fluid->obstacles)
        if (auto* surface = std::get_if<StlSurface>(&obstacle.shape)) use(surface->file);
    if (!scene.fluid->openfoam) return;
    auto& openfoam = *scene.fluid->openfoam;
    for (auto* file : {&openfoam.schemes, &openfoam.solution, &openfoam.functions})
        if (*file) use(**file);
}

}  // namespace magfsi::scene
