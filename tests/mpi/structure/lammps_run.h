// LAMMPS with our styles in a test: runs a scene's script on a communicator.
#pragma once

#include <mpi.h>
#include <stdlib.h>

#include <array>
#include <filesystem>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "input.h"
#include "lammps.h"
#include "library.h"
#include "structure/lammps/register_styles.h"
#include "structure/lammps/script.h"

namespace magfsi::structure::test {

// A folder that all ranks of the world share.
class SharedFolder {
  public:
    SharedFolder() {
        MPI_Comm_rank(MPI_COMM_WORLD, &rank_);
        std::string name = std::filesystem::temp_directory_path() / "magfsi.XXXXXX";
        if (rank_ == 0 && mkdtemp(name.data()) == nullptr) {
            throw std::runtime_error("mkdtemp failed");
        }
        MPI_Bcast(name.data(), static_cast<int>(name.size()), MPI_CHAR, 0,
                  MPI_COMM_WORLD);
        path_ = name;
    }
    ~SharedFolder() {
        MPI_Barrier(MPI_COMM_WORLD);
        std::error_code ignored;
        if (rank_ == 0) std::filesystem::remove_all(path_, ignored);
    }
    const std::filesystem::path& path() const { return path_; }

    // Written by rank 0, the same lines everywhere.
    LammpsScript write(const LammpsInput& input) const {
        LammpsScript script;
        if (rank_ == 0) script = write_lammps_input(input, path_);
        std::string text;
        for (const std::string& line : script.setup) text += line + '\n';
        for (const std::string& id : script.fix_id) text += id + '\n';
        std::array<int, 3> sizes{static_cast<int>(text.size()),
                                 static_cast<int>(script.setup.size()),
                                 static_cast<int>(script.first_node.size())};
        MPI_Bcast(sizes.data(), 3, MPI_INT, 0, MPI_COMM_WORLD);
        text.resize(static_cast<std::size_t>(sizes[0]));
        script.first_node.resize(static_cast<std::size_t>(sizes[2]));
        MPI_Bcast(text.data(), sizes[0], MPI_CHAR, 0, MPI_COMM_WORLD);
        MPI_Bcast(script.first_node.data(), sizes[2], MPI_INT, 0, MPI_COMM_WORLD);
        if (rank_ != 0) split(text, static_cast<std::size_t>(sizes[1]), script);
        return script;
    }

  private:
    static void split(const std::string& text, std::size_t setup, LammpsScript& script) {
        for (std::size_t begin = 0; begin < text.size();) {
            const std::size_t end = text.find('\n', begin);
            auto& lines = script.setup.size() < setup ? script.setup : script.fix_id;
            lines.push_back(text.substr(begin, end - begin));
            begin = end + 1;
        }
    }
    int rank_ = 0;
    std::filesystem::path path_;
};

class LammpsRun {
  public:
    LammpsRun(MPI_Comm comm, const std::vector<std::string>& lines) {
        std::array<std::string, 6> words{"magfsi",  "-log", "none",
                                         "-screen", "none", "-nocite"};
        std::array<char*, 6> arguments{};
        for (std::size_t i = 0; i < 6; ++i) arguments[i] = words[i].data();
        lammps_ = std::make_unique<LAMMPS_NS::LAMMPS>(6, arguments.data(), comm);
        register_styles(*lammps_);
        for (const std::string& line : lines) command(line);
    }
    void command(const std::string& line) { lammps_->input->one(line); }

    // Three values an atom, by atom ID. Collective.
    std::vector<double> gather(std::string name) {
        std::vector<double> out(3 * static_cast<std::size_t>(atoms()));
        lammps_gather_atoms(lammps_.get(), name.data(), 1, 3, out.data());
        return out;
    }
    int atoms() { return static_cast<int>(lammps_get_natoms(lammps_.get())); }

    // Entry of a fix's global vector. Collective.
    double fix_value(const std::string& id, int entry) {
        auto* value = static_cast<double*>(lammps_extract_fix(
            lammps_.get(), id.c_str(), LMP_STYLE_GLOBAL, LMP_TYPE_VECTOR, entry, 0));
        if (value == nullptr)
            throw std::runtime_error("fix " + id + " has no such value");
        const double out = *value;
        lammps_free(value);
        return out;
    }
    // Entry of a compute's global vector. Collective.
    double compute_value(const std::string& id, int entry) {
        auto* values = static_cast<double*>(lammps_extract_compute(
            lammps_.get(), id.c_str(), LMP_STYLE_GLOBAL, LMP_TYPE_VECTOR));
        if (values == nullptr) throw std::runtime_error("no compute " + id);
        return values[entry];
    }
    // IDs of the atoms that this rank owns.
    std::vector<int> owned() {
        const auto* tags = static_cast<const int*>(
            lammps_extract_atom(lammps_.get(), const_cast<char*>("id")));
        return {tags, tags + lammps_extract_setting(lammps_.get(), "nlocal")};
    }
    double variable(const std::string& name) {
        auto* value = static_cast<double*>(
            lammps_extract_variable(lammps_.get(), name.c_str(), nullptr));
        if (value == nullptr) throw std::runtime_error("no variable " + name);
        const double out = *value;
        lammps_free(value);
        return out;
    }

  private:
    std::unique_ptr<LAMMPS_NS::LAMMPS> lammps_;
};

// The same script on one rank and on all, which run the same steps.
struct AloneAndTogether {
    LammpsRun alone, together;

    explicit AloneAndTogether(const LammpsScript& script)
        : alone(MPI_COMM_SELF, script.setup), together(MPI_COMM_WORLD, script.setup) {}
    void command(const std::string& text) {
        alone.command(text);
        together.command(text);
    }
};

}  // namespace magfsi::structure::test
