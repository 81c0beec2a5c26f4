// SPDX-License-Identifier: GPL-2.0-or-later
// exchange.record of a run folder: what the two sides of a coupled run told each other,
// step by step, so that one side can be replayed to the other later.
//
// The file starts with one line of JSON, padded with blanks to a multiple of 4096 bytes
// (its key "offset"). Entries of doubles follow, one for the start and one for each
// coupled step: the step; the fluid's numbers of the last probe row; and for each marker
// its position at the end of the step [m], the impulse that it gave to the fluid [N s]
// and the velocity of the fluid that it received [m/s]. In forcing no_slip the marker's
// volume [m3] and its NoSlipAnswer, row sum and q [m/s], come after these. numpy reads
// the entries by
//    numpy.fromfile(file, offset=OFFSET).reshape(-1, 1 + NUMBERS + VALUES * MARKERS)
// with VALUES 9, or 14 in forcing no_slip. Entries are only appended: a run that is
// killed leaves all of them but perhaps the last.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <span>
#include <vector>

#include "coupler/immersed_boundary/grid.h"
#include "coupler/immersed_boundary/no_slip.h"
#include "coupler/options.h"
#include "coupler/output/file.h"

namespace magfsi::coupler {

// The line of JSON at the head of a record.
struct RecordHeader {
    double step_s = 0;            // coupled step [s]
    std::int64_t first_step = 0;  // coupled steps done before the record starts
    std::size_t markers = 0;      // number in all, in the order of placement
    std::size_t numbers = 0;      // values from the fluid per probe row
    Forcing forcing = Forcing::penalty;
    Grid grid;
};

// One entry of a record: the state of the exchange at the end of a coupled step.
struct RecordEntry {
    std::int64_t step = -1;  // coupled step; first_step - 1 at the start
    std::vector<double> numbers;
    std::vector<Vec3> position_m, impulse, velocity;  // one per marker
    std::vector<double> volume_m3;                    // filled in forcing no_slip only
    NoSlipAnswer answer;
};

// Name of the file in the run folder.
constexpr const char* record_name = "exchange.record";

// Number of doubles per marker in an entry.
constexpr std::size_t record_values_of(Forcing forcing) {
    return forcing == Forcing::no_slip ? 14 : 9;
}

// Writes a record while the run goes on; used by one rank only.
class RecordWriter {
  public:
    // Throws output::FileError, as append() does.
    RecordWriter(const std::filesystem::path& path, const RecordHeader& header);
    // Appends an entry. rows: the values of all markers, marker after marker, in the
    // order above.
    void append(std::int64_t step, std::span<const double> numbers,
                std::span<const double> rows);

  private:
    output::File file_;
    std::vector<double> entry_;
};

// Reads entries of a record in any order.
class RecordReader {
  public:
    // Throws std::invalid_argument on a file that is missing or no record.
    explicit RecordReader(const std::filesystem::path& path);

    const RecordHeader& header() const { return header_; }
    // Complete ones, that of the start included.
    std::int64_t entries() const { return entries_; }
    RecordEntry read(std::int64_t entry);  // entry 0 is the start

  private:
    std::size_t entry_bytes() const;

    std::filesystem::path path_;
    std::ifstream file_;
    RecordHeader header_;
    std::int64_t offset_ = 0;
    std::int64_t entries_ = 0;
};

}  // namespace magfsi::coupler
