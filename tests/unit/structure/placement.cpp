// Where a body starts: its relaxed shape, turned and moved.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "structure/equilibrium/newton.h"
#include "structure/lammps/field_program.h"
#include "structure/lammps/placement.h"
#include "structure/magnetics/magnetization.h"
#include "tests/unit/structure/elements.h"

namespace magfsi::structure {
namespace {

constexpr double pi = std::numbers::pi;

Body strip() {
    Body body;
    body.name = "strip";
    body.mesh = box_mesh({{3.7e-3, 1.5e-3, 0.185e-3}, {20, 8, 2}});
    body.material = test::soft_material();
    body.element = ElementVariant::mean_f;
    body.magnetization_a_m =
        harmonic_magnetization(body.mesh, {62e3, 3.7e-3, pi / 4, 0, 2});
    return body;
}

TEST(Placement, TurnsAndMovesTheCentreOfVolume) {
    const Body body = strip();
    Placement placement;
    placement.rotation = PlaneRotation{{0, 2}, pi / 2};
    placement.position_m = Vec3{8e-3, 4e-3, 5e-3};
    const auto nodes = placed_nodes(body, placement, {0, 2});
    // The length now points along z: the first node, at (-L/2, -w/2, -h/2) of the centre,
    // comes to (h/2, -w/2, -L/2).
    EXPECT_NEAR(nodes[0][0], 8e-3 + 0.0925e-3, 1e-15);
    EXPECT_NEAR(nodes[0][1], 4e-3 - 0.75e-3, 1e-15);
    EXPECT_NEAR(nodes[0][2], 5e-3 - 1.85e-3, 1e-15);
}

TEST(Placement, KeepsTheCentreOfARelaxedFreeBody) {
    const Body body = strip();
    const auto nodes = relaxed_shape(body, field_vector({17e-3, 255 * pi / 180}, {0, 2}));
    const double thirds[3] = {0.5 * 3.7e-3, 0.5 * 1.5e-3, 0.5 * 0.185e-3};
    for (int d = 0; d < 3; ++d) {
        double moment = 0;
        double mass = 0;
        for (const Hexahedron& element : body.mesh.elements) {
            for (int node : element) {
                moment += nodes[node][d];
                mass += 1;
            }
        }
        EXPECT_NEAR(moment / mass, thirds[d], 1e-12);  // 1e-9 of the length
    }
}

// Held along y by rollers, the strip still turns and bends in the x-z plane as the free
// one does.
TEST(Placement, RelaxesOnRollers) {
    Body body = strip();
    body.material.lame_lambda_pa = 1e-3 * body.material.shear_modulus_pa;  // no Poisson
    const Vec3 field = field_vector({5e-3, 270 * pi / 180}, {0, 2});
    const auto free = relaxed_shape(body, field);
    body.rollers = {{{"y_min"}, 1}, {{"y_max"}, 1}};
    const auto held = relaxed_shape(body, field);
    for (std::size_t n = 0; n < free.size(); ++n) {
        EXPECT_NEAR(held[n][0], free[n][0], 0.02 * 3.7e-3);
        EXPECT_NEAR(held[n][2], free[n][2], 0.02 * 3.7e-3);
    }
    for (const char* face : {"y_min", "y_max"}) {
        for (int node : body.mesh.faces.at(face)) {
            EXPECT_EQ(held[node][1], body.mesh.nodes[node][1]);
        }
    }
}

TEST(Placement, NamesTheBodyThatFindsNoRelaxedShape) {
    Body body = strip();
    body.mesh = box_mesh({{3.7e-3, 1.5e-3, 0.185e-3}, {6, 2, 2}});
    body.magnetization_a_m =
        harmonic_magnetization(body.mesh, {62e3, 3.7e-3, pi / 4, 0, 2});
    try {
        relaxed_shape(body, {0, 0, 500.0});
        FAIL() << "nothing thrown";
    } catch (const std::runtime_error& error) {
        const std::string what = error.what();
        EXPECT_EQ(what.find("body strip: no equilibrium at 1 of the load"), 0u) << what;
        EXPECT_NE(what.find("relaxed in the field (0, 0, 500) T"), std::string::npos)
            << what;
    }
}

}  // namespace
}  // namespace magfsi::structure
