// SPDX-License-Identifier: GPL-2.0-or-later
// STL files after those that CAD programs, scanners, slicers and people write: each holds
// what it should, or is refused with place and remedy.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <cstring>
#include <functional>
#include <sstream>

#include "structure/triangle_surface.h"
#include "tests/support/checks.h"
#include "tests/support/stl_surfaces.h"

namespace magfsi::structure {
namespace {

using magfsi::test::ball_surface, magfsi::test::brick_surface, magfsi::test::Triangles;

Triangles both(Triangles a, const Triangles& b) {
    a.insert(a.end(), b.begin(), b.end());
    return a;
}
Triangles inside_out(Triangles all) {
    for (auto& t : all) std::swap(t[1], t[2]);
    return all;
}
Triangles each(Triangles all, const std::function<void(magfsi::test::Corner&)>& change) {
    for (auto& t : all)
        for (auto& x : t) change(x);
    return all;
}

std::string ascii(const Triangles& all, const std::string& format = "plain") {
    std::ostringstream out;
    out.precision(format == "six digits" ? 6 : 17);
    const bool upper = format == "upper case";
    const char* vertex = upper ? "VERTEX " : "vertex ";
    out << (upper ? "SOLID A Part\n" : "solid a vertex of a part\n");
    for (const auto& t : all) {
        out << (upper ? "FACET NORMAL 0 0 1\n OUTER LOOP\n"
                      : "facet normal 0 0 1\nouter loop\n");
        for (const auto& x : t)
            out << vertex << x[0] << (format == "tabs" ? '\t' : ' ') << x[1] << "  "
                << x[2] << '\n';
        out << (upper ? "ENDLOOP\nENDFACET\n" : "endloop\nendfacet\n");
    }
    out << (upper ? "ENDSOLID A Part\n" : "endsolid a vertex of a part\n");
    std::string text = out.str();
    if (format == "crlf") {
        for (std::size_t at = 0; (at = text.find('\n', at)) != text.npos; at += 2)
            text.insert(at, 1, '\r');
    }
    return text;
}

std::string binary(const Triangles& all,
                   const std::string& header = "made by a program") {
    std::string out = header;
    out.resize(80);
    const auto count = static_cast<std::uint32_t>(all.size());
    out.append(reinterpret_cast<const char*>(&count), 4);
    for (const auto& t : all) {
        float numbers[12] = {};
        for (std::size_t i = 0; i < 9; ++i)
            numbers[3 + i] = static_cast<float>(t[i / 3][i % 3]);
        out.append(reinterpret_cast<const char*>(numbers), sizeof numbers);
        out.append(2, '\0');
    }
    return out;
}

TriangleSurface read(const std::string& bytes) {
    const magfsi::test::TemporaryFolder folder;
    const auto file = folder / "part.stl";
    std::ofstream(file, std::ios::binary) << bytes;
    return {file.string(), 1, {}};
}

const Triangles cube = brick_surface({0, 0, 0}, {1, 1, 1});

// The share of a box from -1 to 2 that is held, by points.
double volume(const TriangleSurface& surface) {
    constexpr int n = 36;
    int held = 0;
    for (int i = 0; i < n * n * n; ++i) {
        const auto at = [](int k) { return -1 + 3 * (k + 0.497) / n; };
        held += surface.holds({at(i % n), at(i / n % n), at(i / n / n)}) ? 1 : 0;
    }
    return 27.0 * held / (n * n * n);
}

struct Right {
    const char* name;
    std::string bytes;
    double volume;
};

TEST(RealSurfaces, HoldWhatTheyShould) {
    const Triangles beside = brick_surface({1.25, 0, 0}, {1.75, 1, 1});
    const Triangles touching = brick_surface({1, 0, 0}, {1.5, 1, 1});
    const Triangles overlapping = brick_surface({0.5, 0, 0}, {1.5, 1, 1});
    const Triangles within = brick_surface({0.25, 0.25, 0.25}, {0.75, 0.75, 0.75});
    // The last digit of vertices, as programs of single precision leave it.
    int number = 0;
    const Triangles ragged = each(ball_surface({0, 0, 0}, 1, 8), [&](auto& x) {
        for (double& value : x) value *= 1 + 6e-8 * ((++number * 7) % 3 - 1);
    });
    const Triangles far = each(cube, [](auto& x) { x[0] += 1e-9 * x[1]; });
    Triangles thin = cube;  // one without area, as decimation leaves it
    thin.push_back({cube[0][0], cube[0][1], cube[0][1]});
    const double ball = volume(read(ascii(ball_surface({0, 0, 0}, 1, 8))));
    EXPECT_NEAR(ball, 4.0 / 3 * M_PI, 0.1);
    const Right all[] = {
        {"ASCII", ascii(cube), 1},
        {"ASCII in upper case", ascii(cube, "upper case"), 1},
        {"a leading blank", " " + ascii(cube), 1},
        {"leading lines", "\r\n\n\t" + ascii(cube), 1},
        {"a mark of byte order", "\xef\xbb\xbf" + ascii(cube), 1},
        {"lines of Windows", ascii(cube, "crlf"), 1},
        {"tabs", ascii(cube, "tabs"), 1},
        {"six digits", ascii(ball_surface({0, 0, 0}, 1, 8), "six digits"), ball},
        {"binary", binary(cube), 1},
        {"binary that begins with solid", binary(cube, "solid part"), 1},
        {"binary with colours", binary(cube, "COLOR=abcd MATERIAL=efgh"), 1},
        {"two bodies", ascii(both(cube, beside)), 1.5},
        {"two solids in one file", ascii(cube) + ascii(beside), 1.5},
        {"bodies that touch", ascii(both(cube, touching)), 1.5},
        {"bodies that overlap", ascii(both(cube, overlapping)), 1.5},
        {"bodies that overlap, binary", binary(both(cube, overlapping)), 1.5},
        {"one given twice", ascii(both(cube, cube)), 1},
        {"one given three times", binary(both(both(cube, cube), cube)), 1},
        {"one in another", ascii(both(cube, within)), 1},
        {"a cavity", ascii(both(cube, inside_out(within))), 0.875},
        {"inside out", ascii(inside_out(cube)), 1},
        {"a cavity, all inside out", ascii(inside_out(both(cube, inside_out(within)))),
         0.875},
        {"one of two inside out", ascii(both(cube, inside_out(beside))), 1.5},
        {"one of two that overlap inside out",
         ascii(both(cube, inside_out(brick_surface({0.5, 0, 0}, {1.25, 1, 1})))), 1.25},
        {"a ball in a cavity",
         ascii(both(both(cube, inside_out(within)),
                    brick_surface({0.4, 0.4, 0.4}, {0.6, 0.6, 0.6}))),
         0.875 + 0.008},
        {"vertices that differ in the last digit", ascii(ragged), ball},
        {"the same, binary", binary(ragged), ball},
        {"vertices that differ by a billionth", ascii(far), 1},
        {"a triangle without area", ascii(thin), 1},
        {"numbers with a plus",
         [] {
             std::string text = ascii(cube);
             for (std::size_t at = 0; (at = text.find("x 1", at)) != text.npos; at += 3)
                 text.replace(at, 3, "x +1");
             return text;
         }(),
         1},
        {"a fine ball", binary(ball_surface({0, 0, 0}, 1, 24)), 4.0 / 3 * M_PI},
    };
    for (const Right& one : all) {
        double found = 0;
        ASSERT_NO_THROW(found = volume(read(one.bytes))) << one.name;
        // A row of points at a side counts wholly or not.
        EXPECT_NEAR(found, one.volume, 0.05 * one.volume + 0.01) << one.name;
    }
}

// What pushes a body back is the surface of the whole, not that of a part within it.
TEST(RealSurfaces, AreNearestWhereTheyAreNotHidden) {
    const TriangleSurface surface = read(ascii(
        both(brick_surface({0, 0, 0}, {2, 2, 2}), ball_surface({1, 1, 1}, 0.5, 6))));
    const auto nearest = surface.nearest({1, 1, 0.45});
    EXPECT_NEAR(nearest.at_m[2], 0, 1e-12);
    EXPECT_NEAR(nearest.normal[2], -1, 1e-12);
}

TEST(RealSurfaces, AreRefusedWithPlaceAndRemedy) {
    Triangles open = cube, turned = cube;
    open.pop_back();
    std::swap(turned[3][0], turned[3][1]);
    Triangles gap = cube;
    for (auto& x : gap[0]) x[0] += 1e-3;
    std::string cut = binary(cube), comma = ascii(cube), more = binary(cube);
    cut.resize(cut.size() - 7);
    more += "trailing bytes";
    comma.replace(comma.find("vertex 0 0"), 10, "vertex 0,5");
    Triangles infinite = cube;
    infinite[0][0][0] = INFINITY;
    // Eight places on a line, of which fuzzing made a tree without a triangle.
    const Triangles line = each(cube, [](auto& x) {
        x = {x[0] + 2 * x[1] + 4 * x[2], 0, 0};
    });
    const std::pair<std::string, std::vector<const char*>> wrong[] = {
        {ascii(line), {"has no triangle with an area"}},
        {"", {"neither begins with \"solid\""}},
        {"PLY\nformat ascii 1.0\n", {"neither begins with \"solid\""}},
        {"solid nothing\nendsolid nothing\n", {"has no triangle"}},
        {ascii(open), {"is open at (", "3 edges", "Close Holes"}},
        {binary(open), {"is open at (", "3 edges"}},
        {ascii(gap), {"is open at (", "Merge Close Vertices"}},
        {ascii(turned), {"the same orientation", "Re-Orient"}},
        {cut, {"677 bytes", "50 bytes per triangle"}},
        {more, {"50 bytes per triangle"}},
        {comma, {"line 4", "decimal points"}},
        {binary(infinite), {"not finite"}},
        {"solid a\nfacet\nouter loop\nvertex 0 0 0\nvertex 1 0 0\n",
         {"ends inside a triangle"}},
        {"solid a\nfacet\nvertex 0 0 0\nvertex 1 0 0\nendfacet\n", {"line 5", "not 3"}},
        {"solid a\nfacet\nvertex 0 0 zero\n", {"line 3", "zero"}},
    };
    for (const auto& [bytes, says] : wrong) {
        const std::string message =
            magfsi::test::message_of<std::invalid_argument>([&] { read(bytes); });
        EXPECT_EQ(message.find('\n'), std::string::npos) << message;
        for (const char* part : says)
            EXPECT_NE(message.find(part), message.npos) << message;
    }
}

}  // namespace
}  // namespace magfsi::structure
