#include "adapters/bodies/body_mesh.h"

#include <fmt/format.h>

#include <stdexcept>

#include "adapters/bodies/converted_mesh.h"
#include "structure/mesh/mesh.h"
#include "structure/mesh/block_mesh.h"
#include "structure/mesh/locate.h"

namespace magfsi::bodies {

namespace {

structure::Mesh build(const structure::Box& mesh) {
    return structure::box_mesh(mesh);
}

structure::Mesh build(const structure::ObliquePlate& mesh) {
    return structure::oblique_mesh(mesh);
}

structure::Mesh build(const structure::MeshFile& mesh) {
    return converted_gmsh_mesh(mesh.file, mesh.unit_m);
}

}  // namespace

structure::Mesh to_mesh(const scene::Body& body) {
    try {
        return std::visit([](const auto& mesh) { return build(mesh); }, body.mesh);
    } catch (const std::invalid_argument& fault) {
        throw std::invalid_argument(
            fmt::format("body '{}': {}", body.name, fault.what()));
    }
}

double extent(const structure::Mesh& mesh, int axis) {
    const structure::Bounds box = structure::bounds(mesh.nodes);
    const auto d = static_cast<std::size_t>(axis);
    return box.high_m[d] - box.low_m[d];
}

structure::MaterialPoint locate(const scene::Body& body, const structure::Mesh& mesh,
                                const structure::Vec3& at_m) {
    if (const auto* box = std::get_if<structure::Box>(&body.mesh))
        return structure::locate(*box, at_m);
    // A point typed to a few digits may lie just outside of a slanted face.
    constexpr double tolerance = 1e-3;  // of an element
    const auto found = structure::PointLocator(mesh).find(at_m, tolerance);
    if (found) return *found;
    throw std::invalid_argument(
        fmt::format("body '{}': the point ({:.6g}, {:.6g}, {:.6g}) mm lies in no element "
                    "of its mesh",
                    body.name, at_m[0] * 1e3, at_m[1] * 1e3, at_m[2] * 1e3));
}

}  // namespace magfsi::bodies
