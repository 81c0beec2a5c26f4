// SPDX-License-Identifier: GPL-2.0-or-later
// What bodies and loads do in real LAMMPS, against laws that hold without it: energy,
// momentum, decay, weight.
#include <gtest/gtest.h>

#include <cmath>

#include "structure/body.h"
#include "structure/lammps/field_program.h"
#include "tests/mpi/structure/lammps_run.h"
#include "tests/mpi/structure/strip.h"
#include "tests/support/checks.h"

namespace magfsi::structure {
namespace {

struct Vibration {
    double drift = 0;  // largest change of the total energy over the energy at start
    double largest_kinetic = 0;  // over the energy at start
};

// 14 ms of a strip let go from the V of 5 mT.
Vibration vibrate(int refinement) {
    LammpsInput input = test::released_strip();
    input.time_step_s /= refinement;
    test::Run run(input);
    const double start = run.fix_value("magttice_strip", 0);
    Vibration out;
    for (int i = 0; i < 40; ++i) {
        run.steps(100 * refinement);
        const double kinetic = test::kinetic_energy(input.bodies[0], run.gather("v"));
        const double total = kinetic + run.fix_value("magttice_strip", 0);
        out.drift = std::max(out.drift, std::abs(total - start) / start);
        out.largest_kinetic = std::max(out.largest_kinetic, kinetic / start);
    }
    return out;
}

TEST(Energy, OfAFreeVibrationStaysToSecondOrder) {
    const Vibration coarse = vibrate(1);
    const Vibration fine = vibrate(2);
    EXPECT_GT(coarse.largest_kinetic, 0.5);  // it does swing through
    // Velocity Verlet keeps a shadow energy, off by (omega dt)^2 / 8 of the energy of
    // each mode: the stiff modes (omega dt about 1) hold less than a hundredth of it.
    EXPECT_LT(coarse.drift, 1e-3);
    // Four times less, give or take what the samples every 0.35 ms miss.
    EXPECT_LT(fine.drift, coarse.drift / 3);
}

TEST(Energy, OfAMovedBodyIsTheWorkOfTheField) {
    const LammpsInput input = test::strip_in_field();
    test::Run run(input);
    double largest = 0, worst = 0;
    for (int chunk = 0; chunk < 40; ++chunk) {
        run.steps(100);
        const double work = run.fix_value("magttice_strip", 2);
        const double energy = test::kinetic_energy(input.bodies[0], run.gather("v")) +
                              run.fix_value("magttice_strip", 0);
        largest = std::max(largest, std::abs(work));
        worst = std::max(worst, std::abs(work - energy));
    }
    EXPECT_GT(largest, 1e-8);
    // As above; the sudden start of the field also excites stiffer modes.
    EXPECT_LT(worst, 5e-3 * largest);
}

TEST(Viscosity, TakesTheEnergyThatIsLost) {
    LammpsInput input = test::released_strip();
    input.bodies[0].material.viscosity_pa_s = 2;
    input.time_step_s = 0.9 * stable_step_s(input.bodies[0]);
    test::Run run(input);
    const double start = run.fix_value("magttice_strip", 0);
    run.steps(8000);
    const double left = test::kinetic_energy(input.bodies[0], run.gather("v")) +
                        run.fix_value("magttice_strip", 0);
    const double lost = run.fix_value("magttice_strip", 4);
    EXPECT_GT(lost, 0.1 * start);
    // The loss is summed with the velocity of the half step before: first order in the
    // step times the frequency of the modes that lose the energy, 1e-3.
    EXPECT_NEAR((left + lost) / start, 1, 1e-2);
}

// A strip that stiffens swings without loss, too.
TEST(Stiffening, KeepsTheEnergyOfAFreeVibration) {
    LammpsInput input = test::released_strip();
    input.bodies[0].material.stiffening = Gent{0.5};
    input.time_step_s = 0.8 * stable_step_s(input.bodies[0]);
    test::Run run(input);
    const double start = run.fix_value("magttice_strip", 0);
    double drift = 0;
    for (int i = 0; i < 40; ++i) {
        run.steps(100);
        const double total = test::kinetic_energy(input.bodies[0], run.gather("v")) +
                             run.fix_value("magttice_strip", 0);
        drift = std::max(drift, std::abs(total - start) / start);
    }
    EXPECT_LT(drift, 1e-3);  // the shadow energy, as of the neo-Hookean strip
}

// A branch of the time of the swing takes its energy; what is stored in branches counts
// as elastic.
TEST(Viscoelasticity, TakesTheEnergyThatIsLost) {
    LammpsInput input = test::released_strip();
    input.bodies[0].material.branches = {{10e3, 2e-3}, {5e3, 1e-6}};
    input.time_step_s = 0.9 * stable_step_s(input.bodies[0]);
    test::Run run(input);
    const double start = run.fix_value("magttice_strip", 0);
    run.steps(6000);
    const double left = test::kinetic_energy(input.bodies[0], run.gather("v")) +
                        run.fix_value("magttice_strip", 0);
    const double lost = run.fix_value("magttice_strip", 4);
    EXPECT_GT(lost, 0.1 * start);
    // The trapezium rule of the loss and the shadow energy of the integration.
    EXPECT_NEAR((left + lost) / start, 1, 3e-3);
}

// The work of the field is that of the moments which it turns.
TEST(TurningMagnetization, GivesTheWorkOfTheFieldToTheBody) {
    LammpsInput input = test::strip_in_field();
    input.bodies[0].follows = MagnetizationFollows::rotation;
    test::Run run(input);
    double largest = 0, worst = 0;
    for (int chunk = 0; chunk < 40; ++chunk) {
        run.steps(100);
        const double work = run.fix_value("magttice_strip", 2);
        const double energy = test::kinetic_energy(input.bodies[0], run.gather("v")) +
                              run.fix_value("magttice_strip", 0);
        largest = std::max(largest, std::abs(work));
        worst = std::max(worst, std::abs(work - energy));
    }
    EXPECT_GT(largest, 1e-8);
    EXPECT_LT(worst, 5e-3 * largest);  // as of the magnetisation that is stretched
}

// What the field and the weight do to a body is elastic, kinetic or lost.
TEST(TwoMaterials, KeepTheBalanceOfEnergy) {
    const LammpsInput input = test::bending_bar();
    const Body& body = input.bodies[0];
    test::Run run(input);
    run.steps(2000);
    const auto mass = build_lattice(body).node_mass_kg;
    const auto x = run.gather("x");
    const double kinetic = test::kinetic_energy(body, run.gather("v"));
    double weight = 0;
    for (std::size_t a = 0; a < mass.size(); ++a)
        weight -= 9.81 * mass[a] * (x[3 * a + 2] - body.mesh.nodes[a][2]);
    const double elastic = run.fix_value("magttice_bar", 0);
    const double work = run.fix_value("magttice_bar", 2);
    const double lost = run.fix_value("magttice_bar", 4);
    EXPECT_GT(lost, 1e-4 * work);
    // The loss is summed with the velocity of the half step: first order in the step
    // times the frequency of the modes that lose the energy; below 1e-2 of it.
    EXPECT_NEAR((elastic + kinetic + lost) / (work + weight), 1, 1e-2);
}

TEST(Gradient, PullsADipoleAndItsWorkIsTheEnergyOfTheBody) {
    LammpsInput input = test::bare_strip();
    Body& body = input.bodies[0];
    body.magnetization_a_m = uniform_magnetization(body.mesh, {62e3, 0, 0});
    input.gradient = GradientInput{{{{0.2, 0, 0}, {0, -0.1, 0}, {0, 0, -0.1}}},
                                   {1.85e-3, 0.75e-3, 0.0925e-3}};
    test::Run run(input);
    run.steps(1000);
    const double t = 1000 * input.time_step_s;
    const auto v = run.gather("v");
    const Vec3 p = test::momentum(body, v);
    // m dv/dt = V (M . grad) B: 62 kA/m times 0.2 T/m in the body's volume.
    const double expected = 3.7e-3 * 1.5e-3 * 0.185e-3 * 62e3 * 0.2 * t;
    const double work = run.fix_value("magttice_strip", 2);
    const double energy =
        test::kinetic_energy(body, v) + run.fix_value("magttice_strip", 0);
    // F M is longer than M by the strain, (62 kA/m * 0.2 T/m * L / 2) / (3 G) = 2e-4.
    EXPECT_NEAR(p[0] / expected, 1, 1e-3);
    EXPECT_NEAR(p[2] / expected, 0, 1e-3);
    // Velocity Verlet's shadow energy, as without a gradient.
    EXPECT_NEAR(energy / work, 1, 5e-3);
}

TEST(Drag, SlowsEveryNodeAtItsRateWhateverItsMass) {
    LammpsInput input = test::bare_strip();
    input.drag = Drag{300};
    test::Run run(input, {"velocity all set 0.1 0.0 -0.2"});
    run.steps(1000);
    const double decay = std::exp(-300 * 1000 * input.time_step_s);
    const auto v = run.gather("v");
    for (std::size_t q = 0; q < v.size(); q += 3) {
        // The force uses the velocity of the half step: first order, rate dt = 1e-3.
        EXPECT_NEAR(v[q], 0.1 * decay, 2e-3 * 0.1);
        EXPECT_NEAR(v[q + 2], -0.2 * decay, 2e-3 * 0.2);
    }
}

TEST(Clamps, HoldTheirNodesAndCarryTheWeight) {
    LammpsInput input = test::bare_strip();
    input.bodies[0].clamps = {"x_min"};
    input.gravity_m_s2 = Vec3{0, 0, -9.81};
    input.drag = Drag{220};
    test::Run run(input);
    const auto start = run.gather("x");
    run.steps(30000);
    const auto x = run.gather("x");
    const auto f = run.gather("f");
    double reaction = 0;
    for (int node : input.bodies[0].mesh.faces.at("x_min")) {
        const auto first = 3 * static_cast<std::size_t>(node);
        for (std::size_t q = first; q < first + 3; ++q) EXPECT_EQ(x[q], start[q]);
        reaction += f[first + 2];
    }
    const double weight = 1860 * 3.7e-3 * 1.5e-3 * 0.185e-3 * 9.81;
    // The lowest mode, 112 rad/s, is damped critically: exp(-110 / s * 0.105 s) is 1e-5
    // of the first swing, times its phase.
    EXPECT_NEAR(reaction / weight, -1, 1e-3);
}

TEST(Rollers, HoldOneCoordinateAndLeaveTheOthersFree) {
    LammpsInput input = test::bare_strip();
    input.bodies[0].rollers = {{{"y_min", "y_max"}, 1}, {{"x_min"}, 0}};
    input.gravity_m_s2 = Vec3{1, 2, -3};
    test::Run run(input);
    const auto start = run.gather("x");
    run.steps(2000);
    const auto x = run.gather("x");
    const double time = 2000 * input.time_step_s;
    const auto held = held_axes(input.bodies[0]);
    double fallen = 0;
    for (std::size_t q = 0; q < x.size(); ++q) {
        EXPECT_TRUE(!held[q / 3][q % 3] || x[q] == start[q]) << "value " << q;
        if (q % 3 == 2) fallen += (x[q] - start[q]) * 3 / static_cast<double>(x.size());
    }
    // Nothing holds it along z: free fall, but for the 2 % that bending moves nodes
    // against the centre of mass, which is not their mean.
    EXPECT_NEAR(fallen / (-1.5 * time * time), 1, 0.02);
}

// What LAMMPS makes of the generated field against the program itself.
TEST(FieldVariables, FollowTheProgram) {
    const FieldProgram table{{0, 2},
                             FieldTable{{0, 0.002, 0.003, 0.004},
                                        {-0.017, 0.017, -0.017, -0.017},
                                        {0.8, 0.9, 1.0, 0.8},
                                        true}};
    const FieldProgram rotation{{1, 2}, RotatingField{0.005, 0.3, 25}};
    const FieldProgram sum{{0, 2},
                           PrecessingField{5e-3, {1, 1, 2}, 0.6, 25, 0.3, 1e-3},
                           {{VectorField{{1e-3, 0, -2e-3}}}}};
    const FieldProgram formula{
        {0, 2}, FormulaField{{{{}, {.si = "0.003*t"}, {.si = "0.012*sin(2*pi*25*t)"}}}}};
    for (const FieldProgram& program : {table, rotation, sum, formula}) {
        LammpsInput input = test::strip_in_field();
        input.field = program;
        test::Run run(input);
        long step = 0;
        for (int steps : {0, 1, 7, 500, 2000}) {
            run.steps(steps);
            step += steps;
            const Vec3 b =
                field_at(program, static_cast<double>(step) * input.time_step_s);
            // The time step is written with 17 digits: nothing is lost.
            EXPECT_EQ(run.variable("Bx"), b[0]) << step;
            EXPECT_EQ(run.variable("By"), b[1]) << step;
            EXPECT_EQ(run.variable("Bz"), b[2]) << step;
        }
        run.command("reset_timestep 123456");
        run.command("run 0");
        EXPECT_EQ(run.variable("Bz"), field_at(program, 123456 * input.time_step_s)[2]);
    }
}

TEST(FieldVariables, TakeAnotherLawBetweenTwoSteps) {
    test::Run run(test::strip_in_field());
    run.steps(7);
    run.command("fix_modify field law xz vector 0.001 -0.002 0.003");
    run.steps(1);
    EXPECT_EQ(run.variable("By"), -0.002);
    EXPECT_EQ(run.variable("Bz"), 0.003);
}

// --- what ends a run

struct Stopped : std::runtime_error {
    using std::runtime_error::runtime_error;
};

// Expects each part in the cause that the failure handler is given by `lines` after the
// strip's own script. One rank: the handler throws, which would leave others waiting.
void expect_stop(const std::vector<std::string>& lines,
                 std::initializer_list<std::string> parts) {
    set_failure_handler([](const std::string& cause) { throw Stopped(cause); });
    const auto cause = test::message_of<Stopped>([&] {
        const test::SharedScript script(test::strip_in_field());
        test::LammpsRun run(MPI_COMM_SELF, script.lines());
        for (const std::string& line : lines) run.command(line);
    });
    set_failure_handler({});
    test::expect_says(cause, parts);
}

TEST(InvertedElement, IsNamedInTheStepItHappens) {
    // Atom 1 is thrown through its element, element 0: 1.4 mm along x in one step, where
    // four edges of 0.185 mm turn the mean deformation gradient over. The centre at rest
    // is half an edge from the corner.
    expect_stop({"group one id 1", "velocity one set 400.0 0.0 0.0", "run 0", "run 10"},
                {"fix magttice_strip magttice: element 0 is inverted at step 1",
                 "its volume ratio J is -", "(body strip, centre now at (",
                 "rest (9.25e-05, 9.375e-05, 4.625e-05) m)", "smaller time step"});
}

TEST(InvertedElement, APositionThatIsNotANumberIsNoticed) {
    // The last atom, of element 319 alone: 1e308 times 1e10 s overflows, and infinity
    // minus infinity is not a number.
    expect_stop({"group one id 567", "velocity one set 1e308 1e308 1e308", "run 0",
                 "timestep 1e10", "run 3 pre no"},
                {"element 319 is inverted at step 1", "which is not a number"});
}

TEST(BadArguments, AreRefusedInOneSentence) {
    expect_stop({"fix a all magttice /nowhere 1 1 1"},
                {"cannot open the lattice file /nowhere"});
    expect_stop({"fix a all magttice x 1 1 1 element half"},
                {"element half found; full and assumed_strain are allowed"});
    expect_stop({"fix a all magttice x 1 1 1 field 0 0"},
                {"\"field\" with 2 values found, it takes 3"});
    expect_stop({"fix a all magttice x 1 1 1 viscosity"},
                {"\"viscosity\" with 0 values found, it takes 1"});
    expect_stop(
        {"fix a all magttice x 1 1 1 fields 0 0 0"},
        {"\"fields\" found; allowed are element, material, stiffening, branch, field, "
         "turned_field, gradient, sources, dipoles, viscosity"});
    expect_stop({"fix a all magttice x 1 1 1 stiffening hard 3"}, {"hard"});
    expect_stop({"fix a all magttice x 1 1 1 branch 5"},
                {"\"branch\" with 1 values found, it takes 2"});
    expect_stop({"fix a all magttice x 1 1 1 field 0 0 1 field 0 0 2"},
                {"\"field\" found twice"});
    expect_stop({"fix a all magttice/field xz constant 1"}, {"constant has 2"});
    expect_stop({"variable Bx delete", "run 0"},
                {"names variable Bx, an equal-style variable is needed"});
    expect_stop({"group end id 560:567", "delete_atoms group end", "run 0"},
                {"has 567 nodes in its lattice file, but 55"});
}

}  // namespace
}  // namespace magfsi::structure
