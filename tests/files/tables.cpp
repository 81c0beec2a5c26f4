// SPDX-License-Identifier: GPL-2.0-or-later
// CSV files after those that sheets, oscilloscopes, numpy, pandas, COMSOL and people
// write: each is read right, or refused with its line and what to do.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <string>
#include <vector>

#include "structure/magnetics/grid_field.h"
#include "structure/table_file.h"
#include "tests/support/checks.h"

namespace magfsi::structure {
namespace {

constexpr ColumnKind columns[] = {{"t", units::time},
                                  {"Bx", units::flux_density},
                                  {"By", units::flux_density},
                                  {"Bz", units::flux_density}};
using Values = std::vector<std::vector<double>>;

Values read(const std::string& text) {
    const test::TemporaryFolder folder;
    const auto file = folder / "course.csv";
    std::ofstream(file, std::ios::binary) << text;
    return read_table("field table", file, columns, {"t", "Bx", "By", "Bz"});
}

// All of these say 0 s: (1, 2, -3) mT and 20 ms: (4, 5, 6e-3) mT.
TEST(RealTables, AreReadRight) {
    const Values expected{{0, 0.02}, {1e-3, 4e-3}, {2e-3, 5e-3}, {-3e-3, 6e-6}};
    const std::string ours = "t[ms],Bx[mT],By[mT],Bz[mT]\n";
    const std::string rows = "0,1,2,-3\n20,4,5,0.006\n";
    const std::string blanks = "0 1 2 -3\n20 4 5 6e-3\n";
    const std::string semicolons = "0;1;2;-3\n20;4;5;0.006\n";
    const std::string texts[] = {
        ours + rows,
        "\xef\xbb\xbf" + ours + rows,  // mark of byte order
        "t[ms],Bx[mT],By[mT],Bz[mT]\r\n0,1,2,-3\r\n20,4,5,0.006\r\n",
        "t[ms],Bx[mT],By[mT],Bz[mT]\r0,1,2,-3\r20,4,5,0.006",
        ours + "+0.0e+00,+1.0e+00,+2.0E+00,-3.0e+00\n+2.0e+01,+4e0,+5.,+.6e-02\n",
        ours + "0.0D+00,1.0D+00,2.0D+00,-3.0D+00\n2.0D+01,4D0,5D0,6D-3\n",
        "# t[ms] Bx[mT] By[mT] Bz[mT]\n" + blanks,  // numpy.savetxt
        "# t[ms], Bx[mT], By[mT], Bz[mT]\n" + blanks,
        "# written by an instrument\n# 20 rows a second\n" + ours + rows,
        "t [ms];Bx [mT];By [mT];Bz [mT]\n" + semicolons,
        "\"t [ms]\";\"Bx [mT]\";\"By [mT]\";\"Bz [mT]\"\n" + semicolons,
        "\"t [ms]\",\"Bx [mT]\",\"By [mT]\",\"Bz [mT]\"\n\"0\",\"1\",\"2\",\"-3\"\n"
        "\"20\",\"4\",\"5\",\"0.006\"\n",
        "sep=,\n" + ours + rows,
        "sep=;\n\"t (ms)\";Bx (mT);By (mT);Bz (mT)\n" + semicolons,
        "\"sep=;\"\r\nt (ms);Bx (mT);By (mT);Bz (mT)\r\n" + semicolons,
        "t (ms)\tBx (mT)\tBy (mT)\tBz (mT)\n0\t1\t2\t-3\n20\t4\t5\t0.006\n",
        "  t [ms]   Bx [mT]  By [mT]  Bz [mT]\n   0  1  2  -3\n  20  4  5  6e-3\n",
        "Time (ms),Bx (mT),By (mT),Bz (mT)\n" + rows,
        "time/ms,B_x/mT,B_y/mT,B_z/mT\n" + rows,
        "T[ms],BX[mT],BY[mT],BZ[mT]\n" + rows,
        "t[ms],Bz[mT],By[mT],Bx[mT]\n0,-3,2,1\n20,6e-3,5,4\n",  // another order
        "t,Bx,By,Bz\nms,mT,mT,mT\n" + rows,                     // units below
        "Time,Bx,By,Bz\n(ms),(mT),(mT),(mT)\n\n" + rows,        // PicoScope
        "t[s],Bx[T],By[T],Bz[T]\n0,1e-3,2e-3,-3e-3\n0.02,4e-3,5e-3,6e-6\n",
        "t[s],Bx[G],By[G],Bz[G]\n0,10,20,-30\n0.02,40,50,0.06\n",
        "t[ms],Bx[\u00b5T],By[\u03bcT],Bz[uT]\n0,1000,2000,-3000\n20,4000,5000,6\n",
        ours + "0,1,2,\u22123\n20,4,5,0.006\n",  // a typographic minus
        "t[ms],\u00a0Bx[mT],\u00a0By[mT],\u00a0Bz[mT]\n0,\u20091,\u20092,-3\n"
        "20,4,5,0.006\n",  // hard blanks
        "t[ms],Bx[mT],By[mT],Bz[mT],,\n0,1,2,-3,,\n20,4,5,.006,,\n,,,,,\n",  // a sheet's
        ours + "\n0,1,2,-3\n\n# a note\n20,4,5,0.006\n\n",
        ours + "0 , 1 , 2 , -3\n 20, 4,\t5, 0.006 ",
        "% t (ms) Bx (mT) By (mT) Bz (mT)\n" + blanks,
    };
    for (const std::string& text : texts) {
        Values found;
        ASSERT_NO_THROW(found = read(text)) << text;
        for (std::size_t c = 0; c < 4; ++c) {
            ASSERT_EQ(found[c].size(), 2U) << text;
            for (std::size_t r = 0; r < 2; ++r)
                EXPECT_NEAR(found[c][r], expected[c][r], 1e-15 * std::abs(expected[c][r]))
                    << text;
        }
    }
}

TEST(RealTables, AreRefusedWithLineAndRemedy) {
    const std::string ours = "t[ms],Bx[mT],By[mT],Bz[mT]\n";
    const std::vector<std::pair<std::string, std::vector<const char*>>> wrong = {
        {"", {"line 1", "no header"}},
        {std::string("t\0[\0m\0", 6), {"UTF-16", "UTF-8"}},
        {"0,1,2,3\n", {"line 1", "a header is needed, such as \"t[s],Bx[T]"}},
        {"# t Bx By Bz\n0 1 2 3\n", {"line 1", "the unit \"\"", "as in t[s]"}},
        {"t,Bx,By,Bz\n0,1,2,3\n", {"line 1", "[s], [ms]"}},
        {"t[ms];Bx[mT];By[mT];Bz[mT]\n0;0,5;1;2\n", {"line 2", "\"0,5\"", "points"}},
        {"t[ms]\tBx[mT]\tBy[mT]\tBz[mT]\n0\t0,5\t1\t2\n", {"line 2", "points"}},
        {"t[ms] Bx[mT] By[mT] Bz[mT]\n0,1 0,5 1,0 2,0\n", {"line 2", "points"}},
        {ours + "0,0,0,5,1,0,2,0\n", {"line 2", "8 values", "points"}},
        {ours + "0,1,2\n", {"line 2", "3 values found, 4 are needed"}},
        {ours + "0,1,2,#N/A\n", {"line 2", "#N/A"}},
        {ours + "0,1,2,1e999\n", {"line 2", "finite"}},
        {ours + "0,1,2,3 mT\n", {"line 2", "3 mT"}},
        {ours, {"no row"}},
        {"t[ms],Bx[mT],By[mT]\n0,1,2\n", {"line 1", "Bx, By, Bz are needed"}},
        {"t[ms],Bx[mT],Bx[mT],Bz[mT]\n0,1,2,3\n", {"Bx found twice"}},
        {"t[min],Bx[mT],By[mT],Bz[mT]\n0,1,2,3\n", {"[min]", "[us]"}},
        {"t[ms],0.5*Bx[mT],By[mT],Bz[mT]\n0,1,2,3\n", {"0.5*Bx[mT]"}},
    };
    for (const auto& [text, says] : wrong) {
        const std::string message =
            test::message_of<std::invalid_argument>([&] { read(text); });
        EXPECT_EQ(message.find('\n'), std::string::npos) << message;
        for (const char* part : says)
            EXPECT_NE(message.find(part), message.npos) << message;
    }
}

// --- grids of field values

GridValues grid(const std::string& text) {
    const test::TemporaryFolder folder;
    const auto file = folder / "grid.csv";
    std::ofstream(file, std::ios::binary) << text;
    return read_grid(file);
}

// Corners of a cube of 2 mm, Bz alone: 1 mT.
std::string corners(const std::string& separator = ",") {
    std::string out;
    for (int i = 0; i < 8; ++i) {
        for (const int x : {i % 2, i / 2 % 2, i / 4}) {
            out += x == 0 ? "-1" : "1";
            out += separator;
        }
        out += fmt::format("0{0}0{0}0.001\n", separator);
    }
    return out;
}

TEST(RealGrids, HaveTheirLengthsInTheUnitThatTheFileSays) {
    const std::string names = "% x,y,z,mf.Bx (T),mf.By (T),mf.Bz (T)\n";
    const std::string texts[] = {
        "% Model,magnet.mph\n% Version,COMSOL 5.6\n% Dimension,3\n% Nodes,8\n% "
        "Expressions,3\n% Description,\"Magnetic flux density, x component\"\n% Length "
        "unit,mm\n" +
            names + corners(),
        "% Model:              magnet.mph\n% Length unit:        mm\n% X                "
        "Y                Z               mf.Bx (T)   mf.By (T)  mf.Bz (T)\n" +
            corners("   "),
        "\"% Length unit\",\"mm\"\n" + names + corners(),
        "x [mm];y [mm];z [mm];Bx [T];By [T];Bz [T]\n" + corners(";"),
        "# length unit: mm\n# x y z Bx By Bz\n" + corners(" "),
        ",x (mm),y (mm),z (mm),Bx,By,Bz\n" +
            [] {  // pandas: an index in front
                std::string out = corners();
                for (std::size_t at = 0; at + 1 < out.size(); at = out.find('\n', at) + 1)
                    out.insert(at, "7,");
                return out;
            }(),
    };
    for (const std::string& text : texts) {
        GridValues found;
        ASSERT_NO_THROW(found = grid(text)) << text;
        for (const auto& axis : found.axes_m()) {
            ASSERT_EQ(axis.size(), 2U) << text;
            EXPECT_DOUBLE_EQ(axis[0], -1e-3) << text;
            EXPECT_DOUBLE_EQ(axis[1], 1e-3) << text;
        }
        EXPECT_DOUBLE_EQ(found.values_t()[5][2], 1e-3) << text;
    }
}

TEST(RealGrids, AreRefusedWhereAUnitOrAnExpressionIsNotUnderstood) {
    const std::string names = "% x,y,z,mf.Bx (T),mf.By (T),mf.Bz (T)\n";
    const std::vector<std::pair<std::string, std::vector<const char*>>> wrong = {
        {"% Length unit,inch\n" + names, {"line 1", "inch", "x[m]"}},
        {"% Units: mm and T\n" + names, {"line 1", "Units: mm and T", "x[m]"}},
        {"% lengths are millimetres\n" + names, {"line 1", "millimetres", "x[m]"}},
        {"% geometry in Millimeters\n" + names, {"line 1", "Millimeters"}},
        {"# all lengths in mm\n# x y z Bx By Bz\n", {"line 1", "in mm"}},
        {"% x,y,z,mf.Bx (T),mf.By (T),-mf.Bz (T)\n", {"\"-mf.Bz (T)\" is an expression"}},
        {"% x,y,z,mf.Bx (T),mf.By (T),0.5*mf.Bz (T)\n",
         {"0.5*mf.Bz", "export Bz itself"}},
        {"% x,y,z,mf.Bx (T),mf.By (T),mf.Bz*2 (T)\n", {"mf.Bz*2", "expression"}},
        {"% x,y,z,mf.Bx (T),mf.By (T),real(mf.Bz)\n", {"real(mf.Bz)", "expression"}},
        {"% x,y,z,mf.Bx (T),mf.By (T),mf.Bz (T) @ t=0\n", {"@ t=0", "expression"}},
        {"% x,y,z,mf.Bx (T),mf.By (T),mf.Hz (A/m)\n", {"Bx, By, Bz are needed"}},
        {"% x,y,z,mf.Bx (T),mf.By (T),mf.Bz (V)\n", {"[V]", "[mT]"}},
    };
    for (const auto& [header, says] : wrong) {
        const char* separator = header[0] == '#' && header[3] == 'l' ? " " : ",";
        const std::string message = test::message_of<std::invalid_argument>(
            [&] { grid(header + corners(separator)); });
        for (const char* part : says)
            EXPECT_NE(message.find(part), message.npos) << message;
    }
}

}  // namespace
}  // namespace magfsi::structure
