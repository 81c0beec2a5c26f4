// SPDX-License-Identifier: GPL-2.0-or-later
// Dictionaries of a user's: what is merged, and what is refused before OpenFOAM sees it.
#include "adapters/solvers/openfoam/user_files.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <stdexcept>

namespace {

using namespace magfsi;

// A scene's fluid with one of the three files, which has this text.
scene::Fluid with(std::optional<std::string> scene::OpenFoam::*key,
                  const std::string& text) {
    static const auto folder = [] {
        auto made = std::filesystem::temp_directory_path() /
                    ("magfsi-user-files-" + std::to_string(getpid()));
        std::filesystem::create_directories(made);
        return made;
    }();
    std::ofstream(folder / "file") << text;
    scene::Fluid fluid;
    fluid.openfoam.emplace();
    (*fluid.openfoam).*key = (folder / "file").string();
    return fluid;
}

// The message with which the text is refused; empty if it is not.
std::string refusal(std::optional<std::string> scene::OpenFoam::*key,
                    const std::string& text) {
    try {
        openfoam::read_user_files(with(key, text));
    } catch (const std::invalid_argument& e) {
        return e.what();
    }
    return "";
}

constexpr auto schemes = &scene::OpenFoam::schemes;
constexpr auto solution = &scene::OpenFoam::solution;
constexpr auto functions = &scene::OpenFoam::functions;

bool has(const std::string& text, const std::string& part) {
    return text.find(part) != std::string::npos;
}

TEST(UserFiles, NoKeyIsNoFile) {
    const auto files = openfoam::read_user_files({});
    EXPECT_FALSE(files.schemes || files.solution || files.functions);
}

TEST(UserFiles, TheTextIsKeptAsItIs) {
    const std::string text =
        "/* mine */ FoamFile { version 2.0; }\n"
        "divSchemes { div(phi,U) Gauss linearUpwind grad(U); }\n"
        "ddtSchemes { default Euler; } // of first order\n";
    EXPECT_EQ(openfoam::read_user_files(with(schemes, text)).schemes, text);
}

TEST(UserFiles, FunctionsStandAloneOrInTheirGroup) {
    const std::string one = "probe { type probes; libs (sampling); fields (p U); }";
    EXPECT_FALSE(openfoam::read_user_files(with(functions, one)).functions_are_grouped);
    const auto grouped = with(functions, "functions { " + one + " }");
    EXPECT_TRUE(openfoam::read_user_files(grouped).functions_are_grouped);
}

TEST(UserFiles, AFaultHasKeyAndLine) {
    const std::string said = refusal(schemes,
                                     "// first\nddtSchemes\n{\n"
                                     "    default steadyState;\n}\n");
    EXPECT_TRUE(has(said, "fluid.openfoam.schemes: ")) << said;
    EXPECT_TRUE(has(said, "file:4: found ddtSchemes.default steadyState")) << said;
    EXPECT_TRUE(has(said, "'Euler'")) << said;
}

// Each would lose state of a checkpoint, leave divergence, or be passed over.
TEST(UserFiles, WhatBreaksTheCouplingIsRefused) {
    for (const char* text :
         {"ddtSchemes { default backward; }",
          "ddtSchemes { default backward 0; ddt(U) CrankNicolson 0.9; }",
          "PIMPLE { nCorrectors 2; }"})
        EXPECT_NE(refusal(schemes, text), "") << text;
    for (const char* text :
         {"PIMPLE { nCorrectors 0; }", "PIMPLE { frozenFlow yes; }",
          "PIMPLE { pRefPoint (0 0 0); }", "SIMPLE { nNonOrthogonalCorrectors 1; }"})
        EXPECT_NE(refusal(solution, text), "") << text;
    for (const char* text : {"a { type setTimeStep; }", "functions { a { type abort; } }",
                             "functions { } deltaT 1e-3;", "b { type runTimeControl; }"})
        EXPECT_NE(refusal(functions, text), "") << text;
}

// A scene may come from a stranger.
TEST(UserFiles, CodeAndFilesElsewhereAreRefused) {
    for (const char* text : {
             "a { type coded; libs (utilityFunctionObjects); }",
             "a { type systemCall; executeCalls (\"rm x\"); }",
             "x #calc \"1 + 1\";",
             "x #codeStream { code #{ os << 1; #}; };",
             "#include \"/tmp/other\"",
             "#includeIfPresent \"other\"",
             "#includeEtc \"../../tmp/other\"",
             "#includeFunc ../other",
             "#remove solvers",
             "a { type probes; libs (\"/tmp/libmine.so\"); }",
             "a { type probes; libs($mine); }",
             "list ( b { libs (\"./mine.so\"); } );",
         })
        EXPECT_NE(refusal(functions, text), "") << text;
    EXPECT_EQ(refusal(functions, "x #eval{ 2*3 };\n#includeFunc residuals\n"), "");
}

TEST(UserFiles, AnEntryWithoutAnEndIsRefused) {
    EXPECT_NE(refusal(solution, "PIMPLE { nCorrectors 2"), "");
    EXPECT_NE(refusal(solution, "PIMPLE { nCorrectors 2; } }"), "");
    EXPECT_NE(refusal(solution, "PIMPLE { nCorrectors 2;"), "");
}

TEST(UserFiles, RelaxationIsSeen) {
    const auto fluid = with(solution, "relaxationFactors { equations { U 0.8; } }");
    EXPECT_TRUE(openfoam::read_user_files(fluid).has_relaxation);
}

}  // namespace
