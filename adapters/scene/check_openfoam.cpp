// What fluid.solver: openfoam cannot do, and its mesh.
#include <fmt/format.h>

#include "adapters/scene/checks.h"
#include "adapters/scene/names.h"
#include "adapters/scene/unit.h"

namespace magfsi::scene {

namespace {

void check_grading(const Fluid& fluid, const Marks& marks) {
    const auto& [lower, upper] = fluid.grading->uniform_m;
    for (std::size_t d = 0; d < 3; ++d) {
        if (lower[d] >= 0 && lower[d] < upper[d] && upper[d] <= fluid.box_m[d]) continue;
        refuse(
            marks.value({"fluid", "grading", "uniform"}),
            fmt::format("a uniform part from {} to {} along {}", format_si(lower[d], "m"),
                        format_si(upper[d], "m"), axis_names[d]),
            fmt::format("from 0 to the box's {}, in ascending order",
                        format_si(fluid.box_m[d], "m")));
    }
}

}  // namespace

void check_openfoam(const Scene& scene, const Marks& marks) {
    if (!scene.fluid) return;
    const Fluid& fluid = *scene.fluid;
    if (fluid.grading) check_grading(fluid, marks);
    if (fluid.solver != FluidSolver::openfoam) return;
    const auto not_there = [&](const Origin& where, const char* what) {
        refuse(where, fmt::format("{} with fluid.solver openfoam", what),
               "only with the solver lbm", "set solver: lbm, or leave it out");
    };
    if (!fluid.obstacles.empty())
        not_there(marks.key({"fluid", "obstacles"}), "obstacles");
    if (fluid.smagorinsky_constant > 0)
        not_there(marks.key({"fluid", "smagorinsky"}), "smagorinsky");
    if (fluid.taylor_green)
        not_there(marks.key({"fluid", "taylor_green"}), "the Taylor-Green vortex");
    for (std::size_t face = 0; face < 6; ++face) {
        const Boundary& side = fluid.boundaries[face];
        if (side.kind == BoundaryKind::pressure_outlet && side.patch)
            not_there(
                marks.value({"fluid", "boundaries", std::string(names<Face>[face])}),
                "an outlet over a part of its side");
    }
}

}  // namespace magfsi::scene
