#include <gtest/gtest.h>

#include "tests/mpi/structure/lammps_run.h"
#include "tests/mpi/structure/strip.h"

namespace magfsi::structure {
namespace {

struct Stopped : std::runtime_error {
    using std::runtime_error::runtime_error;
};

// The cause that the handler is given by `lines` after the strip's own script. One rank:
// the handler throws, which would leave other ranks waiting.
std::string cause_of(const LammpsInput& input, const std::vector<std::string>& lines) {
    set_failure_handler([](const std::string& cause) { throw Stopped(cause); });
    const test::SharedFolder folder;
    std::string cause = "no failure";
    try {
        test::LammpsRun run(MPI_COMM_SELF, folder.write(input).setup);
        for (const std::string& line : lines) run.command(line);
    } catch (const Stopped& stopped) {
        cause = stopped.what();
    }
    set_failure_handler({});
    return cause;
}

bool has(const std::string& text, const std::string& part) {
    return text.find(part) != std::string::npos;
}

TEST(InvertedElement, IsNamedInTheStepItHappens) {
    // Atom 1 is thrown through its element, element 0: 1.4 mm along x in one step, where
    // four edges of 0.185 mm turn the mean deformation gradient over.
    const std::string cause =
        cause_of(test::strip_in_field(),
                 {"group one id 1", "velocity one set 400.0 0.0 0.0", "run 0", "run 10"});
    EXPECT_TRUE(
        has(cause, "fix magttice_strip magttice: element 0 is inverted at step 1"))
        << cause;
    EXPECT_TRUE(has(cause, "its volume ratio J is -")) << cause;
    // Its centre at rest is half an edge from the corner.
    EXPECT_TRUE(has(cause, "(body strip, centre now at (")) << cause;
    EXPECT_TRUE(has(cause, "rest (9.25e-05, 9.375e-05, 4.625e-05) m)")) << cause;
    EXPECT_TRUE(has(cause, "smaller time step")) << cause;
}

TEST(InvertedElement, APositionThatIsNotANumberIsNoticed) {
    // The last atom, of element 319 alone: 1e308 times 1e10 s overflows, and infinity
    // minus infinity is not a number.
    const std::string cause = cause_of(
        test::strip_in_field(), {"group one id 567", "velocity one set 1e308 1e308 1e308",
                                 "run 0", "timestep 1e10", "run 3 pre no"});
    EXPECT_TRUE(has(cause, "element 319 is inverted at step 1")) << cause;
    EXPECT_TRUE(has(cause, "which is not a number")) << cause;
}

TEST(BadArguments, AreRefusedInOneSentence) {
    const LammpsInput input = test::strip_in_field();
    EXPECT_TRUE(has(cause_of(input, {"fix a all magttice /nowhere 1 1 1"}),
                    "cannot open the lattice file /nowhere"));
    EXPECT_TRUE(has(cause_of(input, {"fix a all magttice x 1 1 1 element half"}),
                    "element half found; full, mean_f and assumed_strain are allowed"));
    EXPECT_TRUE(has(cause_of(input, {"fix a all magttice x 1 1 1 field 0 0"}),
                    "\"field\" with 2 values found, it takes 3"));
    EXPECT_TRUE(has(cause_of(input, {"fix a all magttice x 1 1 1 viscosity"}),
                    "\"viscosity\" with 0 values found, it takes 1"));
    EXPECT_TRUE(has(cause_of(input, {"fix a all magttice x 1 1 1 fields 0 0 0"}),
                    "\"fields\" found; allowed are element, material, field, gradient, "
                    "viscosity"));
    EXPECT_TRUE(
        has(cause_of(input, {"fix a all magttice x 1 1 1 field 0 0 1 field 0 0 2"}),
            "\"field\" found twice"));
    EXPECT_TRUE(has(cause_of(input, {"fix a all magttice/field xz constant 1"}),
                    "constant has 2"));
}

TEST(BadArguments, AFieldWithoutItsVariableIsRefused) {
    LammpsInput input = test::strip_in_field();
    EXPECT_TRUE(has(cause_of(input, {"variable Bx delete", "run 0"}),
                    "names variable Bx, an equal-style variable is needed"));
}

TEST(BadArguments, AtomsThatDoNotMatchTheLatticeAreCounted) {
    const std::string cause =
        cause_of(test::strip_in_field(),
                 {"group end id 560:567", "delete_atoms group end", "run 0"});
    EXPECT_TRUE(has(cause, "has 567 nodes in its lattice file, but 55")) << cause;
}

}  // namespace
}  // namespace magfsi::structure
