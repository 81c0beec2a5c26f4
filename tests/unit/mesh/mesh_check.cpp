#include "structure/mesh/mesh_check.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "structure/mesh/block_mesh.h"
#include "structure/mesh/body_points.h"
#include "tests/unit/structure/elements.h"

namespace magfsi::structure {
namespace {

TEST(MeshCheck, UnusedNodesGoAndNamesFollow) {
    Mesh mesh = box_mesh({{3, 1, 1}, {3, 1, 1}});
    mesh.elements.erase(mesh.elements.begin());  // the nodes of x = 0 are free
    mesh.centre_line.clear();
    mesh.points["end"] = {3};
    EXPECT_EQ(drop_unused_nodes(mesh), 4);
    EXPECT_EQ(mesh.nodes.size(), 12U);
    EXPECT_TRUE(mesh.faces.at("x_min").empty());
    EXPECT_EQ(mesh.nodes[mesh.points.at("end")[0]], (Vec3{3, 0, 0}));
    EXPECT_NEAR(volume_m3(mesh), 2, 1e-14);
}

TEST(MeshCheck, CoincidentNodesAreFoundAcrossCellsOfTheSearch) {
    test::Random random(2);
    const double tolerance = 1e-3;
    for (int trial = 0; trial < 200; ++trial) {
        Mesh mesh = box_mesh({{1, 1, 1}, {3, 3, 3}});
        const int node = static_cast<int>(random.within(0, 63.99));
        Vec3 twin = mesh.nodes[node];
        const double step = tolerance * random.within(-1, 1) * 0.57;  // below 1/sqrt(3)
        for (double& x : twin) x += step;
        mesh.nodes.push_back(twin);
        const auto found = coincident_nodes(mesh, tolerance);
        ASSERT_TRUE(found);
        EXPECT_EQ(*found, (std::array{node, 64}));
        mesh.nodes.back()[0] += 3 * tolerance;
        EXPECT_FALSE(coincident_nodes(mesh, tolerance));
    }
}

TEST(MeshCheck, PartsAndTwinsAreCounted) {
    Mesh mesh = box_mesh({{5, 1, 1}, {5, 1, 1}});
    EXPECT_FALSE(duplicate_elements(mesh));
    mesh.elements.erase(mesh.elements.begin() + 2);
    EXPECT_EQ(connected_parts(mesh), (std::vector<int>{0, 0, 1, 1}));
    mesh.elements.push_back(mesh.elements[1]);
    EXPECT_EQ(*duplicate_elements(mesh), (std::array{1, 4}));
    EXPECT_THROW(refuse_broken_mesh(mesh), std::invalid_argument);
}

// All 48 numberings of a distorted brick, mirrored ones too, lead to the same one.
TEST(Orientation, AnyNumberingOfABrickIsTurnedToTheBlocksOwn) {
    const Mesh mesh = test::distorted_block({{3, 2, 1}, {1, 1, 1}}, 0.1, 7);
    std::array<int, 3> axis{0, 1, 2};
    int tried = 0;
    do {
        for (int flips = 0; flips < 8; ++flips) {
            Hexahedron turned{};
            for (int a = 0; a < 8; ++a) {
                int to = 0;
                for (int d = 0; d < 3; ++d)
                    to |= (((a >> d) & 1) ^ ((flips >> d) & 1)) << axis[d];
                turned[to] = mesh.elements[0][a];
            }
            EXPECT_EQ(oriented(mesh.nodes, turned), mesh.elements[0]);
            ++tried;
        }
    } while (std::next_permutation(axis.begin(), axis.end()));
    EXPECT_EQ(tried, 48);
}

}  // namespace
}  // namespace magfsi::structure
