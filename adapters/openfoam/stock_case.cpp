#include "adapters/openfoam/stock_case.h"

#include <fmt/format.h>

#include "adapters/openfoam/case_files.h"
#include "adapters/openfoam/inlet.h"
#include "adapters/openfoam/scene_to_mesh.h"
#include "adapters/scene/keys.h"

namespace magfsi::openfoam {

namespace {

// Corners in blockMesh's order, and the sides by them, seen from outside.
constexpr std::array<std::array<int, 3>, 8> corners = {{{0, 0, 0},
                                                        {1, 0, 0},
                                                        {1, 1, 0},
                                                        {0, 1, 0},
                                                        {0, 0, 1},
                                                        {1, 0, 1},
                                                        {1, 1, 1},
                                                        {0, 1, 1}}};
constexpr std::array<const char*, 6> sides = {"(0 4 7 3)", "(1 2 6 5)", "(0 1 5 4)",
                                              "(3 7 6 2)", "(0 3 2 1)", "(4 5 6 7)"};

// One section a cell, each of its own length: whatever the grading is.
std::string widths(const std::vector<double>& planes_m) {
    std::string text = "(";
    for (std::size_t i = 1; i < planes_m.size(); ++i)
        text += fmt::format("({:.17g} 1 1)", planes_m[i] - planes_m[i - 1]);
    return text + ")";
}

std::string side_entry(const scene::Fluid& fluid, std::size_t side) {
    const auto& names = scene::names<scene::Face>;
    std::string type = "type patch;";
    switch (fluid.boundaries[side].kind) {
        case fluid::BoundaryKind::periodic:
            type = fmt::format("type cyclic; neighbourPatch {};", names[side ^ 1]);
            break;
        case fluid::BoundaryKind::no_slip:
            type = "type wall;";
            break;
        case fluid::BoundaryKind::free_slip:
            type = "type symmetryPlane;";
            break;
        case fluid::BoundaryKind::velocity_inlet:
        case fluid::BoundaryKind::pressure_outlet:
            break;
    }
    return fmt::format("    {} {{ {} faces ({}); }}\n", names[side], type, sides[side]);
}

std::string block_mesh(const scene::Fluid& fluid, const BoxMesh& mesh) {
    std::string text = "scale 1;\nvertices\n(\n";
    for (const auto& corner : corners) {
        text += "    (";
        for (std::size_t d = 0; d < 3; ++d)
            text += fmt::format(" {:.17g}", corner[d] * mesh.planes_m[d].back());
        text += " )\n";
    }
    const auto n = mesh_cells(mesh);
    text += fmt::format(
        ");\nblocks\n(\n    hex (0 1 2 3 4 5 6 7) ({} {} {}) simpleGrading\n    "
        "(\n        {}\n        {}\n        {}\n    )\n);\nedges ();\nboundary\n(\n",
        n[0], n[1], n[2], widths(mesh.planes_m[0]), widths(mesh.planes_m[1]),
        widths(mesh.planes_m[2]));
    for (std::size_t side = 0; side < 6; ++side) text += side_entry(fluid, side);
    return text + ");\nmergePatchPairs ();\n";
}

std::string body_force(const scene::Fluid& fluid) {
    scene::Vec3 a = *fluid.body_force_n_m3;
    for (double& component : a) component /= fluid.density_kg_m3;
    return fmt::format(
        "bodyForce\n{{\n    type vectorSemiImplicitSource;\n    "
        "selectionMode all;\n    volumeMode specific;\n    "
        "injectionRateSuSp {{ U (({:.17g} {:.17g} {:.17g}) 0); }}\n}}\n",
        a[0], a[1], a[2]);
}

}  // namespace

void complete_case(const std::filesystem::path& folder, const scene::Fluid& fluid,
                   const BoxMesh& mesh) {
    write_foam_file(folder, "system", "blockMeshDict", "dictionary",
                    block_mesh(fluid, mesh));
    if (fluid.body_force_n_m3)
        write_foam_file(folder, "constant", "fvOptions", "dictionary", body_force(fluid));
    write_velocity(folder, fluid, [&](std::size_t side) {
        return inlet_condition(fluid, mesh, static_cast<int>(side));
    });
}

void clear_stock_case(const std::filesystem::path& folder) {
    std::filesystem::remove_all(folder / "constant" / "polyMesh");
    std::filesystem::remove(folder / "constant" / "fvOptions");
}

}  // namespace magfsi::openfoam
