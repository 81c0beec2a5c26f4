// SPDX-License-Identifier: GPL-2.0-or-later
// exchange.record of a run folder: what the two sides of a coupled run told each other,
// step by step, so that one of them can be played to the other later.
//
// The file is one line of JSON, padded with blanks to a multiple of 4096 bytes
// ("offset"), and then, for the start and for each coupled step, one entry of doubles:
// step, the fluid's numbers of the last probe row, and for each marker where it is at
// the end of the step [m], the impulse that it gave to the fluid in it [N s], and the
// fluid's velocity [m/s] that it got back; in forcing no_slip besides its volume [m3] and
// NoSlipAnswer, row sum and passed [m/s]. numpy reads it by
//   numpy.fromfile(file, offset=OFFSET).reshape(-1, 1 + NUMBERS + VALUES * MARKERS)
// with VALUES 9, or 14 in forcing no_slip.
// Entries are only added: a run that is killed leaves all but perhaps its last one.
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

struct RecordHeader {
    double step_s = 0;            // the coupled step
    std::int64_t first_step = 0;  // coupled steps done before the record starts
    std::size_t markers = 0;      // of all ranks, in the order of their placement
    std::size_t numbers = 0;      // that the fluid sends for a probe row
    Forcing forcing = Forcing::penalty;
    Grid grid;
};

struct RecordEntry {
    std::int64_t step = -1;  // the coupled step; that before the first one at the start
    std::vector<double> numbers;
    std::vector<Vec3> position_m, impulse, velocity;  // one a marker
    std::vector<double> volume_m3;                    // in forcing no_slip, as the next
    NoSlipAnswer answer;
};

constexpr const char* record_name = "exchange.record";

constexpr std::size_t record_values_of(Forcing forcing) {
    return forcing == Forcing::no_slip ? 14 : 9;
}

class RecordWriter {
  public:
    // Throws output::FileError, as append does.
    RecordWriter(const std::filesystem::path& path, const RecordHeader& header);
    // rows: the values of each marker, in the order above.
    void append(std::int64_t step, std::span<const double> numbers,
                std::span<const double> rows);

  private:
    output::File file_;
    std::vector<double> entry_;
};

class RecordReader {
  public:
    // Throws std::invalid_argument on a file that is missing or no record.
    explicit RecordReader(const std::filesystem::path& path);

    const RecordHeader& header() const { return header_; }
    std::int64_t entries() const { return entries_; }  // complete ones, the start too
    RecordEntry read(std::int64_t entry);              // 0: the start

  private:
    std::size_t entry_bytes() const;

    std::filesystem::path path_;
    std::ifstream file_;
    RecordHeader header_;
    std::int64_t offset_ = 0;
    std::int64_t entries_ = 0;
};

}  // namespace magfsi::coupler
