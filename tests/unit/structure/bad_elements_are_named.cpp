#include <gtest/gtest.h>

#include "structure/lattice/lattice.h"
#include "tests/unit/structure/elements.h"

namespace magfsi::structure {
namespace {

std::string message(const Mesh& mesh, ElementVariant variant) {
    try {
        build_lattice(mesh.nodes, mesh.elements, {test::soft_material()}, {}, variant);
    } catch (const std::invalid_argument& error) {
        return error.what();
    }
    return "nothing thrown";
}

TEST(BadElements, AnInvertedElementIsNamed) {
    Mesh mesh = box_mesh({{4e-4, 2e-4, 1e-4}, {4, 2, 1}});
    std::swap(mesh.elements[5][0], mesh.elements[5][1]);
    EXPECT_NE(
        message(mesh, ElementVariant::full).find("element 5 of the mesh is inverted"),
        std::string::npos);
}

TEST(BadElements, AFoldedCornerIsFoundThoughTheVolumeIsPositive) {
    Mesh mesh = box_mesh({{1e-4, 1e-4, 1e-4}, {1, 1, 1}});
    for (double& coordinate : mesh.nodes[7]) coordinate -= 0.75e-4;
    EXPECT_NE(message(mesh, ElementVariant::full).find("at its corner 7"),
              std::string::npos);
}

TEST(BadElements, ANodeThatTheMeshLacksIsNamed) {
    Mesh mesh = box_mesh({{1e-4, 1e-4, 1e-4}, {1, 1, 1}});
    mesh.elements[0][3] = 8;
    EXPECT_EQ(message(mesh, ElementVariant::full),
              "element 0 names node 8, but the mesh has nodes 0 to 7");
}

TEST(BadElements, MeanFWithAShortInPlaneEdgeIsRefusedWithAdvice) {
    const Mesh mesh = box_mesh({{8e-4, 2e-4, 1e-4}, {16, 2, 1}});
    EXPECT_NE(message(mesh, ElementVariant::mean_f).find("use element assumed_strain"),
              std::string::npos);
    EXPECT_EQ(message(mesh, ElementVariant::full), "nothing thrown");
    EXPECT_EQ(message(mesh, ElementVariant::assumed_strain), "nothing thrown");
}

TEST(BadElements, MeanFTakesFlatElementsInAnyDirection) {
    for (const Box& box :
         {Box{{8e-4, 4e-4, 1e-4}, {4, 2, 1}}, Box{{1e-4, 8e-4, 4e-4}, {1, 4, 2}},
          Box{{8e-4, 2e-4, 2e-4}, {4, 2, 2}}}) {
        EXPECT_EQ(message(box_mesh(box), ElementVariant::mean_f), "nothing thrown");
    }
}

}  // namespace
}  // namespace magfsi::structure
