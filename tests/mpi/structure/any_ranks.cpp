// SPDX-License-Identifier: GPL-2.0-or-later
// What must not depend on the number of ranks: the motion of bodies, their sums,
// restarts, and faces that something outside moves.
#include <gtest/gtest.h>

#include <sstream>

#include "structure/lammps/motion_law.h"
#include "tests/mpi/structure/lammps_run.h"
#include "tests/mpi/structure/strip.h"

namespace magfsi::structure {
namespace {

using test::largest_difference;

// The same steps on one rank and on all, within tolerances of the positions and,
// relative, of the first `entries` numbers of the fix of the body.
void expect_same_on_any_ranks(const LammpsInput& input, double tolerance_m, int entries,
                              double relative) {
    test::AloneAndTogether runs(input);
    for (const char* line : {"run 0", "run 200 pre no post no", "run 200 pre no post no"})
        runs.command(line);
    const auto x = runs.alone.gather("x");
    double moved = 0;
    for (std::size_t q = 0; q < x.size(); ++q) {
        moved =
            std::max(moved, std::abs(x[q] - input.bodies[0].mesh.nodes[q / 3][q % 3]));
    }
    EXPECT_GT(moved, 1e-5);
    EXPECT_LT(runs.largest_difference("x"), tolerance_m);
    // Velocities feel a rounded position within a step.
    EXPECT_LT(runs.largest_difference("v"), tolerance_m / input.time_step_s);
    for (int entry = 0; entry < entries; ++entry) {
        const std::string id = "magttice_" + input.bodies[0].name;
        EXPECT_NEAR(runs.together.fix_value(id, entry) / runs.alone.fix_value(id, entry),
                    1, relative)
            << entry;
    }
}

// A bending, turning strip that starts as a tilted C. Sums of element forces in another
// order, where positions of 1 cm are rounded by 1e-18 m a step, over 400 steps; the work
// of 400 steps is a difference of larger terms.
TEST(AnyRanks, GiveTheSameMotionEnergiesAndWork) {
    for (const auto element : {ElementVariant::full, ElementVariant::assumed_strain}) {
        LammpsInput input = test::strip_in_field(element);
        Placement placement;
        placement.relaxed = ConstantField{17e-3, 4.4};
        placement.rotation = PlaneRotation{{0, 2}, 0.3};
        placement.position_m = Vec3{8e-3, 4e-3, 4e-3};
        input.placements = {placement};
        input.gravity_m_s2 = Vec3{0, 0, -9.81};
        input.drag = Drag{20};
        expect_same_on_any_ranks(input, 1e-13 * 3.7e-3, 4, 1e-9);
    }
}

// Here energies and work are small differences of larger terms.
TEST(AnyRanks, GiveTheSameMotionAndSumsOfTwoMaterials) {
    expect_same_on_any_ranks(test::bending_bar(), 1e-13 * 8e-3, 5, 1e-8);
}

TEST(Gravity, DropsABodyFarOutOfItsBoxWithoutLosingAtoms) {
    LammpsInput input = test::bare_strip();
    input.gravity_m_s2 = Vec3{1e5, 0, -5e4};
    test::Run run(input);
    const auto start = run.gather("x");
    constexpr int steps = 400;
    run.steps(steps);
    const double t = steps * input.time_step_s;
    const auto x = run.gather("x");
    ASSERT_GT(5e4 * t * t, 10 * 3.7e-3);  // ten lengths along x
    for (std::size_t q = 0; q < x.size(); q += 3) {
        // Velocity Verlet is exact for constant forces; rounding over 400 steps.
        EXPECT_NEAR(x[q] - start[q], 5e4 * t * t, 1e-10);
        EXPECT_NEAR(x[q + 2] - start[q + 2], -2.5e4 * t * t, 1e-10);
    }
    run.command("run 10 post no");  // setup anew where the body now is
    EXPECT_EQ(run.atoms(), 567);
}

// --- restarts

// The script's lines for a start from a restart file, which brings the atoms, the box and
// the step number along.
std::vector<std::string> restarted(const std::vector<std::string>& lines,
                                   const std::string& file) {
    std::vector<std::string> out;
    for (const std::string& line : lines) {
        if (line.starts_with("read_data")) {
            out.push_back("read_restart " + file);
        } else if (!line.starts_with("group") && !line.starts_with("balance")) {
            out.push_back(line);
        }
    }
    return out;
}

TEST(Restart, KeepsTheWorkOfTheFieldAndTheMotion) {
    const test::SharedScript script(test::strip_in_field());
    const std::string file = (script.folder() / "half.restart").string();
    test::LammpsRun whole(MPI_COMM_WORLD, script.lines());
    whole.command("run 300");
    whole.command("write_restart " + file);
    const double half = whole.fix_value("magttice_strip", 2);
    whole.command("run 300");

    test::LammpsRun second(MPI_COMM_WORLD, restarted(script.lines(), file));
    second.command("run 0");
    EXPECT_EQ(second.fix_value("magttice_strip", 2), half);
    second.command("run 300");
    // The sum starts anew from its total on one rank: rounding.
    const double work = whole.fix_value("magttice_strip", 2);
    EXPECT_NEAR(second.fix_value("magttice_strip", 2), work, 1e-11 * std::abs(work));
    // Atoms may be stored in another order, which reorders sums: rounding over 300 steps.
    EXPECT_LE(largest_difference(whole.gather("x"), second.gather("x")), 1e-15);
}

// The states of Maxwell branches go with the atoms between ranks and into restarts.
TEST(Restart, KeepsTheStatesOfBranches) {
    LammpsInput input = test::strip_in_field();
    input.bodies[0].material.branches = {{20e3, 2e-3}, {5e3, 0.1}};
    input.time_step_s = 0.9 * stable_step_s(input.bodies[0]);
    const test::SharedScript script(input);
    const std::string file = (script.folder() / "half.restart").string();
    test::LammpsRun whole(MPI_COMM_WORLD, script.lines());
    whole.command("run 400");
    whole.command("write_restart " + file);
    whole.command("run 300");

    test::LammpsRun second(MPI_COMM_WORLD, restarted(script.lines(), file));
    second.command("run 300");
    const double lost = whole.fix_value("magttice_strip", 4);
    EXPECT_GT(lost, 0);
    EXPECT_NEAR(second.fix_value("magttice_strip", 4) / lost, 1, 1e-9);
    // Sums in another order over 300 steps.
    EXPECT_LE(largest_difference(whole.gather("x"), second.gather("x")), 1e-14);
    // Without the states the strip would be elsewhere.
    test::AloneAndTogether runs(input);
    for (const char* line : {"run 400", "run 300"}) runs.command(line);
    EXPECT_LT(runs.largest_difference("x"), 1e-14);
    EXPECT_LE(largest_difference(whole.gather("x"), runs.alone.gather("x")), 1e-14);
}

// Drag, a rough platform with its stick points, contact and a field: everything whose
// state is in positions, velocities and the restart file.
TEST(Restart, GoesOnAsTheUninterruptedRunWould) {
    LammpsInput input = test::strip_in_field();
    input.gravity_m_s2 = Vec3{3, 0, -9.81};
    input.drag = Drag{100};
    input.contact = ContactLaw{};
    input.platform = Platform{};
    input.platform->friction = 0.5;
    input.time_step_s *= 0.8;
    const test::SharedScript script(input);
    const std::string file = (script.folder() / "half.restart").string();
    test::LammpsRun whole(MPI_COMM_WORLD, script.lines());
    whole.command("run 1200");
    test::LammpsRun first(MPI_COMM_WORLD, script.lines());
    first.command("run 600");
    first.command("write_restart " + file);
    const double friction = first.fix_value("platform", 1);
    EXPECT_GT(friction, 0);

    test::LammpsRun second(MPI_COMM_WORLD, restarted(script.lines(), file));
    second.command("run 0");
    // Springs stretched by 1 nm between positions of mm, which are rounded to 1e-19 m.
    EXPECT_NEAR(second.fix_value("platform", 1) / friction, 1, 1e-9);
    second.command("run 600");
    const auto u = whole.gather("v");
    const double apart = largest_difference(whole.gather("x"), second.gather("x"));
    const double apart_v = largest_difference(u, second.gather("v"));
    const double fastest = largest_difference(u, std::vector<double>(u.size()));
    // Rounding of forces whose sums run in another order, over 600 steps; a node that
    // touches a step earlier or later would show as 1e-9 m.
    EXPECT_LT(apart, 1e-13 * 3.7e-3);
    EXPECT_LT(apart_v, 1e-10 * fastest);
}

TEST(FixModify, SetsTheWork) {
    test::Run run(test::strip_in_field(), {"fix_modify magttice_strip work 1.25e-7"});
    EXPECT_EQ(run.fix_value("magttice_strip", 2), 1.25e-7);
}

// --- faces that something outside moves

// Each step adds a displacement's gain: a rounding of 4e-19 m, half of the last digit of
// 4 mm, in each of some thousand steps.
constexpr double rounding_m = 1e-15;

// The other, of 0.1 mm in 30 ms along y.
void expect_faces_follow(const MotionCourse& ramp) {
    LammpsInput input = test::bare_strip();
    const Oscillation wave{{0.2e-3, 0, -0.1e-3}, 40, -std::numbers::pi / 2};
    input.bodies[0].clamps = {"x_min", "x_max"};
    input.motions = {{0, {"x_min"}, wave}, {0, {"x_max"}, ramp}};
    constexpr int steps = 3000;
    const double time_s = steps * input.time_step_s;
    ASSERT_GT(time_s, 5e-3);
    ASSERT_LT(time_s, 30e-3);
    test::Run run(input);
    const auto start = run.gather("x");
    run.steps(steps);
    const auto x = run.gather("x");
    const auto v = run.gather("v");
    const auto check = [&](const char* face, const MotionCourse& course) {
        const Vec3 u = displacement_m(course, time_s);
        const Vec3 speed = velocity_m_s(course, time_s);
        for (const int node : input.bodies[0].mesh.faces.at(face)) {
            for (std::size_t d = 0; d < 3; ++d) {
                const std::size_t q = 3 * static_cast<std::size_t>(node) + d;
                EXPECT_NEAR(x[q] - start[q], u[d], rounding_m);
                EXPECT_EQ(v[q], speed[d]);
            }
        }
    };
    check("x_min", wave);
    check("x_max", ramp);
}

TEST(PrescribedMotion, MovedFacesFollowTheirCourse) {
    expect_faces_follow(DisplacementRamp{{0, 0.1e-3, 0}, 30e-3});
    const Formula zero;
    expect_faces_follow(
        FormulaMotion{{zero, Formula{"", "0.05e-3*(1-cos(pi*t/0.03))"}, zero}});
}

// The end of the strip turns by 40 degrees and back about an axis beside it, skew to all
// axes of space: its nodes lie where the exact turn brings them, by Rodrigues' formula
// with the angle at the end, and move and are accelerated as it says.
void expect_face_turns(const MotionCourse& turn, double (*angle_rad)(double time_s)) {
    const auto& turning = std::get<TurningMotion>(turn);
    LammpsInput input = test::bare_strip();
    input.bodies[0].clamps = {"x_max"};
    input.motions = {{0, {"x_max"}, turn}};
    constexpr int steps = 3000;
    const double time_s = steps * input.time_step_s;
    test::Run run(input);
    const auto start = run.gather("x");
    run.steps(steps);
    const auto x = run.gather("x");
    const auto v = run.gather("v");
    const Vec3 k = turning.axis / norm(turning.axis);
    const double a = angle_rad(time_s);
    ASSERT_GT(std::abs(a), 0.1);
    constexpr double apart_s = 1e-6;
    const double rate =
        (angle_rad(time_s + apart_s) - angle_rad(time_s - apart_s)) / (2 * apart_s);
    const double gain =
        (angle_rad(time_s + apart_s) - 2 * a + angle_rad(time_s - apart_s)) /
        (apart_s * apart_s);
    for (const int node : input.bodies[0].mesh.faces.at("x_max")) {
        const auto at = [&](const std::vector<double>& all) {
            return vector_at(all.data() + 3 * static_cast<std::size_t>(node));
        };
        const Vec3 arm = at(start) - turning.about_m;
        const Vec3 now = std::cos(a) * arm + std::sin(a) * cross(k, arm) +
                         (1 - std::cos(a)) * dot(k, arm) * k;
        const Vec3 expected = turning.about_m + now;
        const Vec3 speed = cross(rate * k, now);
        const Vec3 acceleration =
            cross(gain * k, now) + cross(rate * k, cross(rate * k, now));
        const Vec3 found = node_acceleration_m_s2(turn, at(x), time_s);
        for (std::size_t d = 0; d < 3; ++d) {
            // Roundings of the place and of the angle in each step.
            EXPECT_NEAR(at(x)[d], expected[d], 2 * rounding_m);
            // Differences over 1 us: of the rate by 1e-6 of 100 rad/s at arms of 5 mm, of
            // the acceleration by the rounding of the angle, 1e-16 / 1e-12 s2.
            EXPECT_NEAR(at(v)[d], speed[d], 1e-6);
            EXPECT_NEAR(found[d], acceleration[d], 1e-4 * norm(acceleration) + 1e-5);
        }
    }
}

TEST(PrescribedMotion, TurnedFacesFollowTheExactRotation) {
    const Vec3 axis{1, 2, -0.5}, about_m{4e-3, -0.3e-3, 0.5e-3};
    const AngleOscillation swing{0.35, 40, -std::numbers::pi / 2};
    expect_face_turns(TurningMotion{axis, about_m, swing}, [](double t) {
        return 0.35 * (1 - std::cos(2 * std::numbers::pi * 40 * t));
    });
    expect_face_turns(TurningMotion{axis, about_m, Formula{"", "1+0.7*sin(60*t)"}},
                      [](double t) { return 0.7 * std::sin(60 * t); });
}

TEST(PrescribedMotion, OfATurnIsReadAsItIsWritten) {
    for (const char* angle : {"oscillation 0.5 25 -1.5", "angle 0.5*sin(t)"}) {
        const std::string text = std::string("turning 0 1 0 0.25 0 0.5 ") + angle;
        std::vector<std::string> words;
        for (std::istringstream in(text); in >> words.emplace_back();) {
        }
        words.pop_back();
        EXPECT_EQ(motion_words(motion_from(words)), text);
        words.pop_back();
        EXPECT_THROW(motion_from(words), std::invalid_argument);
    }
    EXPECT_THROW(motion_from({"turning", "0", "0", "0", "0", "0", "0", "angle", "t"}),
                 std::invalid_argument);
}

TEST(PrescribedMotion, ABodyComesAlongWithItsFace) {
    LammpsInput input = test::bare_strip();
    input.drag = Drag{220};
    const DisplacementRamp ramp{{1e-3, 0.2e-3, -0.5e-3}, 20e-3};
    input.bodies[0].clamps = {"x_min"};
    input.motions = {{0, {"x_min"}, ramp}};
    test::Run run(input);
    const auto start = run.gather("x");
    run.steps(40000);
    const auto x = run.gather("x");
    // 0.12 s after the ramp's end the lowest mode, 112 rad/s and damped critically, has
    // exp(-13) (1 + 13) = 3e-5 of its swing left, which is below the ramp's length.
    for (std::size_t q = 0; q < x.size(); ++q)
        EXPECT_NEAR(x[q] - start[q], ramp.displacement_m[q % 3], 1e-7);
}

TEST(PrescribedMotion, StartsAtTheFaceAndGoesOnWithoutAJump) {
    const Oscillation wave{{1e-3, 0, 0}, 10, 0.7};
    const DisplacementRamp ramp{{1e-3, 0, 0}, 0.05};
    const Formula zero;
    const FormulaMotion formula{{Formula{"", "1e-3*sin(20*pi*t+0.7)"}, zero, zero}};
    for (const MotionCourse& course :
         {MotionCourse(wave), MotionCourse(ramp), MotionCourse(formula)}) {
        EXPECT_EQ(displacement_m(course, 0), (Vec3{}));
        for (double t = 0.001; t < 0.1; t += 0.0073) {
            constexpr double step = 1e-6;
            const double slope = (displacement_m(course, t + step)[0] -
                                  displacement_m(course, t - step)[0]) /
                                 (2 * step);
            // Central differences: u''' step^2 / 6 is 4e-8 m/s, rounding of u 1e-13.
            EXPECT_NEAR(velocity_m_s(course, t)[0], slope, 1e-7);
            const double bend =
                (velocity_m_s(course, t + step)[0] - velocity_m_s(course, t - step)[0]) /
                (2 * step);
            // Of up to 4 m/s2, as above.
            EXPECT_NEAR(acceleration_m_s2(course, t)[0], bend, 1e-5);
        }
    }
    // Five points 10 us apart: u''''' step^4 / 30 is 3e-16 m/s and rounding of u 1e-13
    // m/s and 1e-8 m/s2; the angle's rounding counts less.
    for (double t = 0.001; t < 0.1; t += 0.0073) {
        EXPECT_NEAR(displacement_m(formula, t)[0], displacement_m(wave, t)[0], 1e-17);
        EXPECT_NEAR(velocity_m_s(formula, t)[0], velocity_m_s(wave, t)[0], 1e-12);
        EXPECT_NEAR(acceleration_m_s2(formula, t)[0], acceleration_m_s2(wave, t)[0],
                    1e-6);
    }
    EXPECT_EQ(motion_words(motion_from({"formula", "t", "0", "2*t"})), "formula t 0 2*t");
    EXPECT_THROW(motion_from({"formula", "t", "0", "sin("}), std::invalid_argument);
    EXPECT_EQ(displacement_m(motion_from({"ramp", "1", "2", "3", "4"}), 4),
              (Vec3{1, 2, 3}));
}

}  // namespace
}  // namespace magfsi::structure
