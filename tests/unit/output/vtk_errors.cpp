// What does not fit is refused before a file is touched.
#include <gtest/gtest.h>

#include <stdexcept>
#include <vector>

#include "coupler/output/vtk.h"
#include "tests/unit/output/temporary_folder.h"

using namespace magfsi::output;
using magfsi::test::message_of;
using magfsi::test::TemporaryFolder;

namespace {

const std::vector<double> points(24);
const std::vector<std::array<int, 8>> one_cell{{0, 1, 2, 3, 4, 5, 6, 7}};
const ImageGrid grid{{0, 0, 0}, {1, 1, 1}};

}  // namespace

TEST(Vtu, a_field_of_another_size_is_refused) {
    TemporaryFolder folder;
    const std::vector<double> short_by_one(23);
    const std::vector<Field> fields{{"velocity", 3, short_by_one}};
    const auto message = message_of<std::invalid_argument>([&] {
        write_vtu(folder / "a.vtu", {points, one_cell}, fields, {});
    });
    EXPECT_EQ(message,
              "VTK field 'velocity' has 23 values; 8 points of 3 components need 24");
    EXPECT_FALSE(std::filesystem::exists(folder / "a.vtu"));
}

TEST(Vtu, a_point_that_is_not_there_is_refused) {
    TemporaryFolder folder;
    const std::vector<std::array<int, 8>> beyond{{0, 1, 2, 3, 4, 5, 6, 8}};
    const auto message = message_of<std::invalid_argument>([&] {
        write_vtu(folder / "a.vtu", {points, beyond}, {}, {});
    });
    EXPECT_EQ(message, "hexahedron 0 names point 8; there are 8 points");
}

TEST(Vti, empty_extents_and_spacings_are_refused) {
    TemporaryFolder folder;
    const CellExtent none{{0, 0, 0}, {4, 0, 4}};
    const CellExtent one{{0, 0, 0}, {1, 1, 1}};
    const ImageGrid flat{{0, 0, 0}, {1, 0, 1}};
    EXPECT_THROW(write_vti(folder / "a.vti", grid, none, {}), std::invalid_argument);
    EXPECT_THROW(write_vti(folder / "a.vti", flat, one, {}), std::invalid_argument);
}

TEST(Pvti, pieces_that_miss_overlap_or_leave_the_grid_are_refused) {
    TemporaryFolder folder;
    const CellExtent whole{{0, 0, 0}, {4, 2, 2}};
    const CellExtent left{{0, 0, 0}, {2, 2, 2}}, right{{2, 0, 0}, {4, 2, 2}};
    const CellExtent over{{1, 0, 0}, {3, 2, 2}}, beyond{{2, 0, 0}, {5, 2, 2}};
    const auto with = [&](CellExtent first, CellExtent second) {
        const std::vector<ImagePiece> pieces{{"a.vti", first}, {"b.vti", second}};
        return message_of<std::invalid_argument>(
            [&] { write_pvti(folder / "a.pvti", grid, whole, pieces, {}); });
    };
    EXPECT_EQ(with(left, right), "");
    EXPECT_EQ(with(left, over), "pieces 0 2 0 2 0 2 and 1 3 0 2 0 2 overlap");
    EXPECT_EQ(with(left, beyond),
              "piece 2 5 0 2 0 2 is empty or leaves the grid 0 4 0 2 0 2");
    const std::vector<ImagePiece> half{{"a.vti", left}};
    EXPECT_EQ(message_of<std::invalid_argument>(
                  [&] { write_pvti(folder / "a.pvti", grid, whole, half, {}); }),
              "the pieces hold 8 of the grid's 16 cells");
}
