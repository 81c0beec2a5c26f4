// SPDX-License-Identifier: GPL-2.0-or-later
// The file that one participant contributes to a checkpoint: HDF5 with named tables of
// numbers.
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

// The attributes at the head of every file of a checkpoint.
struct StateHeader {
    std::uint64_t state_hash = 0;  // hash of the scene without its end time
    std::int64_t step = 0;         // coupled steps that were completed
    double step_s = 0;             // coupled step [s]

    // Number of steps of run_step_s [s] in one step of the stored state: 1, or a power of
    // two if a retry continues with smaller steps; 0 if no whole number fits.
    std::int64_t steps_in_one(double run_step_s) const {
        const double ratio = step_s / run_step_s;
        const bool whole = ratio >= 1 && ratio == std::floor(ratio) && ratio < 1e6;
        return whole ? static_cast<std::int64_t>(ratio) : 0;
    }
};

// Precision of a table in the file; float_ is for values that are exact in it.
enum class StoredAs { double_, float_ };

// Writes a file under a temporary name, syncs it to the disk and renames it on commit():
// a kill at any moment leaves earlier checkpoints as they were. All calls throw
// output::FileError on a failing disk.
class StateWriter {
  public:
    // Creates the temporary file and writes the header.
    StateWriter(std::filesystem::path path, const StateHeader& header);
    ~StateWriter();  // deletes the temporary file unless committed
    StateWriter(const StateWriter&) = delete;
    StateWriter& operator=(const StateWriter&) = delete;

    // Writes a whole table, the last dimension of shape fastest. An empty table is left
    // out.
    void table(const std::string& name, std::span<const double> values,
               std::vector<std::size_t> shape);

    // Begins a large table that is then written plane by plane along its first dimension,
    // in any order; it ends with the next begin_table() or with commit().
    void begin_table(const std::string& name, std::vector<std::size_t> shape,
                     StoredAs stored_as);
    void plane(std::size_t index, std::span<const double> values);

    // Completes the file and gives it its name.
    void commit();

  private:
    struct Files;
    template <class Work>
    void guarded(Work&& work);
    // Stores the checksum of the table that plane() has filled.
    void end_table();

    std::filesystem::path path_;
    std::unique_ptr<Files> files_;
    bool committed_ = false;
};

// A file is missing, truncated, damaged, or no checkpoint; the message names file and
// reason.
class StateFault : public std::invalid_argument {
  public:
    using std::invalid_argument::invalid_argument;
};

// Reads a file of a checkpoint. All calls but has() throw StateFault.
class StateReader {
  public:
    // Opens the file and reads its header.
    explicit StateReader(std::filesystem::path path);
    ~StateReader();
    StateReader(const StateReader&) = delete;
    StateReader& operator=(const StateReader&) = delete;

    const StateHeader& header() const { return header_; }
    // True if the file has a table of this name; StateWriter leaves empty tables out.
    bool has(const std::string& table) const;
    // Dimensions of a table, and all its values, the last dimension fastest.
    std::vector<std::size_t> shape(const std::string& table) const;
    std::vector<double> table(const std::string& table) const;

    // Reads rows begin to end (half-open) of the second dimension in one plane of the
    // first, with all further dimensions. Throws if `out` has another size than that.
    void rows(const std::string& table, std::size_t plane, std::size_t begin,
              std::size_t end, std::span<double> out) const;

    // Reads all tables and throws StateFault if a checksum does not match. A large table
    // is read plane by plane.
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
