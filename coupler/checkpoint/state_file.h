// SPDX-License-Identifier: GPL-2.0-or-later
// One participant's file of a checkpoint: tables of numbers in HDF5, written and read.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

namespace magfsi::coupler {

// What every file of a checkpoint says of itself.
struct StateHeader {
    std::uint64_t state_hash = 0;  // of the scene, whatever its end
    std::int64_t step = 0;         // coupled steps that were completed
    double step_s = 0;             // the coupled step

    // How many steps of a run there are in one of the state's: a power of two where a
    // retry goes on with smaller ones, 0 where no whole number fits.
    std::int64_t steps_in_one(double run_step_s) const {
        const double ratio = step_s / run_step_s;
        const bool whole = ratio >= 1 && ratio == std::floor(ratio) && ratio < 1e6;
        return whole ? static_cast<std::int64_t>(ratio) : 0;
    }
};

enum class StoredAs { double_, float_ };  // float: for values that are exact in it

// The file takes its name only when it is complete and on the disk, so a kill in the
// middle leaves the checkpoints before it as they were.
class StateWriter {
  public:
    // Throws output::FileError, also from the calls below, on a failing disk.
    StateWriter(std::filesystem::path path, const StateHeader& header);
    ~StateWriter();  // takes the temporary file away unless committed
    StateWriter(const StateWriter&) = delete;
    StateWriter& operator=(const StateWriter&) = delete;

    // A whole table. An empty one is left out.
    void table(const std::string& name, std::span<const double> values,
               std::vector<std::size_t> shape);

    // A large one, plane by plane along its first dimension, in any order.
    void begin_table(const std::string& name, std::vector<std::size_t> shape,
                     StoredAs stored_as);
    void plane(std::size_t index, std::span<const double> values);

    void commit();

  private:
    struct Files;
    template <class Work>
    void guarded(Work&& work);
    void end_table();

    std::filesystem::path path_;
    std::unique_ptr<Files> files_;
    bool committed_ = false;
};

// A file that is missing, cut short, damaged, or no checkpoint; names it and the reason.
class StateFault : public std::invalid_argument {
  public:
    using std::invalid_argument::invalid_argument;
};

class StateReader {
  public:
    // Throws StateFault, as all calls below do.
    explicit StateReader(std::filesystem::path path);
    ~StateReader();
    StateReader(const StateReader&) = delete;
    StateReader& operator=(const StateReader&) = delete;

    const StateHeader& header() const { return header_; }
    bool has(const std::string& table) const;
    std::vector<std::size_t> shape(const std::string& table) const;
    std::vector<double> table(const std::string& table) const;

    // Rows begin to end of the second dimension of one plane of the first; out holds them
    // with all further dimensions.
    void rows(const std::string& table, std::size_t plane, std::size_t begin,
              std::size_t end, std::span<double> out) const;

    // Reads all there is, plane by plane: throws if a checksum does not fit.
    void verify() const;

  private:
    struct Files;
    template <class Work>
    auto guarded(Work&& work) const;

    std::filesystem::path path_;
    StateHeader header_;
    std::unique_ptr<Files> files_;
};

}  // namespace magfsi::coupler
