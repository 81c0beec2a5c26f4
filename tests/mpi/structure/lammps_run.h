// SPDX-License-Identifier: GPL-2.0-or-later
// LAMMPS with our styles in a test: runs the script of an input, on any ranks.
#pragma once

#include <mpi.h>
#include <stdlib.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <memory>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "input.h"
#include "lammps.h"
#include "library.h"
#include "structure/lammps/register_styles.h"
#include "structure/lammps/script.h"

namespace magfsi::structure::test {

inline double largest_difference(const std::vector<double>& a,
                                 const std::vector<double>& b) {
    double out = 0;
    for (std::size_t i = 0; i < a.size(); ++i) out = std::max(out, std::abs(a[i] - b[i]));
    return out;
}

// A script and its files in a temporary folder that all ranks of the world share: written
// by rank 0, the same lines everywhere.
class SharedScript {
  public:
    explicit SharedScript(const LammpsInput& input) {
        MPI_Comm_rank(MPI_COMM_WORLD, &rank_);
        std::string text;
        if (rank_ == 0) {
            std::string name = std::filesystem::temp_directory_path() / "magfsi.XXXXXX";
            if (mkdtemp(name.data()) == nullptr) throw std::runtime_error("no folder");
            text = name + '\n';
            for (const std::string& line : write_lammps_input(input, name).setup)
                text += line + '\n';
        }
        auto size = static_cast<int>(text.size());
        MPI_Bcast(&size, 1, MPI_INT, 0, MPI_COMM_WORLD);
        text.resize(static_cast<std::size_t>(size));
        MPI_Bcast(text.data(), size, MPI_CHAR, 0, MPI_COMM_WORLD);
        std::istringstream in(text);
        for (std::string line; std::getline(in, line);) lines_.push_back(line);
        folder_ = lines_.front();
        lines_.erase(lines_.begin());
    }
    ~SharedScript() {
        MPI_Barrier(MPI_COMM_WORLD);
        std::error_code ignored;
        if (rank_ == 0) std::filesystem::remove_all(folder_, ignored);
    }
    const std::filesystem::path& folder() const { return folder_; }
    const std::vector<std::string>& lines() const { return lines_; }

  private:
    int rank_ = 0;
    std::filesystem::path folder_;
    std::vector<std::string> lines_;
};

class LammpsRun {
  public:
    LammpsRun(MPI_Comm comm, const std::vector<std::string>& lines) {
        std::vector<std::string> words{"magfsi",  "-log", "none",
                                       "-screen", "none", "-nocite"};
        std::vector<char*> arguments;
        for (std::string& word : words) arguments.push_back(word.data());
        lammps_ = std::make_unique<LAMMPS_NS::LAMMPS>(static_cast<int>(words.size()),
                                                      arguments.data(), comm);
        register_styles(*lammps_);
        for (const std::string& line : lines) command(line);
    }
    void command(const std::string& line) { lammps_->input->one(line); }
    void steps(int count) { command("run " + std::to_string(count) + " pre no post no"); }

    // Three values per atom, by atom ID. Collective, as all below.
    std::vector<double> gather(std::string name) {
        std::vector<double> out(3 * static_cast<std::size_t>(atoms()));
        lammps_gather_atoms(lammps_.get(), name.data(), 1, 3, out.data());
        return out;
    }
    int atoms() { return static_cast<int>(lammps_get_natoms(lammps_.get())); }

    // Entry of the global vector of a fix.
    double fix_value(const std::string& id, int entry) {
        return taken(lammps_extract_fix(lammps_.get(), id.c_str(), LMP_STYLE_GLOBAL,
                                        LMP_TYPE_VECTOR, entry, 0));
    }
    double fix_scalar(const std::string& id) {
        return taken(lammps_extract_fix(lammps_.get(), id.c_str(), LMP_STYLE_GLOBAL,
                                        LMP_TYPE_SCALAR, 0, 0));
    }
    double variable(const std::string& name) {
        return taken(lammps_extract_variable(lammps_.get(), name.c_str(), nullptr));
    }
    // Entry of the global vector of a compute.
    double compute_value(const std::string& id, int entry) {
        const auto* values = static_cast<double*>(lammps_extract_compute(
            lammps_.get(), id.c_str(), LMP_STYLE_GLOBAL, LMP_TYPE_VECTOR));
        if (values == nullptr) throw std::runtime_error("no compute " + id);
        return values[entry];
    }
    // IDs of the atoms that this rank owns, ascending.
    std::vector<int> owned() {
        const auto* tags = static_cast<const int*>(
            lammps_extract_atom(lammps_.get(), const_cast<char*>("id")));
        std::vector<int> ids(tags,
                             tags + lammps_extract_setting(lammps_.get(), "nlocal"));
        std::ranges::sort(ids);
        return ids;
    }

  private:
    static double taken(void* value) {
        if (value == nullptr) throw std::runtime_error("no such value");
        const double out = *static_cast<double*>(value);
        lammps_free(value);
        return out;
    }
    std::unique_ptr<LAMMPS_NS::LAMMPS> lammps_;
};

// An input on all ranks, up to the forces of step 0; before it, more commands.
struct Run : SharedScript, LammpsRun {
    explicit Run(const LammpsInput& input, const std::vector<std::string>& more = {})
        : SharedScript(input), LammpsRun(MPI_COMM_WORLD, lines()) {
        for (const std::string& line : more) command(line);
        command("run 0");
    }
};

// The same input on one rank and on all, which run the same commands.
struct AloneAndTogether : SharedScript {
    LammpsRun alone, together;

    explicit AloneAndTogether(const LammpsInput& input)
        : SharedScript(input),
          alone(MPI_COMM_SELF, lines()),
          together(MPI_COMM_WORLD, lines()) {}
    void command(const std::string& text) {
        alone.command(text);
        together.command(text);
    }
    double largest_difference(const std::string& name) {
        return test::largest_difference(alone.gather(name), together.gather(name));
    }
};

}  // namespace magfsi::structure::test
