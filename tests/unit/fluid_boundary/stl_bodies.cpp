// A body from an STL file, ASCII or binary, is the same body as the analytic one, even
// with rays through its edges and corners; a file that is cut or open is refused.
#include <gtest/gtest.h>

#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>

#include "fluid_lbm/obstacle/solid.h"
#include "fluid_lbm/obstacle/stl.h"

namespace magfsi::fluid {
namespace {

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
    void SetUp() override {
        path_ = std::filesystem::temp_directory_path() /
                (std::string("magfsi_") +
                 testing::UnitTest::GetInstance()->current_test_info()->name() + ".stl");
    }
    void TearDown() override { std::filesystem::remove(path_); }

    void write_ascii(const std::vector<Triangle>& triangles) {
        std::ofstream out(path_);
        out << "solid part\n";
        for (const Triangle& t : triangles) {
            out << "facet normal 0 0 0\nouter loop\n";
            for (const auto& x : t)
                out << "vertex " << x[0] << " " << x[1] << " " << x[2] << "\n";
            out << "endloop\nendfacet\n";
        }
        out << "endsolid part\n";
    }

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

    void expect_refused(const std::string& wanted) {
        try {
            make_solid(StlSurface{path_.string(), 1, {}}, 1, {10, 10, 10});
            FAIL() << "accepted; wanted: " << wanted;
        } catch (const std::invalid_argument& error) {
            EXPECT_NE(std::string(error.what()).find(wanted), std::string::npos)
                << error.what();
        }
    }

    std::filesystem::path path_;
};

std::vector<char> cells(const Solid& solid) {
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
    EXPECT_EQ(cells(*stl), cells(*block));
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
    write_ascii(in_file_units(block_surface({2, 3, 1}, {7, 8, 6})));
    expect_same_as_block(path_);
}

TEST_F(StlFile, BinaryIsTheBlock) {
    write_binary(in_file_units(block_surface({2, 3, 1}, {7, 8, 6})));
    expect_same_as_block(path_);
}

TEST_F(StlFile, OpenSurfaceIsRefused) {
    auto triangles = block_surface({2, 3, 1}, {7, 8, 6});
    triangles.pop_back();
    write_ascii(triangles);
    expect_refused("has 3 edges that do not join two triangles");
}

TEST_F(StlFile, CutBinaryFileIsRefused) {
    write_binary(block_surface({2, 3, 1}, {7, 8, 6}));
    std::filesystem::resize_file(path_, 84 + 50 * 12 - 7);
    expect_refused("has no triangle");  // begins with "solid" and is no ASCII
}

TEST_F(StlFile, CutAsciiFileIsRefused) {
    std::ofstream(path_) << "solid a\nfacet\nouter loop\nvertex 0 0 0\nvertex 1 0 0\n";
    expect_refused("ends inside a triangle");
}

TEST_F(StlFile, OtherFilesAreRefused) {
    std::ofstream(path_) << "PLY and so on";
    expect_refused("neither begins with \"solid\"");
}

}  // namespace
}  // namespace magfsi::fluid
