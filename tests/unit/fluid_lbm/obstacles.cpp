// SPDX-License-Identifier: GPL-2.0-or-later
// Obstacles: the force on them, the cells in them, and bodies from files.
#include <unistd.h>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <numbers>

#include "fluid_lbm/obstacle/solid.h"
#include "tests/support/stl_surfaces.h"
#include "tests/unit/fluid_lbm/lattice_fluid.h"

namespace magfsi::fluid {
namespace {

// ---- The forces on obstacles are, step by step, exactly the momentum that the fluid
// loses, in a closed periodic box, for every shape; also when an obstacle stands on a
// plane of symmetry or reaches through a periodic side.

struct Body {
    const char* name;
    ObstacleShape shape;
    bool symmetry;  // free slip at both ends of z
};

void expect_momentum_kept(const Body& c, double relaxation_time) {
    FluidConfig config =
        lattice_fluid({14, 12, 10}, relaxation_time, Collision::automatic);
    if (c.symmetry) {
        config.boundaries[4].kind = config.boundaries[5].kind = BoundaryKind::free_slip;
    }
    config.obstacles = {{"body", c.shape}, {"ball", Sphere{{11, 3, 3}, 3.3}}};
    config.initial_velocity = [](const Vec3& x) {
        return Vec3{0.05 + 0.01 * std::sin(x[1]), 0.02 * std::cos(x[0]), 0.01};
    };
    Fluid fluid(MPI_COMM_WORLD, config);
    const int conserved = c.symmetry ? 2 : 3;  // axes; free slip takes momentum along z
    double largest = 0;
    for (int step = 0; step < 40; ++step) {
        const Vec3 before = fluid.totals().momentum_kg_m_s;
        fluid.step();
        const Vec3 after = fluid.totals().momentum_kg_m_s;
        const std::vector<Vec3> force = fluid.obstacle_forces();
        ASSERT_EQ(force.size(), 2u);
        for (int a = 0; a < conserved; ++a) {
            const double sum = force[0][a] + force[1][a];
            largest = std::max(largest, std::abs(sum));
            // Rounding of sums over 1680 cells of about 0.05 each.
            EXPECT_NEAR(sum, before[a] - after[a], 1e-12) << "step " << step;
        }
    }
    EXPECT_GT(largest, 0.01);  // there is something to compare
}

class Force : public testing::TestWithParam<Body> {};

TEST_P(Force, IsTheMomentumThatTheFluidLoses) {
    expect_momentum_kept(GetParam(), 0.6);
    expect_momentum_kept(GetParam(), 0.52);
}

INSTANTIATE_TEST_SUITE_P(
    Shapes, Force,
    testing::Values(Body{"Sphere", Sphere{{5.3, 6.1, 5.2}, 5.1}, false},
                    Body{"CylinderX", Cylinder{{5, 7.1, 7.2}, 3.3, 0, 4.0}, false},
                    Body{"CylinderY", Cylinder{{5.1, 0, 5.2}, 4.3, 1, {}}, false},
                    Body{"CylinderZ", Cylinder{{5.1, 5.4, 0}, 4.3, 2, {}}, false},
                    Body{"Block", Block{{3.2, 4.1, 4.6}, {6.3, 7.7, 7.9}}, false},
                    Body{"AcrossPeriodicSide", Block{{-1, -1, 6}, {3.3, 3.2, 9}}, false},
                    Body{"HalfSphereOnSymmetry", Sphere{{5.3, 6.1, 0}, 5.1}, true},
                    Body{"CylinderBetweenSymmetries", Cylinder{{5, 6, 5}, 4.4, 2, {}},
                         true}),
    [](const auto& shape) { return std::string(shape.param.name); });

// ---- Cells in an obstacle stay at rest whatever pushes them: no velocity, no vorticity,
// no share in mass, energy or the check of the cells.

bool in_block(const std::array<int, 3>& cell) {
    return cell[0] >= 4 && cell[0] < 9 && cell[1] >= 3 && cell[1] < 6 && cell[2] < 4;
}

FluidConfig pushed_around_a_block() {
    FluidConfig config = lattice_fluid({12, 9, 8}, 0.6, Collision::automatic);
    set_walls(config, 2);
    config.obstacles = {{"block", Block{{4, 3, -1}, {9, 6, 4}}}};
    config.body_force_n_m3 = Vec3{1e-4, 2e-5, 0};
    config.initial_velocity = [](const Vec3&) { return Vec3{0.05, 0.01, 0.02}; };
    return config;
}

TEST(ObstacleCells, AreAtRest) {
    const FluidConfig config = pushed_around_a_block();
    Fluid fluid(MPI_COMM_WORLD, config);
    for (int step = 0; step < 30; ++step) {
        for_each_velocity(fluid, [&](const std::array<int, 3>& cell, const Vec3& u) {
            const double squared = u[0] * u[0] + u[1] * u[1] + u[2] * u[2];
            if (in_block(cell)) {
                EXPECT_EQ(squared, 0) << "step " << step;
            } else {
                EXPECT_GT(squared, 0) << "step " << step;
            }
        });
        fluid.step();
        EXPECT_FALSE(fluid.diverged());
    }
}

TEST(ObstacleCells, HaveNoMassAndNoVorticity) {
    FluidConfig config = pushed_around_a_block();
    config.initial_velocity = nullptr;
    Fluid fluid(MPI_COMM_WORLD, config);
    EXPECT_EQ(fluid.totals().mass_kg, 12 * 9 * 8 - 5 * 3 * 4);
    advance(fluid, 20);
    std::vector<float> curl(3 * 12 * all_rows(fluid).size());
    fluid.vorticity(curl);
    std::size_t i = 0;
    double largest = 0;
    for_each_velocity(fluid, [&](const std::array<int, 3>& cell, const Vec3&) {
        for (int a = 0; a < 3; ++a, ++i) {
            if (in_block(cell)) {
                EXPECT_EQ(curl[i], 0);
            }
            largest = std::max(largest, std::abs(static_cast<double>(curl[i])));
        }
    });
    EXPECT_GT(largest, 1e-4);  // u / h = 20 * 1e-4 / 4: the fluid moves
}

TEST(ObstacleCells, MustExist) {
    FluidConfig config = lattice_fluid({12, 9, 8}, 0.6, Collision::automatic);
    config.obstacles = {{"grain", Sphere{{5, 5, 5}, 0.5}}};
    expect_refused([&] { Fluid(MPI_COMM_WORLD, config); },
                   "\"grain\" holds the centre of no cell");
    config.obstacles = {{"half", Block{{0, 0, 0}, {6, 9, 8}}},
                        {"rest", Block{{6, 0, 0}, {12, 9, 8}}}};
    expect_refused([&] { Fluid(MPI_COMM_WORLD, config); }, "leave no cell of fluid");
}

TEST(ObstacleCells, AreNotBesideMoreCellsThanALinkCanName) {
    FluidConfig config = lattice_fluid({32768, 2, 2}, 0.6, Collision::automatic);
    config.obstacles = {{"ball", Sphere{{5, 1, 1}, 0.9}}};
    expect_refused([&] { Fluid(MPI_COMM_WORLD, config); }, "at most 32767");
}

// 4/3 pi r^3 of cells, through the periodic sides or not.
TEST(ObstacleCells, FillTheSphere) {
    FluidConfig config = lattice_fluid({24, 24, 24}, 0.6, Collision::automatic);
    config.obstacles = {{"ball", Sphere{{12.3, 11.8, 12.1}, 18}}};
    Fluid fluid(MPI_COMM_WORLD, config);
    const double solid = 24 * 24 * 24 - fluid.totals().mass_kg;
    // Cells on the surface, 4 pi r^2, count whole or not at all: sqrt(1018) / 2 at
    // random.
    EXPECT_NEAR(solid, std::numbers::pi / 6 * 18 * 18 * 18, 32);
}

// ---- A body from an STL file, ASCII or binary, is the same body as the analytic one,
// even with rays through its edges and corners; a file that is cut or open is refused.

using Triangle = std::array<Vec3, 3>;

// The twelve triangles of a block, outward.
std::vector<Triangle> block_surface(const Vec3& lo, const Vec3& hi) {
    const auto corner = [&](int i) {
        return Vec3{(i & 1 ? hi : lo)[0], (i & 2 ? hi : lo)[1], (i & 4 ? hi : lo)[2]};
    };
    const int faces[6][4] = {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4},
                             {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}};
    std::vector<Triangle> triangles;
    for (const auto& f : faces) {
        triangles.push_back({corner(f[0]), corner(f[1]), corner(f[2])});
        triangles.push_back({corner(f[0]), corner(f[2]), corner(f[3])});
    }
    return triangles;
}

class StlFile : public testing::Test {
  protected:
    void write_binary(const std::vector<Triangle>& triangles) {
        std::ofstream out(path_, std::ios::binary);
        char header[80] = "solid, though it is binary";
        out.write(header, sizeof header);
        const auto count = static_cast<std::uint32_t>(triangles.size());
        out.write(reinterpret_cast<const char*>(&count), sizeof count);
        for (const Triangle& t : triangles) {
            float numbers[12] = {};
            for (int i = 0; i < 9; ++i)
                numbers[3 + i] = static_cast<float>(t[i / 3][i % 3]);
            const std::uint16_t attribute = 0;
            out.write(reinterpret_cast<const char*>(numbers), sizeof numbers);
            out.write(reinterpret_cast<const char*>(&attribute), sizeof attribute);
        }
    }

    void refuses(const std::string& wanted) const {
        expect_refused(
            [&] {
                make_solid(StlSurface{path_.string(), 1, {}}, 1, {10, 10, 10});
            },
            wanted);
    }

    const test::TemporaryFolder folder_;  // of each rank
    const std::filesystem::path path_ = folder_ / "part.stl";
};

std::vector<char> cells_of(const Solid& solid) {
    std::vector<char> all;
    for (int z = 0; z < 10; ++z) {
        for (int y = 0; y < 10; ++y) {
            std::vector<char> row(10);
            solid.mark_row(y + 0.5, z + 0.5, 0, row);
            all.insert(all.end(), row.begin(), row.end());
        }
    }
    return all;
}

// In half metres, so that scale and shift are tested: file 2 (x - 1).
std::vector<Triangle> in_file_units(std::vector<Triangle> triangles) {
    for (Triangle& t : triangles) {
        for (Vec3& x : t) {
            for (double& component : x) component = 2 * (component - 1);
        }
    }
    return triangles;
}

void expect_same_as_block(const std::filesystem::path& file) {
    // Diagonals of the faces pass through centres of cells: rays meet edges.
    const Vec3 low{2, 3, 1}, high{7, 8, 6};
    const auto stl =
        make_solid(StlSurface{file.string(), 0.5, {1, 1, 1}}, 1, {10, 10, 10});
    const auto block = make_solid(Block{low, high}, 1, {10, 10, 10});
    EXPECT_EQ(cells_of(*stl), cells_of(*block));
    // Links in all directions into the corner cell at (2, 3, 1).
    const Vec3 inside{2.5, 3.5, 1.5};
    for (const Vec3& outside : {Vec3{1.5, 3.5, 1.5}, Vec3{1.5, 2.5, 1.5},
                                Vec3{2.5, 2.5, 0.5}, Vec3{2.5, 3.5, 0.5}}) {
        // The exact value is 1/2; bisection and intersection round differently.
        EXPECT_NEAR(stl->entry(outside, inside), 0.5, 1e-12);
        EXPECT_NEAR(block->entry(outside, inside), 0.5, 1e-12);
    }
}

TEST_F(StlFile, AsciiIsTheBlock) {
    magfsi::test::write_stl(path_, in_file_units(block_surface({2, 3, 1}, {7, 8, 6})));
    expect_same_as_block(path_);
}

TEST_F(StlFile, BinaryIsTheBlock) {
    write_binary(in_file_units(block_surface({2, 3, 1}, {7, 8, 6})));
    expect_same_as_block(path_);
}

// By winding numbers: cells and links are those of the union, which even-odd counting
// would make hollow where the parts overlap or are given twice.
TEST_F(StlFile, PartsThatOverlapAreTheirUnion) {
    auto parts = block_surface({2, 3, 1}, {5, 8, 6});
    for (const auto& more :
         {block_surface({4, 3, 1}, {7, 8, 6}), block_surface({2, 3, 1}, {5, 8, 6}),
          block_surface({3, 4, 2}, {6, 7, 5})})
        parts.insert(parts.end(), more.begin(), more.end());
    write_binary(in_file_units(parts));
    expect_same_as_block(path_);
    const FluidConfig empty = lattice_fluid({10, 10, 10}, 0.6, Collision::automatic);
    const auto mass = [&](const ObstacleShape& shape) {
        FluidConfig config = empty;
        config.obstacles = {{"body", shape}};
        return Fluid(MPI_COMM_WORLD, config).totals().mass_kg;
    };
    EXPECT_DOUBLE_EQ(mass(StlSurface{path_.string(), 0.5, {1, 1, 1}}),
                     mass(Block{{2, 3, 1}, {7, 8, 6}}));
}

TEST_F(StlFile, OpenSurfaceIsRefused) {
    auto triangles = block_surface({2, 3, 1}, {7, 8, 6});
    triangles.pop_back();
    magfsi::test::write_stl(path_, triangles);
    refuses("3 edges that do not join two triangles");
}

TEST_F(StlFile, CutBinaryFileIsRefused) {
    write_binary(block_surface({2, 3, 1}, {7, 8, 6}));
    std::filesystem::resize_file(path_, 84 + 50 * 12 - 7);
    refuses("50 bytes per triangle");  // begins with "solid," and is no ASCII
}

TEST_F(StlFile, CutAsciiFileIsRefused) {
    std::ofstream(path_) << "solid a\nfacet\nouter loop\nvertex 0 0 0\nvertex 1 0 0\n";
    refuses("ends inside a triangle");
}

TEST_F(StlFile, OtherFilesAreRefused) {
    std::ofstream(path_) << "PLY and so on";
    refuses("neither begins with \"solid\"");
}

}  // namespace
}  // namespace magfsi::fluid
