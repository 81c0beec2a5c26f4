// SPDX-License-Identifier: GPL-2.0-or-later
// The error of a block of more than 750 elements is told from coarser ones, against the
// error that it has.
#include "adapters/solvers/bodies/mesh_estimate.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <fstream>

#include "adapters/solvers/bodies/scene_to_body.h"
#include "structure/equilibrium/mesh_error.h"
#include "tests/support/checks.h"

namespace magfsi::bodies {
namespace {

scene::Body beam(structure::ElementVariant variant, const std::array<int, 3>& elements) {
    scene::Body body;
    body.name = "beam";
    body.mesh = structure::Box{{17.5e-3, 5e-3, 1e-3}, elements};
    body.material = {330e3, 6600e3, 1860};
    body.element = variant;
    body.clamps = {"x_min"};
    return body;
}

double tip_m(const scene::Body& body) {
    double lowest = 0;
    for (const auto& u : structure::linear_response(to_body(body), {{}, {0, 0, -1}}))
        lowest = std::min(lowest, u[2]);
    return lowest;
}

TEST(MeshEstimate, OfAFineBlockIsTheErrorThatItHas) {
    using enum structure::ElementVariant;
    scene::Scene scene;
    const double exact_m = tip_m(beam(assumed_strain, {70, 20, 4}));
    for (const auto& [variant, elements] :
         {std::pair{full, std::array{36, 11, 2}}, std::pair{full, std::array{70, 12, 1}},
          std::pair{assumed_strain, std::array{33, 9, 3}}}) {
        const scene::Body body = beam(variant, elements);
        const auto estimate = estimate_mesh_error(scene, body, to_body(body));
        ASSERT_EQ(estimate.not_made, "");
        const double real = tip_m(body) / exact_m - 1;
        std::printf("%d x %d x %d: told %+.4f, is %+.4f\n", elements[0], elements[1],
                    elements[2], estimate.largest, real);
        // The same as where the mesh is refined (tests/unit/structure/mesh_error.cpp).
        EXPECT_NEAR((1 + estimate.largest) / (1 + real), 1, 0.03);
    }
}

// Of a mesh that cannot be made coarser, what the element does is told.
TEST(MeshEstimate, OfAFineMeshFromAFileIsWhatItsElementDoes) {
    using enum structure::ElementVariant;
    scene::Scene scene;
    const double exact_m = tip_m(beam(assumed_strain, {70, 20, 4}));
    for (const auto& elements : {std::array{70, 12, 1}, std::array{36, 11, 2}}) {
        scene::Body body = beam(full, elements);
        const structure::Body solid = to_body(body);
        const double real = tip_m(body) / exact_m - 1;
        body.mesh = structure::MeshFile{};
        const auto estimate = estimate_mesh_error(scene, body, solid);
        ASSERT_EQ(estimate.not_made, "");
        std::printf("%d x %d x %d: told %+.4f, is %+.4f\n", elements[0], elements[1],
                    elements[2], estimate.largest, real);
        // What assumed_strain leaves on these meshes: 1 to 3 %, at the clamp.
        EXPECT_NEAR((1 + estimate.largest) / (1 + real), 1, 0.04);
    }
}

// A table has rows for the body's own elements alone; equal ones are a uniform body.
TEST(MeshEstimate, OfATableOfMagnetizationIsThatOfItsBody) {
    scene::Scene scene;
    scene.time.end_s = 1;
    scene.magnetic_field.emplace();
    scene.magnetic_field->course = scene::VectorField{{0, 0, 1e-3}};
    const test::TemporaryFolder folder;
    const auto file = folder / "rows.csv";
    for (const std::array<int, 3> elements :
         {std::array{8, 3, 1}, std::array{36, 11, 2}}) {
        scene::Body table = beam(structure::ElementVariant::full, elements);
        std::ofstream rows(file);
        rows << "Mx[A/m],My[A/m],Mz[A/m]\n";
        for (int e = 0; e < elements[0] * elements[1] * elements[2]; ++e)
            rows << "62000,0,0\n";
        rows.close();
        scene::Body uniform = table;
        table.magnetization = structure::TableMagnetization{file.string()};
        uniform.magnetization = structure::UniformMagnetization{{62e3, 0, 0}};
        const auto told = estimate_mesh_error(scene, table, to_body(table));
        const auto same = estimate_mesh_error(scene, uniform, to_body(uniform));
        ASSERT_EQ(told.not_made, "");
        // The coarse one is refined in both; the fine one's reference is its own mesh.
        EXPECT_NEAR(told.largest, same.largest, elements[0] == 8 ? 1e-9 : 0.04);
        EXPECT_GT(std::abs(told.largest), 0.01);  // an error there is, on both
    }
}

TEST(MeshEstimate, OfMeshesThatTakeLongIsNotMadeAndSaysSo) {
    using enum structure::ElementVariant;
    scene::Scene scene;
    const scene::Body block = beam(assumed_strain, {100, 20, 4});
    scene::Body other = beam(assumed_strain, {36, 11, 2});
    const structure::Body solid = to_body(other);
    other.mesh = structure::MeshFile{};
    EXPECT_EQ(estimate_mesh_error(scene, block, to_body(block)).not_made,
              "more than 6000 elements: compare with a run on elements half or twice as "
              "large");
    EXPECT_EQ(estimate_mesh_error(scene, other, solid).not_made,
              "more than 750 elements that are no block, or have a table of "
              "magnetization: compare with a run on elements "
              "half or twice as large");
}

}  // namespace
}  // namespace magfsi::bodies
