// SPDX-License-Identifier: GPL-2.0-or-later
// Fields and gradients of magnets and coils against quadrature (source_fields.py), their
// motion, grids, words.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <fstream>
#include <numbers>
#include <sstream>

#include "structure/lammps/source_words.h"
#include "structure/magnetics/source_field.h"
#include "tests/support/checks.h"
#include "tests/unit/structure/sources.h"

namespace magfsi::structure {
namespace {

using Eigen::Matrix3d, Eigen::Vector3d;
constexpr double pi = std::numbers::pi;

void expect_same(const FieldSample& found, const FieldSample& right, double share) {
    EXPECT_LT((found.field_t - right.field_t).norm(), share * right.field_t.norm());
    EXPECT_LT((found.gradient_t_m - right.gradient_t_m).norm(),
              share * right.gradient_t_m.norm());
}

struct Row {
    std::string name;
    SourceShape shape;
    Vec3 point_m{};
    FieldSample right;
};

SourceShape shape_of(const std::string& name, const std::vector<double>& p) {
    if (name == "cuboid") return CuboidMagnet{{p[0], p[1], p[2]}, {p[3], p[4], p[5]}};
    if (name == "cylinder")
        return CylinderMagnet{p[0], p[1], {0, 0, 1}, {p[3], p[4], p[5]}};
    return CircularCoil{p[0], {0, 0, 1}, p[1], 1};
}

std::vector<Row> reference() {
    std::ifstream file(MAGFSI_SOURCE_FIELDS);
    std::vector<Row> rows;
    for (std::string line; std::getline(file, line);) {
        if (line.starts_with('#') || line.starts_with("source")) continue;
        std::istringstream fields(line);
        Row row;
        std::getline(fields, row.name, ',');
        std::vector<double> n;
        for (std::string word; std::getline(fields, word, ',');)
            n.push_back(std::stod(word));
        row.shape = shape_of(row.name, n);
        row.point_m = {n[6], n[7], n[8]};
        row.right.field_t << n[9], n[10], n[11];
        row.right.gradient_t_m << n[12], n[13], n[14], n[13], n[15], n[16], n[14], n[16],
            n[17];
        rows.push_back(row);
    }
    return rows;
}

TEST(SourceField, OfMagnetsAndCoilsIsThatOfTheirChargesAndCurrents) {
    const auto rows = reference();
    ASSERT_EQ(rows.size(), 36u);
    for (const Row& row : rows) {
        SCOPED_TRACE(row.name + " at " + std::to_string(row.point_m[0]));
        expect_same(at({source(row.shape)}, row.point_m), row.right, 1e-8);
    }
}

// Far away all are dipoles: a ball's worth of moment each.
TEST(SourceField, FarAwayIsADipoles) {
    const double mu0 = 4e-7 * pi;
    const Vec3 far{0.2, -0.3, 0.5};
    const auto expect = [&](const SourceShape& shape, const Vec3& moment, double share) {
        expect_same(at({source(shape)}, far), at({source(DipoleSource{moment})}, far),
                    share);
    };
    const double v = 2e-3 * 2e-3 * 2e-3 / mu0;
    // The next terms fall with the square of size over distance: 1e-5.
    expect(CuboidMagnet{{2e-3, 2e-3, 2e-3}, {0.3, 1, -0.2}}, {0.3 * v, v, -0.2 * v},
           3e-5);
    const double c = pi * 1e-6 * 2e-3 / mu0;
    expect(CylinderMagnet{2e-3, 2e-3, {0, 0, 1}, {0.7, 0, 1}}, {0.7 * c, 0, c}, 3e-5);
    expect(CircularCoil{2e-3, {0, 0, 1}, 5, 10}, {0, 0, 50 * pi * 1e-6}, 3e-5);
}

TEST(SourceField, OfAHelmholtzPairIsEvenAndOfAnOpposedOneAGradient) {
    const double mu0 = 4e-7 * pi, radius = 0.05;
    CoilPair pair;
    pair.diameter_m = 2 * radius;
    pair.current_a = 3;
    pair.turns = 100;
    pair.distance_m = radius;
    const FieldSample even = at({source(pair)}, {});
    const double b = std::pow(0.8, 1.5) * mu0 * 300 / radius;  // (4/5)^(3/2) mu0 n I / R
    EXPECT_NEAR(even.field_t[2] / b, 1, 1e-12);
    EXPECT_LT(even.gradient_t_m.norm(), 1e-12 * b / radius);
    pair.opposed = true;
    pair.distance_m = std::sqrt(3.0) * radius;
    const FieldSample maxwell = at({source(pair)}, {});
    EXPECT_LT(maxwell.field_t.norm(), 1e-12 * b);
    // 48/49 sqrt(3/7) mu0 n I / R^2, downwards: the upper coil is the reversed one.
    EXPECT_NEAR(maxwell.gradient_t_m(2, 2) /
                    (-48.0 / 49 * std::sqrt(3.0 / 7) * mu0 * 300 / (radius * radius)),
                1, 1e-12);
    EXPECT_NEAR(maxwell.gradient_t_m.trace(), 0, 1e-12 * b / radius);
}

TEST(SourceField, OfACoilSystemFollowsTheMatrixOfCurrents) {
    SystemCoil first, second;
    first.position_m = {0, 0, -0.02};
    second.position_m = {0.03, 0, 0};
    first.diameter_m = second.diameter_m = 0.02;
    second.axis = {2, 0, 0};
    second.turns = 7;
    first.current_a = {1, 3};
    second.current_a = {0, -2};
    const CoilSystem system{{first, second}, {0, 1}, false};
    const auto alone = [&](const SystemCoil& coil) {
        return at({source(CircularCoil{coil.diameter_m, coil.axis, 1, coil.turns},
                          coil.position_m)},
                  {1e-3, 2e-3, 3e-3});
    };
    FieldSample right = alone(first);
    right.field_t = 2 * right.field_t - alone(second).field_t;
    right.gradient_t_m = 2 * right.gradient_t_m - alone(second).gradient_t_m;
    expect_same(at({source(system)}, {1e-3, 2e-3, 3e-3}, 0.5), right, 1e-13);
}

// A magnet that circles a point and turns with it is one at rest seen from a turned
// frame.
TEST(SourceField, FollowsItsMotion) {
    FieldSource moving =
        source(CuboidMagnet{{8e-3, 6e-3, 4e-3}, {0, 0.2, 1}}, {20e-3, 0, 5e-3});
    const FieldSource still = moving;
    moving.turning = SourceTurning{{0, 0, 3}, 2.0, Vec3{1e-3, 1e-3, 0}};
    const Matrix3d turn = Eigen::AngleAxisd(pi / 3, Vector3d::UnitZ()).toRotationMatrix();
    const Vector3d about(1e-3, 1e-3, 0), point(4e-3, -2e-3, 1e-3);
    const Vector3d seen = about + turn.transpose() * (point - about);
    FieldSample right = at({still}, {seen[0], seen[1], seen[2]});
    right.field_t = turn * right.field_t;
    right.gradient_t_m = turn * right.gradient_t_m * turn.transpose();
    expect_same(at({moving}, {point[0], point[1], point[2]}, 1.0 / 12), right, 1e-12);

    FieldSource shifted = still;
    shifted.motion = SourcePath{{0, 2}, {{0, 0, 0}, {4e-3, 0, -2e-3}}, false};
    shifted.strength = StrengthOscillation{0.25, 0};  // 1/sqrt(2) after 0.5 s
    FieldSample moved = at({still}, {4e-3 - 1e-3, 0, 0.5e-3});
    moved.field_t *= std::sqrt(0.5);
    moved.gradient_t_m *= std::sqrt(0.5);
    expect_same(at({shifted}, {4e-3, 0, 0}, 0.5), moved, 1e-12);
    EXPECT_FALSE(SourceField({shifted}).at_rest());
    EXPECT_TRUE(SourceField({still}).at_rest());
}

// The same laws as a wave, a table, a path and a frequency.
TEST(SourceField, FollowsFormulas) {
    const auto as_formula = [](const char* text) { return Formula{text, text}; };
    FieldSource other =
        source(CuboidMagnet{{8e-3, 6e-3, 4e-3}, {0, 0.2, 1}}, {0.02, 0, 0});
    other.strength = StrengthOscillation{3, 0.2};
    other.motion = SourcePath{{0, 2}, {{1e-3, 0, 0}, {1e-3, -4e-3, 2e-3}}, false};
    other.turning = SourceTurning{{1, 0, 1}, 2.0, Vec3{1e-3, 1e-3, 0}};
    FieldSource same = other;
    same.strength = as_formula("sin(2*pi*3*t+0.2)");
    same.motion = FormulaMotion{
        {as_formula("0.001"), as_formula("-0.002*t"), as_formula("t*1e-3")}};
    same.turning->turns = as_formula("4*pi*t");
    FieldSource rows =
        source(CoilSystem{{{{0, 0, 1}, 0.1, {0, 1, 0}, 20, {1, 5}}}, {0, 2}});
    FieldSource coil =
        source(CoilSystem{{{{0, 0, 1}, 0.1, {0, 1, 0}, 20, {}, as_formula("1+2*t")}}});
    for (const double t : {0.0, 0.37, 1.9}) {
        expect_same(at({same}, {4e-3, -2e-3, 1e-3}, t),
                    at({other}, {4e-3, -2e-3, 1e-3}, t), 1e-12);
        expect_same(at({coil}, {4e-3, -2e-3, 1e-3}, t),
                    at({rows}, {4e-3, -2e-3, 1e-3}, t), 1e-12);
    }
    EXPECT_FALSE(SourceField({coil}).at_rest());
    const std::vector<FieldSource> both{same, coil};
    const std::string text = source_words(both);
    EXPECT_EQ(source_words(parse_source_words(text)), text);
    expect_same(at(parse_source_words(text), {4e-3, 0, 0}, 0.37),
                at(both, {4e-3, 0, 0}, 0.37), 1e-15);
}

// --- grids ----------------------------------------------------------------------------

std::string grid_of_a_dipole(int places, const char* header) {
    const std::vector<FieldSource> dipole{
        source(DipoleSource{{0, 0.1, 1}}, {0, 0, -0.1})};
    std::ostringstream text;
    text.precision(17);
    text << header;
    for (int i = 0; i < places * places * places; ++i) {
        const auto place = [&](int n) { return -0.02 + 0.04 * n / (places - 1); };
        const Vec3 x{place(i / places / places), place(i / places % places),
                     place(i % places)};
        const FieldSample s = at(dipole, x);
        text << 1e3 * x[0] << ',' << 1e3 * x[1] << ',' << 1e3 * x[2] << ','
             << s.field_t[0] << ',' << s.field_t[1] << ',' << s.field_t[2] << '\n';
    }
    return text.str();
}

constexpr const char* our_header = "x[mm],y[mm],z[mm],Bx[T],By[T],Bz[T]\n";

FieldSample on_grid(const std::string& text, const Vec3& point_m) {
    const test::TemporaryFolder folder;
    const auto file = folder / "grid.csv";
    std::ofstream(file) << text;
    return at({source(GridField{file.string()})}, point_m);
}

TEST(FieldGrid, ConvergesWithTheFourthAndTheThirdPower) {
    const Vec3 point{1.3e-3, -2.7e-3, 3.1e-3};
    const FieldSample right =
        at({source(DipoleSource{{0, 0.1, 1}}, {0, 0, -0.1})}, point);
    std::vector<double> field, gradient;
    for (const int places : {6, 11, 21, 41}) {
        const FieldSample s = on_grid(grid_of_a_dipole(places, our_header), point);
        field.push_back((s.field_t - right.field_t).norm() / right.field_t.norm());
        gradient.push_back((s.gradient_t_m - right.gradient_t_m).norm() /
                           right.gradient_t_m.norm());
    }
    // Places within a cell differ between the grids: a mean order over a factor of four.
    EXPECT_GT(std::log2(field[0] / field[2]) / 2, 3.5) << field[0] << ' ' << field[2];
    EXPECT_GT(std::log2(gradient[0] / gradient[2]) / 2, 2.5)
        << gradient[0] << ' ' << gradient[2];
    EXPECT_LT(field[3], 1e-6);
}

TEST(FieldGrid, ReadsWhatOtherProgramsWrite) {
    const Vec3 point{1e-3, 2e-3, 3e-3};
    const FieldSample right = on_grid(grid_of_a_dipole(6, our_header), point);
    expect_same(on_grid(grid_of_a_dipole(6,
                                         "% Model: magnet.mph\n% Length unit: mm\n"
                                         "% X,Y,Z,mf.Bx (T),mf.By (T),mf.Bz (T)\n"),
                        point),
                right, 1e-15);
    expect_same(on_grid(grid_of_a_dipole(6, "x (mm),y (mm),z (mm),Bx,By,Bz\n"), point),
                right, 1e-15);
}

TEST(FieldGrid, RefusesWhatIsNone) {
    const std::string text = grid_of_a_dipole(3, our_header);
    const auto refused = [&](const std::string& grid,
                             std::initializer_list<std::string> says) {
        test::expect_says(
            test::message_of<std::invalid_argument>([&] { on_grid(grid, {}); }), says);
    };
    refused(text.substr(0, text.rfind('\n', text.size() - 2) + 1), {"26 rows found"});
    refused(text + "25,0,0,0,0,0\n", {"not evenly spaced"});
    refused("x[mm],y[mm],z[mm],Bx[T],By[T]\n1,1,1,1,1\n",
            {"the columns x, y, z, Bx, By, Bz are needed"});
    refused("x[in],y[mm],z[mm],Bx[T],By[T],Bz[T]\n1,1,1,1,1,1\n", {"x[in]", "[mm]"});
    EXPECT_THROW(on_grid(text, {0.03, 0, 0}), std::runtime_error);
}

// --- words ----------------------------------------------------------------------------

TEST(SourceWords, ReadBackExactly) {
    FieldSource magnet =
        source(CylinderMagnet{1.0 / 3, 0.2, {1, 2, 3}, {0.1, 0, 1}}, {1, 2, 1.0 / 7});
    magnet.rotation = AxisRotation{{1, 0, 1}, 0.3};
    magnet.strength = StrengthTable{{0, 1}, {1, 1.0 / 3}, true};
    magnet.motion = Oscillation{{1e-3, 0, 0}, 3, 0.1};
    magnet.turning = SourceTurning{{0, 1, 0}, 2.0, Vec3{1, 1, 1}};
    FieldSource coils = source(CoilSystem{{{{0, 0, 1}, 0.1, {0, 1, 0}, 20, {1, 2}},
                                           {{0, 0, 2}, 0.1, {1, 1, 0}, 3, {-1, 0.5}}},
                                          {0, 1},
                                          true});
    coils.motion = SourcePath{{0, 1, 2}, {{0, 0, 0}, {1, 2, 3}, {1, 0, 0}}, true};
    FieldSource pair = source(CoilPair{{0.1, {0, 0, 1}, 2, 30}, 0.05, true});
    pair.strength = StrengthRamp{0.3};
    pair.motion = DisplacementRamp{{1, 0, 0}, 0.5};
    const std::vector<FieldSource> sources{magnet,
                                           coils,
                                           pair,
                                           source(DipoleSource{{1, 2, 3}}),
                                           source(CuboidMagnet{{1, 2, 3}, {0, 0, 1}}),
                                           source(CircularCoil{0.1, {1, 0, 0}, 2, 9})};
    const std::string text = source_words(sources);
    EXPECT_EQ(source_words(parse_source_words(text)), text);
    const Vec3 far{7, 8, 9};
    expect_same(at(parse_source_words(text), far, 0.37), at(sources, far, 0.37), 1e-15);
}

TEST(SourceWords, RefuseWhatIsNoSource) {
    for (const char* text :
         {"", "dipole 1 2", "dipole 1 2 3 4", "magnet 1 2 3", "1 2 3",
          "coil 0.1 0 0 0 1 1", "cuboid 1 0 1 0 0 1", "dipole 1 0 0 spinning 3",
          "dipole 1 0 x", "dipole 1 0 0 motion formula t t",
          "dipole 1 0 0 strength formula sin(", "dipole 1 0 0 angle t",
          "dipole 1 0 0 at 1 2", "grid", "dipole 1 0 0 member 1 1 1", "system current t",
          "system member 0 0 0 0.1", "system member 0 0 0 0.1 0 0 1 1 2 3"}) {
        EXPECT_THROW(SourceField(parse_source_words(text)), std::invalid_argument)
            << text;
    }
}

}  // namespace
}  // namespace magfsi::structure
