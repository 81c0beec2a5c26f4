// SPDX-License-Identifier: GPL-2.0-or-later
// A reader of OpenFOAM's dictionaries that finds keys, values and directives without
// expanding anything: what a stranger's scene brings along must be seen before OpenFOAM
// reads it, because dictionaries can compile and run code. The engine forbids code once
// more (pimple_engine.cpp).
#include "adapters/solvers/openfoam/user_files.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <fstream>
#include <span>
#include <sstream>
#include <stdexcept>
#include <string_view>
#include <vector>

namespace magfsi::openfoam {

namespace {

using Words = std::span<const std::string_view>;

// A file and the key of the scene that names it, for errors.
struct Source {
    const char* key;
    std::string file;

    [[noreturn]] void refuse(int line, const std::string& found,
                             std::string_view allowed) const {
        throw std::invalid_argument(fmt::format("fluid.openfoam.{}: {}:{}: found {}; {}",
                                                key, file, line, found, allowed));
    }
};

// A word, a string with its quotes, or one of { } ; as text.
struct Token {
    std::string text;
    int line = 1;

    bool is(std::string_view other) const { return text == other; }
};

// Splits a dictionary into tokens. Words may hold brackets, such as div(phi,U); the
// brackets of lists stick to their words, which no rule below minds.
class Tokens {
  public:
    explicit Tokens(const std::string& text) : text_(text) {}

    std::vector<Token> all() {
        std::vector<Token> tokens;
        while (skip_blanks()) {
            const int line = line_;
            tokens.push_back({next(), line});
        }
        return tokens;
    }

  private:
    bool at(std::string_view what) const {
        return text_.compare(i_, what.size(), what) == 0;
    }
    void step() { line_ += text_[i_++] == '\n' ? 1 : 0; }

    // Skips blanks and comments; false at the end of the text.
    bool skip_blanks() {
        while (i_ < text_.size()) {
            if (at("//")) {
                while (i_ < text_.size() && text_[i_] != '\n') step();
            } else if (at("/*")) {
                while (i_ < text_.size() && !at("*/")) step();
                for (int n = 0; n < 2 && i_ < text_.size(); ++n) step();
            } else if (std::isspace(static_cast<unsigned char>(text_[i_])) != 0) {
                step();
            } else {
                return true;
            }
        }
        return false;
    }

    std::string next() {
        const std::size_t first = i_;
        if (at("{") || at("}") || at(";")) {
            step();
        } else if (at("\"")) {
            step();
            while (i_ < text_.size() && !at("\"")) {
                if (at("\\")) step();
                if (i_ < text_.size()) step();
            }
            if (i_ < text_.size()) step();
        } else if (at("${")) {  // a macro in braces is one word
            while (i_ < text_.size() && !at("}")) step();
            if (i_ < text_.size()) step();
        } else {
            do step();
            while (i_ < text_.size() && !ends_word());
        }
        return text_.substr(first, i_ - first);
    }
    bool ends_word() const {
        return std::isspace(static_cast<unsigned char>(text_[i_])) != 0 ||
               std::string_view("{};\"").find(text_[i_]) != std::string_view::npos ||
               at("//") || at("/*");
    }

    const std::string& text_;
    std::size_t i_ = 0;
    int line_ = 1;
};

// An entry at some depth: the keys that lead to it and its value's tokens; groups have
// none.
struct Entry {
    std::vector<std::string> path;
    std::vector<std::string> value;
    bool group = false;
    int line = 1;

    std::string name() const { return fmt::format("{}", fmt::join(path, ".")); }
    std::string text() const { return fmt::format("{}", fmt::join(value, " ")); }
};

// Finds the entries of a dictionary. Directives and macros that stand in place of an
// entry are skipped with the rest of their line; check_tokens() has seen them.
std::vector<Entry> entries_of(const std::vector<Token>& tokens, const Source& source) {
    std::vector<Entry> entries;
    std::vector<std::string> path;
    std::size_t i = 0;
    while (i < tokens.size()) {
        const Token& token = tokens[i];
        if (token.is("}")) {
            if (path.empty()) source.refuse(token.line, "a } too many", "remove it");
            path.pop_back();
            ++i;
        } else if (token.is(";")) {
            ++i;
        } else if (token.text.starts_with('#') || token.text.starts_with('$')) {
            while (i < tokens.size() && tokens[i].line == token.line &&
                   !tokens[i].is("}") && !tokens[i].is(";"))
                ++i;
        } else {
            Entry entry{path, {}, false, token.line};
            entry.path.push_back(token.text);
            ++i;
            if (i < tokens.size() && tokens[i].is("{")) {
                entry.group = true;
                path = entry.path;
                ++i;
            } else {
                int depth = 0;  // of dictionaries in a list
                for (; i < tokens.size() && (depth > 0 || !tokens[i].is(";")); ++i) {
                    depth += tokens[i].is("{") ? 1 : tokens[i].is("}") ? -1 : 0;
                    if (depth < 0) break;
                    entry.value.push_back(tokens[i].text);
                }
                if (i == tokens.size() || depth < 0)
                    source.refuse(
                        entry.line,
                        fmt::format("the entry {} without an end", entry.name()),
                        "put a ; behind its value");
            }
            entries.push_back(std::move(entry));
        }
    }
    if (!path.empty())
        source.refuse(tokens.back().line,
                      fmt::format("the group {} without an end", fmt::join(path, ".")),
                      "put a } behind its entries");
    return entries;
}

bool one_of(std::string_view word, Words words) {
    return std::ranges::find(words, word) != words.end();
}

// Directives that neither run code nor read files from anywhere but OpenFOAM's own
// folders.
constexpr auto harmless_directives = std::to_array<std::string_view>(
    {"#includeEtc", "#includeFunc", "#eval", "#if", "#ifeq", "#else", "#endif"});
// Function objects that run code or change the run. The coupling sets step and end.
constexpr auto harmful_types =
    std::to_array<std::string_view>({"coded", "codedFunctionObject", "systemCall",
                                     "setTimeStep", "runTimeControl", "abort"});
// Groups that OpenFOAM reads from the two dictionaries.
constexpr auto groups_of_schemes = std::to_array<std::string_view>(
    {"ddtSchemes", "d2dt2Schemes", "gradSchemes", "divSchemes", "laplacianSchemes",
     "interpolationSchemes", "snGradSchemes", "fluxRequired", "wallDist"});
constexpr auto groups_of_solution =
    std::to_array<std::string_view>({"solvers", "PIMPLE", "relaxationFactors", "cache"});

// A directive, and the name that follows it. Two tokens may stick together, as in
// #eval{...}.
void check_directive(const Token& token, const Token* next, const Source& source) {
    const std::size_t end = token.text.find_first_of("({\"", 1);
    const std::string word = token.text.substr(0, end);
    if (!one_of(word, harmless_directives)) {
        source.refuse(
            token.line, word,
            fmt::format(
                "allowed are {}: put what #include names into this file, of which "
                "the case keeps a copy, and write #eval for #calc",
                fmt::join(harmless_directives, ", ")));
    }
    if (word != "#includeEtc" && word != "#includeFunc") return;
    if (!next || next->text.find("..") != std::string::npos ||
        next->text.find('$') != std::string::npos || next->text.starts_with("\"/"))
        source.refuse(token.line,
                      fmt::format("{} {}", word, next ? next->text : std::string()),
                      "name a file of OpenFOAM's own, without .. and $");
}

// Libraries are found by the loader; a path could name any file.
void check_library(const Token& token, const Source& source) {
    if (token.text.find_first_of("/$#") == std::string::npos) return;
    source.refuse(token.line, fmt::format("the library {}", token.text),
                  "name libraries without folders and macros, as in libs "
                  "(fieldFunctionObjects); the loader finds others by LD_LIBRARY_PATH");
}

// Rules that hold wherever a word stands, also in lists.
void check_tokens(const std::vector<Token>& tokens, const Source& source) {
    for (std::size_t i = 0; i < tokens.size(); ++i) {
        const Token& token = tokens[i];
        const Token* next = i + 1 < tokens.size() ? &tokens[i + 1] : nullptr;
        if (token.text.starts_with('#')) check_directive(token, next, source);
        const std::string word = token.text.substr(0, token.text.find('('));
        if (word == "libs" || word == "functionObjectLibs") {
            for (std::size_t k = i; k < tokens.size() && !tokens[k].is(";"); ++k)
                check_library(tokens[k], source);
        }
        if (token.is("type") && next && one_of(next->text, harmful_types)) {
            source.refuse(next->line, fmt::format("the type {}", next->text),
                          "a scene's functions observe: none runs programs or sets the "
                          "step or the end, which are time.step and time.end");
        }
    }
}

// Groups at the top that the file may have; others would be passed over in silence.
void check_groups(const std::vector<Entry>& entries, Words allowed,
                  const Source& source) {
    for (const Entry& entry : entries) {
        if (!entry.group || entry.path.size() > 1 || entry.path[0] == "FoamFile")
            continue;
        if (!one_of(entry.path[0], allowed))
            source.refuse(entry.line, fmt::format("the group {}", entry.path[0]),
                          fmt::format("allowed are {}", fmt::join(allowed, ", ")));
    }
}

// Checkpoints and repeated steps hold the velocities of two steps and the last fluxes:
// what a scheme keeps beyond that would be lost, and one without steps in time cannot
// follow bodies.
void check_schemes(const std::vector<Entry>& entries, const Source& source) {
    check_groups(entries, groups_of_schemes, source);
    for (const Entry& entry : entries) {
        if (entry.path[0] != "ddtSchemes" || entry.group) continue;
        const std::string value = entry.text();
        if (value == "Euler" || value == "backward 0") continue;
        source.refuse(entry.line, fmt::format("{} {}", entry.name(), value),
                      "allowed are 'backward 0' and 'Euler', the schemes whose state a "
                      "checkpoint holds (0: without the correction of fluxes by their "
                      "old values)");
    }
}

// Entries of PIMPLE without which a step is none.
void check_solution(const std::vector<Entry>& entries, const Source& source) {
    check_groups(entries, groups_of_solution, source);
    for (const Entry& entry : entries) {
        if (entry.path.size() != 2 || entry.path[0] != "PIMPLE") continue;
        const std::string& word = entry.path[1];
        const std::string found = fmt::format("{} {}", entry.name(), entry.text());
        if ((word == "nCorrectors" || word == "nOuterCorrectors") &&
            (entry.text() == "0" || entry.text().starts_with('-')))
            source.refuse(entry.line, found,
                          "take 1 or more: the coupling needs a flow without divergence");
        if (word == "frozenFlow" || word == "solveFlow")
            source.refuse(entry.line, found,
                          "remove it: the coupling needs the flow to be solved");
        if (word == "pRefPoint")
            source.refuse(entry.line, found,
                          "write pRefCell: the generated case has that, and OpenFOAM "
                          "takes the first of the two");
    }
}

bool has_group(const std::vector<Entry>& entries, std::string_view name) {
    return std::ranges::any_of(entries, [&](const Entry& entry) {
        return entry.group && entry.path.size() == 1 && entry.path[0] == name;
    });
}

// Beside functions {} nothing else of controlDict may be set.
void check_functions(const std::vector<Entry>& entries, const Source& source) {
    if (!has_group(entries, "functions")) return;
    for (const Entry& entry : entries) {
        if (entry.path[0] == "functions" || entry.path[0] == "FoamFile") continue;
        source.refuse(entry.line, fmt::format("{} beside functions", entry.name()),
                      "allowed are function objects alone: step, end and interval come "
                      "from time.step, time.end and fluid.openfoam.write");
    }
}

// One file with its tokens and entries checked; nothing if the scene names none.
struct Dictionary {
    std::string text;
    std::vector<Entry> entries;
};
std::optional<Dictionary> read(const Source& source) {
    if (source.file.empty()) return {};
    std::ifstream in(source.file, std::ios::binary);
    std::ostringstream text;
    if (in) text << in.rdbuf();
    if (!in)
        throw std::invalid_argument(fmt::format(
            "fluid.openfoam.{}: the file {} cannot be read", source.key, source.file));
    Dictionary made{text.str(), {}};
    if (made.text.find('\0') != std::string::npos)
        source.refuse(1, "a binary file", "allowed are OpenFOAM's dictionaries as text");
    const auto tokens = Tokens(made.text).all();
    check_tokens(tokens, source);
    made.entries = entries_of(tokens, source);
    return made;
}

}  // namespace

UserFiles read_user_files(const scene::Fluid& fluid) {
    UserFiles files;
    if (!fluid.openfoam) return files;
    const scene::OpenFoam& given = *fluid.openfoam;
    const Source schemes{"schemes", given.schemes.value_or("")};
    if (const auto read_in = read(schemes)) {
        check_schemes(read_in->entries, schemes);
        files.schemes = read_in->text;
    }
    const Source solution{"solution", given.solution.value_or("")};
    if (const auto read_in = read(solution)) {
        check_solution(read_in->entries, solution);
        files.solution = read_in->text;
        files.has_relaxation = has_group(read_in->entries, "relaxationFactors");
    }
    const Source functions{"functions", given.functions.value_or("")};
    if (const auto read_in = read(functions)) {
        check_functions(read_in->entries, functions);
        files.functions = read_in->text;
        files.functions_are_grouped = has_group(read_in->entries, "functions");
    }
    return files;
}

}  // namespace magfsi::openfoam
