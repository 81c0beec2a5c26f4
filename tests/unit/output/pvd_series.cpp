#include "coupler/output/vtk.h"

#include <gtest/gtest.h>

#include <stdexcept>

#include "coupler/output/file.h"
#include "tests/unit/output/temporary_folder.h"

using magfsi::output::FileError;
using magfsi::output::PvdSeries;
using magfsi::test::read;
using magfsi::test::TemporaryFolder;

TEST(PvdSeries, names_files_relative_to_itself_and_is_whole_after_every_add) {
    TemporaryFolder folder;
    const std::string head =
        "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"0.1\">\n"
        "<Collection>\n";
    const std::string tail = "</Collection>\n</VTKFile>\n";
    const std::string first =
        "<DataSet timestep=\"0\" part=\"0\" file=\"body/0.vtu\"/>\n";
    const std::string second =
        "<DataSet timestep=\"0.0025\" part=\"0\" file=\"body/a&amp;b.vtu\"/>\n";

    PvdSeries series(folder / "structure.pvd");
    EXPECT_EQ(read(folder / "structure.pvd"), head + tail);
    series.add(0, folder / "body/0.vtu");
    EXPECT_EQ(read(folder / "structure.pvd"), head + first + tail);
    series.add(2.5e-3, folder / "body/a&b.vtu");
    EXPECT_EQ(read(folder / "structure.pvd"), head + first + second + tail);
}

TEST(PvdSeries, times_must_rise) {
    TemporaryFolder folder;
    PvdSeries series(folder / "a.pvd");
    series.add(1, folder / "1.vtu");
    EXPECT_THROW(series.add(1, folder / "2.vtu"), std::invalid_argument);
    EXPECT_THROW(series.add(0.5, folder / "2.vtu"), std::invalid_argument);
}

TEST(PvdSeries, a_missing_folder_is_found_at_once) {
    TemporaryFolder folder;
    EXPECT_THROW(PvdSeries(folder / "missing/a.pvd"), FileError);
}
